#include "meshtween/fit/region.h"

#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace meshtween;

namespace {

TEST(Region, HoldsTheRingsAroundItsTrianglesWithNumbersOfItsOwn) {
    const Mesh ball = sphere(5);
    const Shell whole = shell(ball.positions, ball.triangles);
    const std::array<int, 1> seed{17};
    const Region region = region_around(whole, ball.positions, seed);
    EXPECT_LT(10 * std::ssize(region.triangles), ball.triangles.rows());
    EXPECT_TRUE(std::ranges::is_sorted(region.triangles) && std::ranges::is_sorted(region.vertices));
    ASSERT_GE(region.triangle(17), 0);
    EXPECT_EQ(region.triangle(region.triangles[5]), 5);
    EXPECT_EQ(region.triangle(static_cast<int>(ball.triangles.rows()) - 1), -1);
    for (std::size_t t = 0; t < region.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const int own = region.shell.triangles(static_cast<Eigen::Index>(t), k);
            EXPECT_EQ(region.vertices[static_cast<std::size_t>(own)], ball.triangles(region.triangles[t], k));
            EXPECT_EQ(region.shell.rest.row(own), ball.positions.row(ball.triangles(region.triangles[t], k)));
        }
    for (int k = 0; k < 3; ++k) { // whole fans inside, a border at the rim
        const int own = region.shell.triangles(region.triangle(17), k);
        EXPECT_EQ(region.shell.topology.vertex_triangles[own].size(),
                  whole.topology.vertex_triangles[ball.triangles(17, k)].size());
        EXPECT_EQ(region.shell.topology.on_boundary[static_cast<std::size_t>(own)], 0);
    }
    EXPECT_GT(std::ranges::count(region.shell.topology.on_boundary, 1), 10);
}

TEST(Region, HoldsOtherSheetsThatLieThere) {
    const Mesh ball = sphere(5);
    const Shell whole = shell(ball.positions, ball.triangles);
    Points lens = ball.positions; // as flat as paper: the other side is far along the surface, and near
    lens.col(2) *= 1e-3;
    int top = 0, bottom = 0;
    for (int t = 1; t < static_cast<int>(ball.triangles.rows()); ++t) {
        const auto height = [&](int s) { return ball.positions(ball.triangles(s, 0), 2); };
        if (height(t) > height(top)) top = t;
        if (height(t) < height(bottom)) bottom = t;
    }
    const std::array<int, 1> seed{top};
    EXPECT_LT(region_around(whole, ball.positions, seed).triangle(bottom), 0);
    EXPECT_GE(region_around(whole, lens, seed).triangle(bottom), 0);
}

} // namespace
