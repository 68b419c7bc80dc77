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

Corners corners_of(const Points& positions, const Triangles& triangles, int t) {
    return {positions.row(triangles(t, 0)), positions.row(triangles(t, 1)), positions.row(triangles(t, 2))};
}

struct Plane {
    Point origin, normal; // of any length
    double least_gap = 0; // to a corner that cannot cross it, times that length

    explicit Plane(const Corners& t)
        : origin(t[0]), normal((t[1] - t[0]).cross(t[2] - t[0])), least_gap(meshtween::least_gap * normal.norm()) {}
    std::array<double, 3> above(const Corners& t) const {
        return {normal.dot(t[0] - origin), normal.dot(t[1] - origin), normal.dot(t[2] - origin)};
    }
};

using Flags = std::array<bool, 3>;

// None of the edges between corners that are not shared comes through the plane, or near it.
bool clear_of(const Plane& plane, const std::array<double, 3>& above, const Flags& shared) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < 3; ++k)
        if (!shared[k]) low = std::min(low, above[k]), high = std::max(high, above[k]);
    return low > plane.least_gap || high < -plane.least_gap;
}

// The points where edges of `a` go through `b`, or come so near to it that a rounding may take them through.
template <typename Visit>
void each_crossing(const Corners& a, const Flags& shared, const std::array<double, 3>& above, const Corners& b,
                   const Plane& plane, const Visit& visit) {
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        if (shared[k] || shared[next]) continue;
        const double p = above[k], q = above[next];
        if (p == q || (p * q > 0 && std::min(std::abs(p), std::abs(q)) > plane.least_gap)) continue;
        const Point at = a[k] + std::clamp(p / (p - q), 0.0, 1.0) * (a[next] - a[k]);
        bool inside = true;
        for (std::size_t c = 0; c < 3 && inside; ++c)
            inside = plane.normal.dot((b[(c + 1) % 3] - b[c]).cross(at - b[c])) >= 0;
        if (inside) visit(at);
    }
}

struct Box {
    Point low, high;
    explicit Box(const Point& p) : low(p), high(p) {}
    void add(const Point& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); }
    bool meets(const Box& other, double reach) const {
        return ((low - other.high).array() <= reach).all() && ((other.low - high).array() <= reach).all();
    }
};

} // namespace

std::optional<double> cut_length(const Points& positions, const Triangles& triangles, int s, int t) {
    const Corners a = corners_of(positions, triangles, s), b = corners_of(positions, triangles, t);
    std::array<Point, 7> ends; // of the line: a shared corner, and where edges go through
    std::size_t count = 0;
    Flags shared_a{}, shared_b{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            if (triangles(s, static_cast<int>(i)) != triangles(t, static_cast<int>(j))) continue;
            if (count > 0) return std::nullopt;
            ends[count++] = a[i];
            shared_a[i] = shared_b[j] = true;
        }
    const Plane plane_a(a), plane_b(b);
    const std::array<double, 3> above_b = plane_b.above(a), above_a = plane_a.above(b);
    if (clear_of(plane_b, above_b, shared_a) || clear_of(plane_a, above_a, shared_b)) return std::nullopt;
    const auto add = [&](const Point& at) { ends[count++] = at; };
    each_crossing(a, shared_a, above_b, b, plane_b, add);
    each_crossing(b, shared_b, above_a, a, plane_a, add);
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

std::vector<int> near_vertex(const Shell& shell, const Points& positions, Eigen::Index vertex,
                             std::span<const int> triangles, double reach) {
    Box own(positions.row(vertex));
    for (const int j : shell.topology.neighbours[vertex]) own.add(positions.row(j));
    std::vector<int> result;
    std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(result), [&](int t) {
        Box box(positions.row(shell.triangles(t, 0)));
        for (int k = 1; k < 3; ++k) box.add(positions.row(shell.triangles(t, k)));
        return box.meets(own, reach);
    });
    return result;
}

} // namespace meshtween
