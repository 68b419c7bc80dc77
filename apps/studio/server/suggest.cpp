// The warp is the paper's Eq. 1-5; where there is no fit yet, places come from farthest-point sampling (Gonzalez 1985).
#include "suggest.h"

#include "meshtween/core/error.h"
#include "meshtween/fit/rbf.h"

#include <fmt/format.h>

#include <algorithm>
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

Point warped(const OpenMesh& from, const OpenMesh& to, const std::vector<MarkerPair>& pairs, Side side,
             const Point& point) {
    if (pairs.size() >= 3) {
        const auto count = static_cast<Eigen::Index>(pairs.size());
        Points start(count, 3), end(count, 3);
        for (Eigen::Index i = 0; i < count; ++i) {
            const MarkerPair& pair = pairs[std::size_t(i)];
            start.row(i) = side == Side::source ? pair.source : pair.target;
            end.row(i) = side == Side::source ? pair.target : pair.source;
        }
        try {
            const Points one = point;
            return warp(start, end)(one).row(0);
        } catch (const Error&) { // markers on one line or on one spot say too little for a warp
        }
    }
    return (point - from.frame.centre) / from.frame.scale * to.frame.scale + to.frame.centre;
}

} // namespace

Point guess(const OpenMesh& from, const OpenMesh& to, const std::vector<MarkerPair>& pairs, Side side,
            const Point& point) {
    return to.index.closest(warped(from, to, pairs, side, point)).position;
}

Json next_places(const OpenMesh& source, const std::vector<PlacedMarker>& markers, const Json& fit) {
    constexpr std::size_t wanted = 5;
    Json places = Json::array();
    if (fit.is_object() && fit.contains("worst"))
        for (const Json& worst : fit["worst"]) {
            const Point at(worst["source"][0], worst["source"][1], worst["source"][2]);
            const double distance = worst["distance"];
            if (distance < 0.05 || distance_to_markers(at, markers) < near_marker * source.frame.scale) continue;
            places.push_back(
                {{"at", {at[0], at[1], at[2]}}, {"why", fmt::format("the last fit is {:.2g} % off here", distance)}});
            if (places.size() == wanted) return places;
        }
    std::vector<PlacedMarker> with_places = markers;
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
