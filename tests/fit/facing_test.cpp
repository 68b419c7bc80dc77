#include "meshtween/fit/facing.h"

#include "meshtween/fit/settle.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace meshtween;

namespace {

// Two sheets that meet in a sharp ridge along y: the roof's sides look along (-2, 0, 1) and (2, 0, 1).
FitTarget roof() {
    Points x(6, 3);
    x << 0, 0, 0, 0, 1, 0, -1, 0, -2, -1, 1, -2, 1, 0, -2, 1, 1, -2;
    Triangles f(4, 3);
    f << 0, 1, 3, 0, 3, 2, 0, 4, 5, 0, 5, 1;
    return fit_target(x, f);
}

TEST(Facing, BothSidesOfAnEdgeCount) {
    const FitTarget target = roof();
    const Point above(0, 0.5, 0.1), left(-2, 0, 1);
    EXPECT_FALSE(facing(above, {0, 0, 3}, target).into());
    const Facing across = facing(above, left, target);
    EXPECT_NEAR(across.cosine, -3.0 / 5, 1e-12) << "the right side's normal, although the left one's agrees";
    EXPECT_NEAR(across.detour, 0, 1e-12);
    EXPECT_NEAR(facing({0, 0, 0.1}, left, target).cosine, -3.0 / 5, 1e-12) << "at a corner";
    EXPECT_FALSE(facing({-0.3, 0.5, -0.5}, left, target).into()) << "within a triangle its own normal counts";
}

TEST(Facing, TheDetourLeadsToTheSideThatAgrees) {
    const FitTarget target = roof();
    const Point right(2, 0, 1), at = Point(0.2, 0.5, -0.4) - 0.1 * right / std::sqrt(5.0); // under the right side
    const Facing wrong = facing(at, {-1, 0, 0}, target);
    EXPECT_TRUE(wrong.into());
    EXPECT_NEAR(std::sqrt(wrong.squared_distance), 0.1, 1e-12);
    const double to_left = std::abs(at.dot(Point(-2, 0, 1)) / std::sqrt(5.0));
    EXPECT_NEAR(wrong.detour, to_left - 0.1, 1e-12);
    EXPECT_EQ(facing(at, right, target).detour, 0);
}

TEST(Facing, HoldsWhatFlippedTrianglesFinds) {
    const FitTarget target = roof();
    Points x(6, 3);
    x << 0.2, 0.4, -0.4, 0.3, 0.5, -0.6, 0.2, 0.6, -0.4, -0.1, 0.4, 0.3, 0.1, 0.5, 0.3, 0, 0.6, 0.32;
    Triangles f(3, 3);
    f << 0, 1, 2, 0, 2, 1, 3, 4, 5;
    const std::vector<int> flips = flipped_triangles(x, f, target);
    EXPECT_EQ(flips.size(), 1U);
    EXPECT_EQ(facing_into(x, f, target), flips);
    FacingWatch watch(f, target, EdgeSides::both, {3, 0, 2}); // hints change nothing, good or bad
    EXPECT_EQ(watch.into(x), flips);
    x.row(4).swap(x.row(5)); // turns the last triangle over
    EXPECT_EQ(watch.into(x), (std::vector<int>{flips.front(), 2}));
    EXPECT_EQ(watch.into(x), facing_into(x, f, target));
}

} // namespace
