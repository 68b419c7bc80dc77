#include "meshtween/geometry/implicit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace meshtween {
namespace {

TEST(Implicit, SmoothMinIsTheMinFarFromTheCrease) {
    EXPECT_EQ(smooth_min(1, 3, 0.5), 1);
    EXPECT_EQ(smooth_min(3, 1, 0.5), 1);
    EXPECT_LT(smooth_min(1, 1, 0.5), 1);
    EXPECT_GT(smooth_min(1, 1, 0.5), 0.9);
}

TEST(Implicit, SmoothStepRunsFromNoughtToOne) {
    EXPECT_EQ(smooth_step(2, 4, 1), 0);
    EXPECT_EQ(smooth_step(2, 4, 5), 1);
    EXPECT_NEAR(smooth_step(2, 4, 3), 0.5, 1e-12);
}

TEST(Implicit, EllipsoidVanishesOnItsSurface) {
    const Part e = ellipsoid({1, 2, 3}, {0.5, 1, 2});
    for (const Point& p : {Point(1.5, 2, 3), Point(1, 3, 3), Point(1, 2, 1)}) EXPECT_NEAR(e.distance(p), 0, 1e-12);
    EXPECT_LT(e.distance({1, 2, 3}), 0);
    EXPECT_GT(e.distance({3, 2, 3}), 0);
    const Part turned = ellipsoid({0, 0, 0}, {1, 1, 2}, -90); // z towards y
    EXPECT_NEAR(turned.distance({0, 2, 0}), 0, 1e-9);
}

TEST(Implicit, RoundConeIsTheHullOfTwoBalls) {
    const Part cone = round_cone({0, 0, 0}, 1, {0, 4, 0}, 0.5);
    EXPECT_NEAR(cone.distance({0, -1, 0}), 0, 1e-12);
    EXPECT_NEAR(cone.distance({0, 4.5, 0}), 0, 1e-12);
    EXPECT_NEAR(cone.distance({0, 7, 0}), 2.5, 1e-12);
    // Points of the tangent line lie on both balls' tangent: at slope s its normal is (sqrt(1 - s^2), s).
    const double s = 0.5 / 4, c = std::sqrt(1 - s * s);
    EXPECT_NEAR(cone.distance({0.75 * c, 2 + 0.75 * s, 0}), 0, 1e-12);
}

TEST(Implicit, LoftMeetsItsSections) {
    const Part body =
        loft({{0, 0, 0}, {0, 2, 0}, {0, 0, 1}, {{0, 1, 1, 1}, {1, 0.5, 0.4, 0.3}, {2, 1, 1, 1}}, 0.2, 0.3});
    EXPECT_NEAR(body.distance({0.5, 1, 0}), 0, 1e-12);
    EXPECT_NEAR(body.distance({-0.5, 1, 0}), 0, 1e-12);
    EXPECT_NEAR(body.distance({0, 1, 0.4}), 0, 1e-12);
    EXPECT_NEAR(body.distance({0, 1, -0.3}), 0, 1e-12);
    EXPECT_NEAR(body.distance({0, -0.2, 0}), 0, 1e-12);
    EXPECT_NEAR(body.distance({0, 2.3, 0}), 0, 1e-12);
}

TEST(Implicit, OntoSurfaceAndShotLandOnIt) {
    const Field ball = [](const Point& p) { return p.norm() - 2; };
    EXPECT_NEAR(onto_surface(ball, {1, 1, 1}, 1e-4).norm(), 2, 1e-9);
    EXPECT_LT((shoot(ball, {0, 0, 0}, {0, 3, 0}, 5) - Point(0, 2, 0)).norm(), 1e-9);
}

TEST(Sculpture, PartsAreMirroredCarvedAndCutOff) {
    Sculpture body;
    body.add(ellipsoid({0, 1, 0}, {1, 1, 1}), 0.1);
    body.add_pair(ellipsoid({2, 1, 0}, {0.5, 0.5, 0.5}), 0.1);
    EXPECT_LT(body({-2, 1, 0}), 0);
    EXPECT_NEAR(body({-2, 1, 0}), body({2, 1, 0}), 1e-12);
    body.carve_pair(ellipsoid({0.5, 1, 1}, {0.2, 0.2, 0.2}), 0.02);
    EXPECT_GT(body({0.5, 1, 0.85}), 0);
    EXPECT_LT(body({0, 0.3, 0}), 0);
    body.floor(0.5, 0.02);
    EXPECT_GT(body({0, 0.3, 0}), 0);
    EXPECT_LT(body({0, 0.6, 0}), 0);
}

} // namespace
} // namespace meshtween
