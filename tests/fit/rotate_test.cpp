#include "meshtween/fit/rotate.h"

#include "meshtween/core/error.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <numbers>

namespace meshtween {
namespace {

Points corners(double x) { // of a square across the x axis
    Points points(4, 3);
    points << x, -1, -1, x, 1, -1, x, 1, 1, x, -1, 1;
    return points;
}

Point turned(const Point& p, double degrees) { // about the x axis
    return (Eigen::AngleAxisd(degrees * std::numbers::pi / 180, Eigen::Vector3d::UnitX()) * p.transpose()).transpose();
}

TEST(Rotate, TurnsWhatTurnsAndHoldsWhatHolds) {
    for (const double angle : {20.0, 90.0, -140.0, 400.0}) {
        Points all(8, 3);
        all << corners(5), corners(0);
        const Points moved = rotate(all, corners(5), corners(0), {2, 0, 0}, {0, 0, 0}, angle);
        for (int i = 0; i < 4; ++i) {
            EXPECT_LT((moved.row(i) - turned(all.row(i), angle)).norm(), 1e-8) << angle;
            EXPECT_LT((moved.row(i + 4) - all.row(i + 4)).norm(), 1e-8) << angle;
        }
    }
}

TEST(Rotate, NoAngleNoMove) {
    const Points points = Points::Random(20, 3);
    EXPECT_EQ(rotate(points, corners(1), corners(0), {0, 1, 0}, {0, 0, 0}, 0), points);
}

TEST(Rotate, WhereAllTurnsItIsARotation) {
    Points all(8, 3);
    all << corners(5), corners(0);
    const Points points = Points::Random(50, 3);
    const Points moved = rotate(points, all, Points(0, 3), {1, 0, 0}, {7, 0, 0}, 200);
    for (int i = 0; i < 50; ++i) EXPECT_LT((moved.row(i) - turned(points.row(i), 200)).norm(), 1e-9);
}

TEST(Rotate, RefusesWhatCannotBeMeant) {
    const Points p = corners(0);
    EXPECT_THROW(rotate(p, corners(1), p, {0, 0, 0}, {0, 0, 0}, 30), Error);
    EXPECT_THROW(rotate(p, corners(1), p, {0, 1, 0}, {0, 0, 0}, std::numeric_limits<double>::infinity()), Error);
    EXPECT_THROW(rotate(p, corners(1), p, {0, 1, 0}, {0, 0, 0}, 30, {.max_step = 0, .warp = {}}), Error);
}

} // namespace
} // namespace meshtween
