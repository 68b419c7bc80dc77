#include "meshtween/fit/fold_patches.h"

#include "meshtween/fit/membrane.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace meshtween;

namespace {

struct Ball {
    Mesh mesh = sphere(3);
    Shell rest;
    FitTarget target;
    Ball() : rest(shell(mesh.positions / 2, mesh.triangles)), target(fit_target(mesh.positions / 2, mesh.triangles)) {}
};

// The triangles whose centres lie between two heights.
std::vector<int> band(const Mesh& ball, double low, double high) {
    std::vector<int> triangles;
    for (Eigen::Index t = 0; t < ball.triangles.rows(); ++t) {
        double height = 0;
        for (int k = 0; k < 3; ++k) height += ball.positions(ball.triangles(t, k), 2) / 3;
        if (height > low && height < high) triangles.push_back(static_cast<int>(t));
    }
    return triangles;
}

TEST(FoldedPatches, TheSmallerSideOfARingIsItsHole) {
    const Ball ball;
    TangleSearch search{ball.rest, ball.target, {}};
    Eigen::Index top = 0, bottom = 0;
    ball.mesh.positions.col(2).maxCoeff(&top);
    ball.mesh.positions.col(2).minCoeff(&bottom);
    FoldedPatches patches = patches_around(search, {band(ball.mesh, 0.5, 0.7), {}}, 1);
    ASSERT_EQ(patches.list.size(), 1U);
    EXPECT_EQ(patches.of[static_cast<std::size_t>(top)], -1);
    const std::size_t before = patches.list[0].vertices.size();
    fill_holes(search, patches);
    const FoldedPatch& patch = patches.list[0];
    EXPECT_GT(patch.vertices.size(), before);
    EXPECT_EQ(patch.remote.size(), patch.vertices.size());
    EXPECT_TRUE(std::ranges::is_sorted(patch.vertices));
    EXPECT_EQ(patches.of[static_cast<std::size_t>(top)], 0);
    EXPECT_EQ(patches.of[static_cast<std::size_t>(bottom)], -1);
}

TEST(FoldedPatches, BetweenTwoPatchesIsNoHole) {
    const Ball ball;
    TangleSearch search{ball.rest, ball.target, {}};
    std::vector<int> both = band(ball.mesh, 0.6, 0.75);
    const std::vector<int> below = band(ball.mesh, -0.75, -0.6);
    both.insert(both.end(), below.begin(), below.end());
    FoldedPatches patches = patches_around(search, {both, {}}, 1);
    ASSERT_EQ(patches.list.size(), 2U);
    fill_holes(search, patches);
    Eigen::Index top = 0;
    ball.mesh.positions.col(2).maxCoeff(&top);
    EXPECT_GE(patches.of[static_cast<std::size_t>(top)], 0);
    for (Eigen::Index i = 0; i < ball.mesh.positions.rows(); ++i)
        if (std::abs(ball.mesh.positions(i, 2)) < 0.3) {
            EXPECT_EQ(patches.of[static_cast<std::size_t>(i)], -1) << i;
        }
}

// A long cone over a flat round rim, of rings that turn against each other.
TEST(Membrane, WhatStandsUpLiesInOneLayerOverItsRim) {
    constexpr int around = 12, rings = 6;
    Mesh cone;
    cone.positions.resize(around * rings + 1, 3);
    cone.triangles.resize(around * (2 * (rings - 1) + 1), 3);
    const auto at = [](int ring, int k) { return 1 + ring * around + k % around; }; // the rim is the last ring
    cone.positions.row(0) << 0, 0, 5;
    int t = 0;
    for (int ring = 0; ring < rings; ++ring)
        for (int k = 0; k < around; ++k) {
            const double angle = 2 * EIGEN_PI * (k + 0.5 * ring) / around, wide = (ring + 1.0) / rings;
            cone.positions.row(at(ring, k)) << wide * std::cos(angle), wide * std::sin(angle), 5 * (1 - wide);
            if (ring == 0) {
                cone.triangles.row(t++) << 0, at(0, k), at(0, k + 1);
                continue;
            }
            cone.triangles.row(t++) << at(ring, k), at(ring - 1, k + 1), at(ring - 1, k);
            cone.triangles.row(t++) << at(ring, k), at(ring, k + 1), at(ring - 1, k + 1);
        }
    const Eigen::Index free = 1 + around * (rings - 1);
    const Points flat = membrane(cone.positions, cone.triangles, free);
    EXPECT_EQ(flat.bottomRows(around), cone.positions.bottomRows(around));
    EXPECT_LT(flat.col(2).cwiseAbs().maxCoeff(), 1e-12);
    for (Eigen::Index f = 0; f < cone.triangles.rows(); ++f)
        EXPECT_GT(double_area_normal(flat, cone.triangles, f)[2], 0) << f;
}

TEST(Membrane, WithoutARimNothingMoves) {
    const Mesh ball = sphere(1);
    EXPECT_LT((membrane(ball.positions, ball.triangles, ball.positions.rows()) - ball.positions).norm(), 1e-12);
}

} // namespace
