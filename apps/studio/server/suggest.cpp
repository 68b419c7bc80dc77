// The warp is the paper's Eq. 1-5; where there is no fit yet, places come from farthest-point sampling (Gonzalez 1985).
#include "suggest.h"

#include "meshtween/core/error.h"
#include "meshtween/fit/rbf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshtween::studio {
namespace {

constexpr double near_marker = 0.03; // parts of the diagonal: closer than this a place has its marker already

double distance_to_markers(const Point& at, const std::vector<PlacedMarker>& markers) {
    double least = std::numeric_limits<double>::infinity();
    for (const PlacedMarker& marker : markers)
        if (marker.source) least = std::min(least, (*marker.source - at).norm());
    return least;
}

constexpr std::size_t enough_to_warp = 6; // fewer tell a turn and a size; between them a warp would run wild

Point carried(const Pose& pose, const std::vector<MarkerPair>& pairs, Side from, const Point& point) {
    const Points one = point;
    const Points start = side_of_pairs(pairs, from),
                 end = side_of_pairs(pairs, from == Side::source ? Side::target : Side::source);
    if (pairs.size() >= enough_to_warp) try {
            return warp(start, end)(one).row(0);
        } catch (const Error&) { // markers on one line or on one spot say too little for a warp
        }
    if (pairs.size() >= 3) return align(start, end)(one).row(0);
    return (from == Side::source ? pose.forward : pose.back)(one).row(0);
}

// The mean distance of some vertices of `from`, once moved, to `to`.
double distance(const OpenMesh& from, const Similarity& moved, const OpenMesh& to) {
    const Eigen::Index step = std::max<Eigen::Index>(1, from.mesh.positions.rows() / 500);
    double sum = 0;
    for (Eigen::Index i = 0; i < from.mesh.positions.rows(); i += step)
        sum += std::sqrt(to.index.closest(Point(moved(from.mesh.positions.row(i)).row(0))).squared_distance);
    return sum * double(step) / double(from.mesh.positions.rows()) / to.frame.scale;
}

} // namespace

Pose pose_of(const OpenMesh& source, const OpenMesh& target) {
    const auto box_to_box = [](const OpenMesh& from, const OpenMesh& to) {
        Similarity s;
        s.scale = to.frame.scale / from.frame.scale;
        s.translation = to.frame.centre - s.scale * from.frame.centre;
        return s;
    };
    const Mesh &a = source.mesh, &b = target.mesh;
    const Pose upright{box_to_box(source, target), box_to_box(target, source)},
        turned{align_axes(a.positions, a.triangles, b.positions, b.triangles),
               align_axes(b.positions, b.triangles, a.positions, a.triangles)};
    const auto away = [&](const Pose& pose) {
        return distance(source, pose.forward, target) + distance(target, pose.back, source);
    };
    constexpr double clearly = 0.7; // models mostly come upright, and round ones have no axes to speak of
    return away(turned) < clearly * away(upright) ? turned : upright;
}

Point guess(const OpenMesh& to, const Pose& pose, const std::vector<MarkerPair>& pairs, Side from, const Point& point) {
    return to.index.closest(carried(pose, pairs, from, point)).position;
}

Json next_places(const OpenMesh& source, const std::vector<PlacedMarker>& markers, const Json& fit) {
    constexpr std::size_t wanted = 5;
    Json places = Json::array();
    std::vector<PlacedMarker> with_places = markers;
    if (fit.is_object() && fit.contains("next_markers"))
        for (const Json& next : fit["next_markers"]) {
            const Point at(next["source"][0], next["source"][1], next["source"][2]);
            if (distance_to_markers(at, markers) < near_marker * source.frame.scale) continue;
            places.push_back({{"at", next["source"]}, {"why", next["why"]}, {"target", next["target"]}});
            PlacedMarker chosen;
            chosen.source = at;
            with_places.push_back(chosen);
        }
    while (places.size() < wanted) {
        Eigen::Index best = 0;
        double furthest = -1;
        const Points& points = source.mesh.positions;
        const Eigen::Index step = std::max<Eigen::Index>(1, points.rows() / 5000);
        for (Eigen::Index i = 0; i < points.rows(); i += step) {
            const Point at = points.row(i);
            double distance = distance_to_markers(at, with_places);
            if (!std::isfinite(distance)) distance = (at - source.frame.centre).norm();
            if (distance > furthest) furthest = distance, best = i;
        }
        const Point at = points.row(best);
        places.push_back({{"at", {at[0], at[1], at[2]}},
                          {"why", fmt::format("no marker within {:.0f} % of the model's size",
                                              100 * furthest / source.frame.scale)}});
        PlacedMarker chosen;
        chosen.source = at;
        with_places.push_back(chosen);
    }
    return places;
}

} // namespace meshtween::studio
