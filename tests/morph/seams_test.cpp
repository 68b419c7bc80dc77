// Whatever seams cut a file's numbering, paths are those of the whole mesh.
#include "meshtween/geometry/measure.h"
#include "meshtween/morph/keys.h"

#include "support/cut.h"
#include "support/posed.h"

#include <gtest/gtest.h>

namespace meshtween {
namespace {

const Mesh whole = test::bar(12, 3);
const CutMesh split = cut_along(whole, random_seams(whole, 5, 6, 1)), flat = flat_shaded(whole);

std::vector<Points> shapes() {
    return {whole.positions, test::bent(whole.positions, 1.5), test::twisted(whole.positions, 2)};
}

std::vector<Points> shapes(const CutMesh& cut) {
    std::vector<Points> all;
    for (const Points& shape : shapes()) all.push_back(cut.whole(shape));
    return all;
}

TEST(MorphSeams, EveryMethodKeepsThemClosed) {
    for (const MorphMethod method : morph_methods()) {
        MorphOptions options;
        options.method = method;
        options.tolerance = 1e-13, options.max_sweeps = 100000; // where sweeps stop hangs on the numbering
        const Morph plain = morph(whole, shapes()[1], options);
        for (const CutMesh* cut : {&split, &flat}) {
            const Morph path = morph(cut->mesh, shapes(*cut)[1], options);
            for (const double u : {0.0, 0.3, 1.0}) {
                const Points have = path.at(u), want = cut->whole(plain.at(u));
                if (cut == &split) {
                    EXPECT_EQ(have, want) << name_of(method) << u;
                } else {
                    EXPECT_LT((have - want).rowwise().norm().maxCoeff(), 1e-9 * diagonal(want)) << name_of(method) << u;
                }
                for (std::size_t i = 0; i < cut->vertex.size(); ++i)
                    for (std::size_t j = 0; j < i; ++j)
                        if (cut->vertex[i] == cut->vertex[j]) {
                            ASSERT_EQ(have.row(static_cast<Eigen::Index>(i)), have.row(static_cast<Eigen::Index>(j)))
                                << name_of(method);
                        }
            }
        }
    }
}

TEST(MorphSeams, PathsThroughKeysAndBlends) {
    KeyOptions options;
    options.repair = RepairOptions();
    options.timing = region_timing(whole, {{0, 0, 0.5}, {static_cast<int>(whole.positions.rows()) - 1, 0.5, 1}});
    KeyOptions cut_options = options;
    cut_options.timing = RegionTiming{Eigen::VectorXd(options.timing->start(split.vertex)),
                                      Eigen::VectorXd(options.timing->end(split.vertex))};
    const Curve plain = key_path(whole, shapes(), options).curve,
                path = key_path(split.mesh, shapes(split), cut_options).curve;
    ASSERT_EQ(path.nodes.size(), plain.nodes.size());
    for (const double u : {0.0, 0.2, 0.5, 0.9, 1.0}) EXPECT_EQ(path.at(u), split.whole(plain.at(u))) << u;
    const std::vector<double> weights{0.5, 0.8, -0.3};
    EXPECT_EQ(blend(split.mesh, shapes(split), weights), split.whole(blend(whole, shapes(), weights)));
}

// A mouth that is closed in one shape and open in the other is no seam.
TEST(MorphSeams, WhatOpensIsABorder) {
    const Mesh& mesh = split.mesh;
    Points open = mesh.positions;
    for (Eigen::Index i = whole.positions.rows(); i < open.rows(); ++i) open(i, 0) += 0.1;
    const Points half = morph(mesh, open).at(0.5);
    double gap = 0;
    for (std::size_t i = 0; i < split.vertex.size(); ++i)
        gap = std::max(gap, (half.row(static_cast<Eigen::Index>(i)) - half.row(split.vertex[i])).norm());
    EXPECT_GT(gap, 0.01);
}

TEST(MorphSeams, SwitchedOffTheMeshIsCut) {
    MorphOptions options;
    options.weld = false;
    const Points half = morph(flat.mesh, shapes(flat)[2], options).at(0.5);
    EXPECT_GT((half - flat.whole(morph(whole, shapes()[2]).at(0.5))).rowwise().norm().maxCoeff(), 1e-6);
}

} // namespace
} // namespace meshtween
