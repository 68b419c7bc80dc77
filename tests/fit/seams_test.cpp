// Whatever seams cut a file's numbering, fits are those of the whole mesh.
#include "meshtween/fit/fit.h"
#include "meshtween/fit/markers.h"
#include "meshtween/fit/rotate.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/samples.h"
#include "meshtween/geometry/shapes.h"

#include "support/cut.h"

#include <gtest/gtest.h>

using namespace meshtween;

namespace {

std::vector<Marker> markers_of(const Sample& pair) {
    std::vector<MarkerPair> pairs;
    for (std::size_t k = 0; k < pair.marker_names.size(); ++k)
        pairs.push_back({pair.marker_names[k], pair.marker_source.row(static_cast<Eigen::Index>(k)),
                         pair.marker_target.row(static_cast<Eigen::Index>(k))});
    return place_markers(pairs, pair.source);
}

CutMesh cut(const Mesh& mesh, unsigned seed) {
    return cut_along(mesh, random_seams(mesh, 9, 12, seed));
}

TEST(FitSeams, CopiesAtTheEndGiveTheSameBits) {
    const Sample pair = sample("head");
    const std::vector<Marker> markers = markers_of(pair);
    const CutMesh source = cut(pair.source, 1), target = cut(pair.target, 2);
    for (const FitMethod method : {FitMethod::surface, FitMethod::paper}) {
        FitOptions options;
        options.method = method, options.max_rounds = 5;
        const FitResult whole = fit(pair.source, pair.target, markers, options);
        const FitResult split = fit(source.mesh, target.mesh, markers, options);
        EXPECT_EQ(split.positions, source.whole(whole.positions));
        EXPECT_EQ(split.history, whole.history);
        EXPECT_EQ(split.error, whole.error);
        EXPECT_EQ(split.refused_steps, whole.refused_steps);
        EXPECT_EQ(split.mended, whole.mended);
        for (const int v : whole.refused)
            EXPECT_TRUE(std::binary_search(split.refused.begin(), split.refused.end(), v));
    }
}

TEST(FitSeams, FlatShadedMeshesAreFittedAsWhole) {
    const Sample pair = sample("torus");
    const std::vector<Marker> markers = markers_of(pair);
    const CutMesh source = flat_shaded(pair.source), target = flat_shaded(pair.target);
    const Points whole = fit(pair.source, pair.target, markers).positions;
    const Points split = fit(source.mesh, target.mesh, markers).positions;
    EXPECT_LT((split - source.whole(whole)).rowwise().norm().maxCoeff(), 1e-9 * diagonal(whole));
    for (std::size_t i = 0, n = source.vertex.size(); i < n; ++i)
        for (std::size_t j = 0; j < i && n < 3000; ++j)
            if (source.vertex[i] == source.vertex[j])
                ASSERT_EQ(split.row(static_cast<Eigen::Index>(i)), split.row(static_cast<Eigen::Index>(j)));
}

TEST(FitSeams, WatchersSeeTheFilesNumbering) {
    const Mesh bar_mesh = bar({1, 0.4, 0.25}, {8, 4, 3}, 0.05);
    const CutMesh source = cut(bar_mesh, 3);
    int calls = 0;
    FitOptions options;
    options.watch = [&](const Points& x) {
        ++calls;
        ASSERT_EQ(x.rows(), source.mesh.positions.rows());
        for (std::size_t i = 0; i < source.vertex.size(); ++i)
            ASSERT_EQ(x.row(static_cast<Eigen::Index>(i)), x.row(source.vertex[i]));
    };
    fit(source.mesh, bar_mesh, {}, options);
    EXPECT_GT(calls, 0);
}

TEST(FitSeams, SwitchedOffTheMeshIsCut) {
    const Sample pair = sample("head");
    const std::vector<Marker> markers = markers_of(pair);
    const CutMesh source = cut(pair.source, 1);
    FitOptions options;
    options.weld = false;
    const Points cut_open = fit(source.mesh, pair.target, markers, options).positions;
    double gap = 0;
    for (std::size_t i = 0; i < source.vertex.size(); ++i)
        gap = std::max(gap, (cut_open.row(static_cast<Eigen::Index>(i)) - cut_open.row(source.vertex[i])).norm());
    EXPECT_GT(gap, 1e-6 * diagonal(cut_open));
}

TEST(FitSeams, RotationsKeepThemClosed) {
    const Mesh ball = sphere(3);
    const CutMesh split = cut(ball, 4);
    Points turning(4, 3), holding(4, 3);
    turning << 0, 0, 1, 0.5, 0, 0.8, 0, 0.5, 0.8, -0.5, 0.1, 0.8;
    holding << 0, 0, -1, 0.5, 0, -0.8, 0, 0.5, -0.8, -0.5, 0.1, -0.8;
    const auto turned = [&](const Points& x) { return rotate(x, turning, holding, {0, 0, 1}, {0, 0, 0}, 50); };
    EXPECT_EQ(turned(split.mesh.positions), split.whole(turned(ball.positions)));
}

} // namespace
