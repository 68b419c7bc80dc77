#include "meshtween/geometry/shapes.h"

#include "meshtween/geometry/measure.h"

#include "support/closed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meshtween {
namespace {

constexpr double pi = std::numbers::pi;

TEST(Shapes, SphereIsRound) {
    const Mesh ball = sphere(3);
    EXPECT_EQ(ball.positions.rows(), 642);
    EXPECT_TRUE(closed(ball));
    EXPECT_EQ(euler(ball), 2);
    EXPECT_LT((ball.positions.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
    EXPECT_NEAR(volume(ball.positions, ball.triangles), 4 * pi / 3, 0.05);
}

TEST(Shapes, SharpBarFillsItsBox) {
    const Mesh b = bar({4, 1, 2}, {8, 2, 4});
    EXPECT_TRUE(closed(b));
    EXPECT_EQ(euler(b), 2);
    EXPECT_NEAR(volume(b.positions, b.triangles), 8, 1e-12);
    EXPECT_NEAR(surface_area(b.positions, b.triangles), 2 * (4 + 8 + 2), 1e-12);
    EXPECT_NEAR(diagonal(b), std::sqrt(16 + 1 + 4), 1e-12);
}

TEST(Shapes, RoundedBarKeepsItsExtent) {
    const Mesh b = bar({4, 1, 1}, {32, 8, 8}, 0.2);
    EXPECT_TRUE(closed(b));
    EXPECT_LT(volume(b.positions, b.triangles), 4);
    EXPECT_GT(volume(b.positions, b.triangles), 3.7);
    EXPECT_NEAR(b.positions.col(0).maxCoeff() - b.positions.col(0).minCoeff(), 4, 1e-12);
}

TEST(Shapes, TorusHasOneHandle) {
    const Mesh t = torus(2, 0.5, 96, 48);
    EXPECT_TRUE(closed(t));
    EXPECT_EQ(euler(t), 0);
    EXPECT_NEAR(volume(t.positions, t.triangles), 2 * pi * pi * 2 * 0.25, 0.05);
}

TEST(Shapes, BendKeepsVolumeAndTheAxis) {
    const Mesh b = bar({4, 1, 1}, {64, 16, 16});
    const Points bent = bend(b.positions, 4, pi);
    // By Pappus the volume is that of the straight bar; the flat facets of the arc lose a little of it.
    EXPECT_NEAR(volume(bent, b.triangles), 4, 0.004);
    Points axis(3, 3);
    axis << 0, 0, 0, 2, 0, 0, 4, 0, 0;
    const double r = 4 / pi;
    const Points arc = bend(axis, 4, pi);
    EXPECT_LT((arc.row(1) - Point(r, r, 0)).norm(), 1e-12);
    EXPECT_LT((arc.row(2) - Point(0, 2 * r, 0)).norm(), 1e-12);
    EXPECT_EQ(bend(axis, 4, 0), axis);
}

TEST(Shapes, TwistKeepsSections) {
    const Mesh b = bar({4, 1, 1}, {64, 16, 16});
    const Points twisted = twist(b.positions, 4, pi);
    EXPECT_EQ(twisted.col(0), b.positions.col(0));
    EXPECT_LT((twisted.rowwise().norm() - b.positions.rowwise().norm()).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Shapes, ThreeThirdsOfATurnAreNone) {
    const Points start = sphere(1).positions;
    Points p = start;
    for (int i = 0; i < 3; ++i) p = turn(p, {1, 2, 0.5}, 2 * pi / 3);
    EXPECT_LT((p - start).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_GT((turn(start, {1, 2, 0.5}, 2 * pi / 3) - start).cwiseAbs().maxCoeff(), 1);
}

} // namespace
} // namespace meshtween
