// Plain arithmetic, since it only guides: whether triangles cut each other is decided elsewhere, with exact predicates.
#include "meshtween/fit/cut_length.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace meshtween {
namespace {

constexpr int rings = 3;
constexpr double least_gap = 1e-6; // diagonals: some roundings to floats

using Corners = std::array<Point, 3>;

Corners corners_of(const Points& positions, const Triangles& triangles, int t) {
    return {positions.row(triangles(t, 0)), positions.row(triangles(t, 1)), positions.row(triangles(t, 2))};
}

// Where a segment goes through a triangle, or comes so near to its plane that a rounding may take it through.
std::optional<Point> crossing(const Point& p, const Point& q, const Corners& t) {
    const Point normal = (t[1] - t[0]).cross(t[2] - t[0]);
    const double a = normal.dot(p - t[0]), b = normal.dot(q - t[0]), touching = least_gap * normal.norm();
    if (a * b > 0 && std::min(std::abs(a), std::abs(b)) > touching) return std::nullopt;
    if (a == b) return std::nullopt;
    const Point at = p + std::clamp(a / (a - b), 0.0, 1.0) * (q - p);
    for (std::size_t k = 0; k < 3; ++k)
        if (normal.dot((t[(k + 1) % 3] - t[k]).cross(at - t[k])) < 0) return std::nullopt;
    return at;
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
    std::array<bool, 3> shared_a{}, shared_b{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
            if (triangles(s, static_cast<int>(i)) != triangles(t, static_cast<int>(j))) continue;
            if (count > 0) return std::nullopt;
            ends[count++] = a[i];
            shared_a[i] = shared_b[j] = true;
        }
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        if (!shared_a[k] && !shared_a[next])
            if (const auto at = crossing(a[k], a[next], b)) ends[count++] = *at;
        if (!shared_b[k] && !shared_b[next])
            if (const auto at = crossing(b[k], b[next], a)) ends[count++] = *at;
    }
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
