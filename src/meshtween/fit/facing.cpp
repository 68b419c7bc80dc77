#include "meshtween/fit/facing.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// The least cosine between the normal, times its length, and those of the triangles that the place belongs to.
double least_cosine(const FitTarget& target, const SurfacePoint& place, const Point& normal) {
    constexpr double nil = 1e-9;
    const double own = normal.dot(target.index.normals().row(place.triangle));
    int first = -1, last = -1, count = 0; // of the edge, or the one corner, where the place lies
    for (int k = 0; k < 3; ++k) {
        if (place.barycentric[k] <= nil) continue;
        last = target.triangles(place.triangle, k);
        if (count++ == 0) first = last;
    }
    if (count > 2) return own;
    double least = own;
    for (const int t : target.topology.vertex_triangles[first])
        if ((target.triangles.row(t).array() == last).any())
            least = std::min(least, normal.dot(target.index.normals().row(t)));
    return least;
}

} // namespace

Facing facing(const Point& centre, const Point& area_normal, const FitTarget& target, int hint, double most) {
    const ClosestPoint there = target.index.closest(centre, hint);
    Facing result{there.squared_distance, 1, 0, there.where.triangle};
    const double length = area_normal.norm();
    if (length == 0) return result;
    const Point normal = area_normal / length;
    result.cosine = least_cosine(target, there.where, normal);
    if (!result.into()) return result;
    constexpr double diagonal = 1; // of the target: further than that, nothing looks the same way
    const double distance = std::sqrt(there.squared_distance), reach = distance + most;
    const ClosestPoint alike = target.index.closest(centre, {normal, 0}, reach);
    const double none = reach < diagonal ? std::numeric_limits<double>::infinity() : diagonal;
    result.detour = (alike.found() ? std::sqrt(alike.squared_distance) : none) - distance;
    return result;
}

FacingWatch::FacingWatch(const Triangles& triangles, const FitTarget& target, EdgeSides sides, std::vector<int> places)
    : triangles_(triangles), target_(target), sides_(sides), places_(std::move(places)),
      flags_(idx(triangles.rows()), 0) {
    places_.resize(flags_.size(), -1);
}

std::vector<int> FacingWatch::into(const Points& positions) {
    const bool all = last_.rows() == 0;
    parallel_for(
        triangles_.rows(),
        [&](std::ptrdiff_t t) {
            bool moved = all;
            for (int k = 0; k < 3 && !moved; ++k)
                moved = positions.row(triangles_(t, k)) != last_.row(triangles_(t, k));
            if (moved) ask(positions, t);
        },
        256);
    last_ = positions;
    std::vector<int> result;
    for (std::size_t t = 0; t < flags_.size(); ++t)
        if (flags_[t]) result.push_back(static_cast<int>(t));
    return result;
}

void FacingWatch::ask(const Points& x, std::ptrdiff_t t) {
    const Point centre = (x.row(triangles_(t, 0)) + x.row(triangles_(t, 1)) + x.row(triangles_(t, 2))) / 3;
    const Point area_normal = double_area_normal(x, triangles_, t);
    const SurfacePoint there = target_.index.closest(centre, places_[idx(t)]).where;
    places_[idx(t)] = there.triangle;
    flags_[idx(t)] = (sides_ == EdgeSides::both ? least_cosine(target_, there, area_normal)
                                                : area_normal.dot(target_.index.normals().row(there.triangle))) < 0;
}

std::vector<int> facing_into(const Points& positions, const Triangles& triangles, const FitTarget& target) {
    return FacingWatch(triangles, target, EdgeSides::both).into(positions);
}

std::vector<int> at_first_corners(const Triangles& triangles, const std::vector<int>& of_vertices) {
    std::vector<int> result;
    if (of_vertices.empty()) return result;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) result.push_back(of_vertices[idx(triangles(t, 0))]);
    return result;
}

} // namespace meshtween
