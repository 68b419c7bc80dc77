// Plain arithmetic, since it only guides: whether triangles cut each other is decided elsewhere, with exact predicates.
#include "meshtween/fit/cut_length.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace meshtween {
namespace {

constexpr int rings = 3;
constexpr double least_gap = 1e-6; // diagonals: some roundings to floats

using Corners = std::array<Point, 3>;

std::array<double, 3> above(const Sheet& plane, const Corners& t) {
    const Point& o = plane.corners[0];
    return {plane.normal.dot(t[0] - o), plane.normal.dot(t[1] - o), plane.normal.dot(t[2] - o)};
}

using Flags = std::array<bool, 3>;

// None of the edges between corners that are not shared comes through the plane, or near it.
bool clear_of(const Sheet& plane, const std::array<double, 3>& above, const Flags& shared) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < 3; ++k)
        if (!shared[k]) low = std::min(low, above[k]), high = std::max(high, above[k]);
    const double gap = least_gap * plane.normal_size;
    return low > gap || high < -gap;
}

// The points where edges of `a` go through `b`, or come so near to it that a rounding may take them through.
template <typename Visit>
void each_crossing(const Corners& a, const Flags& shared, const std::array<double, 3>& above, const Sheet& plane,
                   const Visit& visit) {
    const Corners& b = plane.corners;
    const double gap = least_gap * plane.normal_size;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        if (shared[k] || shared[next]) continue;
        const double p = above[k], q = above[next];
        if (p == q || (p * q > 0 && std::min(std::abs(p), std::abs(q)) > gap)) continue;
        const Point at = a[k] + std::clamp(p / (p - q), 0.0, 1.0) * (a[next] - a[k]);
        bool inside = true;
        for (std::size_t c = 0; c < 3 && inside; ++c)
            inside = plane.normal.dot((b[(c + 1) % 3] - b[c]).cross(at - b[c])) >= 0;
        if (inside) visit(at);
    }
}

} // namespace

Sheet sheet(const std::array<int, 3>& vertices, const std::array<Point, 3>& corners) {
    Sheet result{vertices, corners, {}, (corners[1] - corners[0]).cross(corners[2] - corners[0]), 0};
    for (const Point& p : corners) result.box.extend(p.transpose());
    result.normal_size = result.normal.norm();
    return result;
}

Sheet sheet(const Points& positions, const Triangles& triangles, int t) {
    const std::array vertices{triangles(t, 0), triangles(t, 1), triangles(t, 2)};
    return sheet(vertices, {positions.row(vertices[0]), positions.row(vertices[1]), positions.row(vertices[2])});
}

std::optional<double> cut_length(const Sheet& s, const Sheet& t) {
    if (((s.box.min() - t.box.max()).array() > least_gap).any() ||
        ((t.box.min() - s.box.max()).array() > least_gap).any())
        return std::nullopt;
    const Corners &a = s.corners, &b = t.corners;
    std::array<Point, 7> ends; // of the line: a shared corner, and where edges go through
    std::size_t count = 0;
    Flags shared_a{}, shared_b{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            if (s.vertices[i] != t.vertices[j]) continue;
            if (count > 0) return std::nullopt;
            ends[count++] = a[i];
            shared_a[i] = shared_b[j] = true;
        }
    const std::array<double, 3> above_t = above(t, a);
    if (clear_of(t, above_t, shared_a)) return std::nullopt;
    const std::array<double, 3> above_s = above(s, b);
    if (clear_of(s, above_s, shared_b)) return std::nullopt;
    const auto add = [&](const Point& at) { ends[count++] = at; };
    each_crossing(a, shared_a, above_t, t, add);
    each_crossing(b, shared_b, above_s, s, add);
    if (count < 2) return std::nullopt;
    double longest = 0;
    for (std::size_t i = 1; i < count; ++i) longest = std::max(longest, (ends[i] - ends[0]).norm());
    return longest;
}

std::vector<int> beside_cuts(const Shell& shell, std::span<const std::array<int, 2>> cuts) {
    std::vector<int> result;
    for (const auto& pair : cuts) result.insert(result.end(), pair.begin(), pair.end());
    const auto distinct = [&result] {
        std::sort(result.begin(), result.end());
        result.erase(std::unique(result.begin(), result.end()), result.end());
    };
    for (int ring = 0; ring < rings; ++ring) {
        distinct();
        for (std::size_t k = 0, inner = result.size(); k < inner; ++k)
            for (int c = 0; c < 3; ++c)
                for (const int t : shell.topology.vertex_triangles[shell.triangles(result[k], c)]) result.push_back(t);
    }
    distinct();
    return result;
}

} // namespace meshtween
