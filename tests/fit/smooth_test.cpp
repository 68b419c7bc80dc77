#include "meshtween/fit/smooth.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace meshtween {
namespace {

Mesh grid(int n) { // the unit square in n x n cells, each cut along the same diagonal
    Mesh mesh;
    mesh.positions.resize((n + 1) * (n + 1), 3);
    mesh.triangles.resize(2 * n * n, 3);
    const auto id = [&](int i, int j) { return i * (n + 1) + j; };
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) mesh.positions.row(id(i, j)) << i / double(n), j / double(n), 0;
    for (int i = 0, t = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            mesh.triangles.row(t++) << id(i, j), id(i + 1, j), id(i + 1, j + 1);
            mesh.triangles.row(t++) << id(i, j), id(i + 1, j + 1), id(i, j + 1);
        }
    return mesh;
}

Points smoothed(const Mesh& mesh, int times, double strength = 1) {
    const Surroundings around = surroundings(mesh.positions.rows(), mesh.triangles);
    Points positions = mesh.positions;
    for (int i = 0; i < times; ++i) positions = smooth(positions, mesh.triangles, around, strength);
    return positions;
}

TEST(Smooth, FollowsItsFormula) { // Eq. 6 by hand: a pyramid's apex over a square, one half of which is cut again
    Mesh fan;
    fan.positions.resize(5, 3);
    fan.positions << 0, 0, 1, 1, 1, 0, -1, 1, 0, -1, -1, 0, 1, -1, 0;
    fan.triangles.resize(4, 3);
    fan.triangles << 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1;
    const Points once = smoothed(fan, 1);
    EXPECT_LT((once.row(0) - Point(0, 0, 1.0 / 3)).norm(), 1e-15); // equal areas; centres at a third of the height
    fan.positions.row(1) << 3, 3, 0;
    Point sum = Point::Zero();
    double total = 0;
    for (int t = 0; t < 4; ++t) {
        const Point a = fan.positions.row(0), b = fan.positions.row(fan.triangles(t, 1)),
                    c = fan.positions.row(fan.triangles(t, 2));
        const double area = (b - a).cross(c - a).norm() / 2;
        sum += area * (a + b + c) / 3;
        total += area;
    }
    EXPECT_LT((smoothed(fan, 1).row(0) - sum / total).norm(), 1e-15);
}

TEST(Smooth, ASphereStaysRound) {
    const Mesh ball = sphere(4);
    const Points positions = smoothed(ball, 50);
    const Eigen::VectorXd radius = positions.rowwise().norm();
    EXPECT_LT(radius.maxCoeff() / radius.minCoeff(), 1.02);
    EXPECT_LT(positions.colwise().mean().norm(), 1e-12);
    EXPECT_LT(radius.maxCoeff(), 1); // it shrinks: that is what projection is for
}

TEST(Smooth, TakesNoiseAway) {
    Mesh ball = sphere(4);
    std::srand(1);
    ball.positions += 0.02 * Points::Random(ball.positions.rows(), 3);
    const auto roughness = [](const Points& p) {
        const Eigen::ArrayXd radius = p.rowwise().norm().array();
        return std::sqrt((radius - radius.mean()).square().mean());
    };
    EXPECT_LT(roughness(smoothed(ball, 5)), 0.25 * roughness(ball.positions));
}

TEST(Smooth, BoundariesStayWhereTheyAre) { // a square's sides stay lines, its outline stays the square but for corners
    Mesh square = grid(8);
    for (Eigen::Index i = 0; i < square.positions.rows(); ++i) // uneven along x, the sides still straight
        square.positions(i, 0) *= square.positions(i, 0);
    const Points after = smoothed(square, 30);
    const Surroundings around = surroundings(square.positions.rows(), square.triangles);
    double moved = 0;
    for (Eigen::Index i = 0; i < after.rows(); ++i) {
        if (around.rim[i].empty()) continue;
        const Point before = square.positions.row(i);
        if (before.x() > 0 && before.x() < 1 && (before.y() == 0 || before.y() == 1)) {
            const double from_corner = std::min(before.x(), 1 - before.x());
            if (from_corner > 0.3) {
                EXPECT_NEAR(after(i, 1), before.y(), 0.02) << i;
            }
            moved = std::max(moved, std::abs(after(i, 0) - before.x()));
        }
    }
    EXPECT_GT(moved, 0.05); // and even out along it
    EXPECT_EQ(after.col(2).norm(), 0);
}

TEST(Smooth, StrengthIsThePartOfTheWay) {
    const Mesh ball = sphere(2);
    const Points none = smoothed(ball, 1, 0), half = smoothed(ball, 1, 0.5), all = smoothed(ball, 1, 1);
    EXPECT_EQ(none, ball.positions);
    EXPECT_LT((half - (none + all) / 2).norm(), 1e-14);
}

TEST(Smooth, WithoutAreaOrTriangles) {
    Mesh mesh;
    mesh.positions.resize(5, 3);
    mesh.positions << 0, 0, 0, 1, 0, 0, 2, 0, 0, 5, 5, 5, 0, 0, 0;
    mesh.triangles.resize(2, 3);
    mesh.triangles << 0, 1, 2, 2, 1, 0; // two-sided and flat: no boundary, no area
    const Points after = smoothed(mesh, 3);
    EXPECT_TRUE(after.allFinite());
    EXPECT_EQ(Point(after.row(3)), Point(5, 5, 5));
    EXPECT_LT((smoothed(mesh, 1).row(0) - Point(1.5, 0, 0)).norm(), 1e-15);
}

TEST(Smooth, SameBitsForAnyThreads) {
    const Mesh ball = sphere(5);
    set_threads(1);
    const Points one = smoothed(ball, 3);
    set_threads(2);
    EXPECT_EQ(smoothed(ball, 3), one);
    set_threads(0);
}

} // namespace
} // namespace meshtween
