// A vertex of no face may lie anywhere: it is no part of the shape, and no length refers to it.
#include "meshtween/fit/fit.h"
#include "meshtween/fit/markers.h"
#include "meshtween/fit/quality.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/samples.h"
#include "meshtween/morph/curve.h"
#include "meshtween/morph/keys.h"

#include <gtest/gtest.h>

using namespace meshtween;

namespace {

Points with_stray(const Points& positions) {
    Points result(positions.rows() + 1, 3);
    result << positions, Point(3e4, -1e4, 2e4);
    return result;
}

Mesh with_stray(Mesh mesh) {
    mesh.positions = with_stray(mesh.positions);
    return mesh;
}

TEST(StrayVertices, LeaveFitsAsTheyAre) {
    const Sample pair = sample("torus");
    std::vector<MarkerPair> pairs;
    for (std::size_t k = 0; k < pair.marker_names.size(); ++k)
        pairs.push_back({pair.marker_names[k], pair.marker_source.row(static_cast<Eigen::Index>(k)),
                         pair.marker_target.row(static_cast<Eigen::Index>(k))});
    const std::vector<Marker> markers = place_markers(pairs, pair.source);
    const double size = diagonal(pair.target);
    for (const FitMethod method : {FitMethod::surface, FitMethod::paper}) {
        FitOptions options;
        options.method = method;
        const Points alone = fit(pair.source, pair.target, markers, options).positions;
        const Points beside = fit(with_stray(pair.source), with_stray(pair.target), markers, options).positions;
        EXPECT_LT((beside.topRows(alone.rows()) - alone).rowwise().norm().maxCoeff(), 1e-3 * size);
    }
}

TEST(StrayVertices, LeavePathsAndTheirErrorsAsTheyAre) {
    const Sample pair = sample("bow");
    const Points& to = pair.truth;
    const KeyPath alone = key_path(pair.source, {pair.source.positions, to});
    const KeyPath beside = key_path(with_stray(pair.source), {with_stray(pair.source.positions), with_stray(to)});
    EXPECT_EQ(alone.curve.diagonal, diagonal(pair.source));
    EXPECT_EQ(beside.curve.diagonal, alone.curve.diagonal);
    EXPECT_EQ(beside.curve.nodes.size(), alone.curve.nodes.size());
    EXPECT_LE(beside.curve.deviation, 1e-4);
}

} // namespace
