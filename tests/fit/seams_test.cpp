// Whatever seams cut a file's numbering, fits are those of the whole mesh.
#include "meshtween/fit/fit.h"
#include "meshtween/fit/markers.h"
#include "meshtween/fit/quality.h"
#include "meshtween/fit/refined_fit.h"
#include "meshtween/fit/rotate.h"
#include "meshtween/fit/transfer.h"
#include "meshtween/fit/worst_places.h"
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
            if (source.vertex[i] == source.vertex[j]) {
                ASSERT_EQ(split.row(static_cast<Eigen::Index>(i)), split.row(static_cast<Eigen::Index>(j)));
            }
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
    Mesh egg = sphere(4);
    egg.positions.col(1) *= 1.3;
    const CutMesh source = cut(sphere(3), 1);
    FitOptions options;
    options.weld = false;
    const Points cut_open = fit(source.mesh, egg, {}, options).positions;
    double gap = 0;
    for (std::size_t i = 0; i < source.vertex.size(); ++i)
        gap = std::max(gap, (cut_open.row(static_cast<Eigen::Index>(i)) - cut_open.row(source.vertex[i])).norm());
    EXPECT_GT(gap, 1e-6 * diagonal(cut_open));
}

// A place of the mesh for each of its triangles' corners.
Points corners(const Mesh& mesh, const Points& positions) {
    return positions(std::vector<int>(mesh.triangles.reshaped<Eigen::RowMajor>().begin(),
                                      mesh.triangles.reshaped<Eigen::RowMajor>().end()),
                     Eigen::all);
}

TEST(FitSeams, RefiningCutsBothSidesAlike) {
    const Mesh coarse = sphere(2), fine = sphere(4);
    const RefinedFit whole = refined_fit(coarse, fine, {});
    for (const CutMesh& split : {cut(coarse, 5), flat_shaded(coarse)}) {
        const RefinedFit have = refined_fit(split.mesh, cut(fine, 6).mesh, {});
        ASSERT_EQ(have.source.triangles.rows(), whole.source.triangles.rows());
        EXPECT_GT(have.added.size(), 0U);
        EXPECT_EQ(have.source.positions.topRows(split.mesh.positions.rows()), split.mesh.positions);
        EXPECT_EQ(have.source.positions.rows(), have.fit.positions.rows());
        for (const auto& [a, b] :
             {std::pair(corners(have.source, have.source.positions), corners(whole.source, whole.source.positions)),
              std::pair(corners(have.source, have.fit.positions), corners(whole.source, whole.fit.positions))})
            EXPECT_LT((a - b).rowwise().norm().maxCoeff(), 1e-9);
    }
}

TEST(FitSeams, MeasuresAndCorrespondencesCountOnce) {
    const Mesh source = sphere(3), target = [] {
        Mesh egg = sphere(4);
        egg.positions.col(1) *= 1.2;
        egg.triangles = egg.triangles.topRows(egg.triangles.rows() - 200).eval(); // open
        return egg;
    }();
    Mesh fitted = source;
    fitted.positions.col(1) *= 1.15;
    const CutMesh split = cut(source, 7), split_target = cut(target, 8);
    Mesh split_fitted = split.mesh;
    split_fitted.positions = split.whole(fitted.positions);
    const Comparison both(fitted, target), both_split(split_fitted, split_target.mesh);
    const Quality whole = measure(source, both), cut_open = measure(split.mesh, both_split);
    EXPECT_EQ(cut_open.vertices, whole.vertices);
    EXPECT_EQ(cut_open.copies, split.mesh.positions.rows() - source.positions.rows());
    EXPECT_EQ(cut_open.eq7, whole.eq7);
    EXPECT_EQ(cut_open.vertex_to_target.mean, whole.vertex_to_target.mean);
    EXPECT_EQ(cut_open.target_to_fitted.max, whole.target_to_fitted.max);
    EXPECT_EQ(cut_open.cuts, whole.cuts);
    EXPECT_EQ(cut_open.cuts_target, whole.cuts_target);
    EXPECT_GT(measure(split.mesh, Comparison(split_fitted, split_target.mesh, false)).cuts.size(), 0U);

    const Correspondence map = correspondence(both), split_map = correspondence(both_split);
    const std::vector<WorstPlace> faults = place_faults(source, fitted, map),
                                  split_faults = place_faults(split.mesh, split_fitted, split_map);
    for (std::size_t i = 0; i < split.vertex.size(); ++i) {
        const auto v = static_cast<std::size_t>(split.vertex[i]);
        ASSERT_EQ(split_map.distance[i], map.distance[v]);
        ASSERT_EQ(split_map.agreement[i], map.agreement[v]);
        ASSERT_EQ(split_map.border[i], map.border[v]);
        ASSERT_EQ(split_map.uncovered[i], map.uncovered[v]);
        ASSERT_EQ(split_map.trust[i], map.trust[v]);
        ASSERT_EQ(split_faults[i].badness, faults[v].badness);
    }
}

TEST(FitSeams, TexturesAreCarriedAsFromAWholeMesh) {
    Mesh giver = sphere(3);
    giver.texcoords = giver.positions.leftCols(2).cast<float>();
    giver.texcoord_triangles = giver.triangles;
    Mesh flat = flat_shaded(giver).mesh; // one texture coordinate a vertex, as in glTF
    flat.texcoords = flat.positions.leftCols(2).cast<float>();
    flat.texcoord_triangles = flat.triangles;
    const Mesh receiver = sphere(4);
    const Mesh want = with_attributes(receiver, giver, places_on(receiver, giver)),
               have = with_attributes(receiver, flat, places_on(receiver, flat));
    for (Eigen::Index t = 0; t < receiver.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            ASSERT_EQ(have.texcoords.row(have.texcoord_triangles(t, k)),
                      want.texcoords.row(want.texcoord_triangles(t, k)));
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
