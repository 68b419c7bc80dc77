#include "meshtween/fit/facing.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

// The least cosine between the normal and those of the triangles that the place belongs to.
double least_cosine(const FitTarget& target, const SurfacePoint& place, const Point& normal) {
    constexpr double nil = 1e-9;
    const double own = normal.dot(target.index.normals().row(place.triangle));
    std::vector<int> corners; // of the edge, or the one corner, where the place lies
    for (int k = 0; k < 3; ++k)
        if (place.barycentric[k] > nil) corners.push_back(target.triangles(place.triangle, k));
    if (corners.size() > 2) return own;
    double least = own;
    for (const int t : target.topology.vertex_triangles[corners.front()])
        if ((target.triangles.row(t).array() == corners.back()).any())
            least = std::min(least, normal.dot(target.index.normals().row(t)));
    return least;
}

} // namespace

Facing facing(const Point& centre, const Point& area_normal, const FitTarget& target, int hint) {
    const ClosestPoint there = target.index.closest(centre, hint);
    Facing result{there.squared_distance, 1, 0, there.where.triangle};
    const double length = area_normal.norm();
    if (length == 0) return result;
    const Point normal = area_normal / length;
    result.cosine = least_cosine(target, there.where, normal);
    if (!result.into()) return result;
    const ClosestPoint alike = target.index.closest(centre, {normal, 0});
    result.detour = (alike.found() ? std::sqrt(alike.squared_distance) : 1) - std::sqrt(there.squared_distance);
    return result;
}

std::vector<int> facing_into(const Points& positions, const Triangles& triangles, const FitTarget& target) {
    return facing_into(positions, {}, std::vector<char>(static_cast<std::size_t>(triangles.rows()), 1), triangles,
                       target);
}

std::vector<int> facing_into(const Points& positions, const std::vector<int>& before, const std::vector<char>& moved,
                             const Triangles& triangles, const FitTarget& target) {
    std::vector<char> flag(moved.size(), 0);
    for (const int t : before) flag[static_cast<std::size_t>(t)] = 1;
    parallel_for(
        triangles.rows(),
        [&](std::ptrdiff_t t) {
            if (!moved[static_cast<std::size_t>(t)]) return;
            const auto f = triangles.row(t);
            const Point centre = (positions.row(f[0]) + positions.row(f[1]) + positions.row(f[2])) / 3;
            flag[static_cast<std::size_t>(t)] =
                facing(centre, double_area_normal(positions, triangles, t), target).into();
        },
        256);
    std::vector<int> result;
    for (std::size_t t = 0; t < flag.size(); ++t)
        if (flag[t]) result.push_back(static_cast<int>(t));
    return result;
}

} // namespace meshtween
