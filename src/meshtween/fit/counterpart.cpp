// Correspondences that hold both ways, as an old rule for scans (Pajdla, Van Gool: Matching of 3-D curves using
// semi-differential invariants, ICCV 1995, reciprocal points), here between surfaces and by distance alone.
#include "meshtween/fit/counterpart.h"

#include "meshtween/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

double counterpart(const ClosestPoint& place, const ClosestPointIndex& surface, const ClosestPointIndex& mesh) {
    constexpr double none = 0.25, whole = 0.5; // a vertex looks their way up to 60 degrees, whose cosine is a half
    if (!place.found()) return 0;
    const double away = std::sqrt(place.squared_distance);
    if (!(away > 0)) return 1;
    const Compatible alike{surface.normals().row(place.where.triangle), 0};
    const ClosestPoint back = mesh.closest(place.position, alike, away);
    if (!back.found()) return 1; // none nearer than the vertex itself
    return std::clamp((std::sqrt(back.squared_distance) / away - none) / (whole - none), 0.0, 1.0);
}

} // namespace

bool at_border(const SurfacePoint& point, const Triangles& triangles, const std::vector<char>& on_boundary) {
    constexpr double nil = 1e-9;
    bool inside = true, all = true;
    for (int k = 0; k < 3; ++k) {
        if (point.barycentric[k] <= nil)
            inside = false;
        else
            all = all && on_boundary[idx(triangles(point.triangle, k))] != 0;
    }
    return !inside && all;
}

std::vector<double> counterparts(const Points& positions, const Lists& neighbours,
                                 const std::vector<ClosestPoint>& places, const OpenSurface& surface,
                                 const ClosestPointIndex& mesh, double reach) {
    std::vector<double> own(places.size()), result(places.size(), 1.0);
    std::vector<char> surely(places.size()); // beyond
    parallel_for(
        std::ssize(places),
        [&](std::ptrdiff_t i) {
            own[idx(i)] = counterpart(places[idx(i)], surface.index, mesh);
            if (own[idx(i)] == 1) return;
            const ClosestPoint nearest = surface.index.closest(Point(positions.row(i)), Compatible{}, reach);
            surely[idx(i)] = !nearest.found() || at_border(nearest.where, surface.triangles, surface.on_boundary);
        },
        64);
    std::vector<int> reached;
    const auto reach_one = [&](int i) {
        if (own[idx(i)] == 1 || result[idx(i)] < 1) return;
        result[idx(i)] = own[idx(i)];
        reached.push_back(i);
    };
    for (int i = 0; i < static_cast<int>(places.size()); ++i)
        if (surely[idx(i)]) reach_one(i);
    while (!reached.empty()) {
        const auto around = neighbours[reached.back()];
        reached.pop_back();
        for (const int j : around) reach_one(j);
    }
    return result;
}

std::vector<int> without_beyond(const Triangles& triangles, const std::vector<char>& beyond, std::vector<int> flips) {
    const auto is_beyond = [&](int i) { return beyond[idx(i)] != 0; };
    if (!beyond.empty()) std::erase_if(flips, [&](int t) { return std::ranges::all_of(triangles.row(t), is_beyond); });
    return flips;
}

} // namespace meshtween
