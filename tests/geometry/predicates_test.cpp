#include "meshtween/geometry/predicates.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace meshtween {
namespace {

TEST(Predicates, SidesOfALineAndAPlane) {
    EXPECT_EQ(orient2d({0, 0}, {1, 0}, {0, 1}), 1);
    EXPECT_EQ(orient2d({0, 0}, {0, 1}, {1, 0}), -1);
    EXPECT_EQ(orient2d({0, 0}, {1, 1}, {3, 3}), 0);
    EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 1}), 1);
    EXPECT_EQ(orient3d({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, -1}), -1);
    EXPECT_EQ(orient3d({0, 0, 1}, {1, 0, 2}, {0, 1, 3}, {1, 1, 4}), 0);
}

// Kettner et al., Classroom examples of robustness problems, 2008: near a diagonal the plain evaluation is wrong at
// random. The truth is the sign of integers: positions in units of 2^-53.
TEST(Predicates, AreExactBesideALine) {
    const double u = std::ldexp(1, -53);
    for (int i = 0; i < 64; ++i)
        for (int j = 0; j < 64; ++j) {
            const PlanePoint p(0.5 + i * u, 0.5 + j * u), q(12, 12), r(24, 24);
            EXPECT_EQ(orient2d(p, q, r), (i < j) - (i > j)) << i << ' ' << j;
        }
}

TEST(Predicates, AreExactBesideAPlane) {
    // The plane x + y + z = 3 through points that rounding does not move; the fourth is off it by a known last digit.
    const Point a(3, 0, 0), b(0, 3, 0), c(0, 0, 3);
    const double u = std::ldexp(1, -52);
    for (int i = -20; i <= 20; ++i)
        for (int j = -20; j <= 20; ++j)
            EXPECT_EQ(orient3d(a, b, c, {1 + i * u, 1 + j * u, 1}), (i + j > 0) - (i + j < 0)) << i << ' ' << j;
}

TEST(Predicates, KnowAllPointsOfALatticePlane) {
    // Integers of 16 bits: 64-bit integer arithmetic is the truth; most of the points are put into the plane.
    std::mt19937_64 random(3);
    std::uniform_int_distribution<long> coordinate(-(1 << 16), 1 << 16), small(-3, 3);
    using Integers = Eigen::Matrix<long, 1, 3>;
    int in_plane = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const auto any = [&] { return Integers(coordinate(random), coordinate(random), coordinate(random)); };
        const Integers a = any(), b = any(), c = any();
        const Integers d = trial % 3 ? Integers(a + small(random) * (b - a) + small(random) * (c - a)) : any();
        const long determinant = (b - a).cross(c - a).dot(d - a);
        const int truth = (determinant > 0) - (determinant < 0);
        in_plane += truth == 0;
        const double scale = std::ldexp(1, trial % 60 - 30);
        EXPECT_EQ(orient3d(a.cast<double>() * scale, b.cast<double>() * scale, c.cast<double>() * scale,
                           d.cast<double>() * scale),
                  truth);
    }
    EXPECT_GE(in_plane, 2000);
}

TEST(Predicates, ChangeSignWhenTwoPointsChangePlaces) {
    // Nearly coplanar points with full mantissas: no evaluation order may give two answers.
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    for (int trial = 0; trial < 2000; ++trial) {
        const auto any = [&] { return Point(coordinate(random), coordinate(random), coordinate(random)); };
        const Point a = any(), b = any(), c = any();
        const Point d = a + coordinate(random) * (b - a) + coordinate(random) * (c - a);
        const int s = orient3d(a, b, c, d);
        EXPECT_EQ(orient3d(b, a, c, d), -s);
        EXPECT_EQ(orient3d(b, c, a, d), s);
        EXPECT_EQ(orient3d(d, b, c, a), -s);
        EXPECT_EQ(orient3d(c, d, a, b), s);
    }
}

TEST(Predicates, CollinearPointsInSpace) {
    EXPECT_TRUE(collinear({1, 2, 3}, {2, 4, 6}, {-3, -6, -9}));
    EXPECT_TRUE(collinear({1, 2, 3}, {1, 2, 3}, {5, 5, 5}));
    EXPECT_FALSE(collinear({1, 2, 3}, {2, 4, 6}, {-3, -6, std::nextafter(-9.0, 0.0)}));
}

} // namespace
} // namespace meshtween
