#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/morph/laplacian_coordinates.h"
#include "meshtween/morph/morph.h"
#include "support/posed.h"

#include <gtest/gtest.h>

namespace meshtween {
namespace {

const Eigen::Vector3d axis(1, 2, 0.5);

TEST(LaplacianCoordinates, BlendIsQuadraticInU) {
    const Points a = test::shaken(Points::Zero(20, 3), 1, 1), b = test::shaken(Points::Zero(20, 3), 1, 2);
    for (const double u : {0.0, 0.2, 0.5, 0.9, 1.0})
        EXPECT_LT(test::distance(blended_coordinates(a, b, u), quadratic(a, middle_coordinates(a, b), b, u)), 1e-14);
}

TEST(LaplacianCoordinates, NoLengthNoDirectionNoNan) {
    const Points none = Points::Zero(1, 3);
    Points some(1, 3);
    some << 0, 2, 0;
    EXPECT_EQ(blended_coordinates(none, none, 0.5).norm(), 0);
    EXPECT_NEAR((blended_coordinates(none, some, 0.5) - 0.25 * some).norm(), 0, 1e-15);
    EXPECT_EQ(blended_coordinates(none, some, 1), some);
}

TEST(Dual, ATurnedShapeStaysCongruent) {
    const Mesh from = test::bar(12, 3);
    for (const double angle : {0.5, 2.0, 3.0}) {
        const Points to = test::turned(from.positions, angle, axis, {4, 5, 6});
        const Morph path = morph(from, to, {.method = MorphMethod::dual});
        for (const double u : {0.25, 0.5, 0.8})
            EXPECT_LT(test::edge_error(from.triangles, from.positions, to, path.at(u), u), 1e-9);
    }
}

TEST(Dual, DoesNotDependOnTheOriginOrTheFrame) {
    const Mesh from = test::bar(20, 3);
    const Points to = test::bent(from.positions, 1.5);
    const Points here = morph(from, to, {.method = MorphMethod::dual}).at(0.5);
    const Point shift(300, -200, 100);
    Mesh far = from;
    far.positions.rowwise() += shift;
    const Points there = morph(far, to.rowwise() + shift, {.method = MorphMethod::dual}).at(0.5);
    EXPECT_LT(test::distance(here.rowwise() + shift, there), 1e-5 * diagonal(to));
    const Points turned = morph(from, test::turned(to, 2, axis), {.method = MorphMethod::dual}).at(0.5);
    EXPECT_LT(test::edge_error(from.triangles, here, here, turned), 1e-6);
}

TEST(Dual, AsPrintedDependsOnTheOrigin) { // why `dual` repairs it
    const Mesh from = test::bar(20, 3);
    const Points to = test::bent(from.positions, 1.5);
    const MorphOptions options{.method = MorphMethod::dual_as_printed};
    const Point shift(300, -200, 100);
    Mesh far = from;
    far.positions.rowwise() += shift;
    const Points here = morph(from, to, options).at(0.5);
    const Points there = morph(far, to.rowwise() + shift, options).at(0.5);
    EXPECT_GT(test::distance(here.rowwise() + shift, there), 0.01 * diagonal(to));
}

TEST(Dual, KeepsMoreVolumeThanStraightLines) { // Fig. 7 and 15, bars of 90 degrees
    const Mesh from = test::bar(40, 4);
    const Points to = test::bent(from.positions, 90 * test::degree);
    const double whole = volume(from.positions, from.triangles);
    const auto kept = [&](MorphMethod method) {
        return volume(morph(from, to, {.method = method}).at(0.5), from.triangles) / whole;
    };
    const double straight = kept(MorphMethod::linear), dual = kept(MorphMethod::dual);
    EXPECT_LT(straight, 0.9);
    EXPECT_GT(dual, 0.94);
    EXPECT_LT(dual, 1.02);
}

TEST(Dual, ReportsItsSolve) {
    const Mesh from = test::bar(20, 3);
    const Points to = test::bent(from.positions, 1.5);
    const SolveReport repaired = morph(from, to, {.method = MorphMethod::dual}).report();
    EXPECT_TRUE(repaired.converged);
    EXPECT_GT(repaired.sweeps, 10);
    EXPECT_LT(repaired.residual, 1e-4);
    const Morph printed = morph(from, to, {.method = MorphMethod::dual_as_printed, .max_sweeps = 2});
    EXPECT_EQ(printed.report().sweeps, 0);
    printed.at(0.5);
    EXPECT_EQ(printed.report().sweeps, 2);
    EXPECT_FALSE(printed.report().converged);
}

} // namespace
} // namespace meshtween
