#include "meshtween/fit/cut_length.h"

#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace meshtween;

namespace {

std::optional<double> of_two(const Point& a, const Point& b, const Point& c) {
    Points x(6, 3);
    x << 0, 0, 0, 4, 0, 0, 0, 4, 0, a, b, c;
    const Triangles triangles{{0, 1, 2}, {3, 4, 5}};
    const Sheet first = sheet(x, triangles, 0), second = sheet(x, triangles, 1);
    const auto length = cut_length(first, second);
    EXPECT_EQ(cut_length(second, first), length) << "either way";
    return length;
}

TEST(CutLength, IsThatOfTheLineInBothTriangles) {
    EXPECT_DOUBLE_EQ(of_two({1, 1, -1}, {1, 1, 1}, {2, 1, 0}).value(), 1)
        << "an edge goes through, a corner lies in it";
    EXPECT_DOUBLE_EQ(of_two({-1, 1, -1}, {9, 1, -1}, {1, 1, 3}).value(), 3) << "all across";
    EXPECT_FALSE(of_two({3, 3, -1}, {3, 3, 1}, {9, 9, 1}));
    EXPECT_FALSE(of_two({1, 1, 1e-3}, {1, 2, 1}, {2, 1, 1}));
    EXPECT_FALSE(of_two({1, 1, -1}, {1, 1, -2}, {2, 1, -1}));
}

TEST(CutLength, FallsAsTrianglesPart) {
    double last = 9;
    for (const double height : {-0.5, -0.25, -0.125, -0.0625}) {
        const double length = of_two({1, 1, height}, {1, 2, 1}, {2, 1, 1}).value();
        EXPECT_LT(length, last);
        last = length;
    }
}

TEST(CutLength, FromASharedCornerToWhereAnEdgeGoesThrough) {
    Points x(5, 3);
    x << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 1;
    const auto of_two = [&](const Triangles& triangles) {
        return cut_length(sheet(x, triangles, 0), sheet(x, triangles, 1));
    };
    EXPECT_DOUBLE_EQ(of_two(Triangles{{0, 1, 2}, {0, 3, 4}}).value(), std::sqrt(2.0));
    x.row(3) << 1, 1, 2;
    EXPECT_FALSE(of_two(Triangles{{0, 1, 2}, {0, 3, 4}}));
    EXPECT_FALSE(of_two(Triangles{{0, 1, 2}, {0, 1, 3}})) << "an edge is shared";
}

TEST(CutLength, TrianglesBesideCutsAreThoseOfAFewRings) {
    const Mesh mesh = sphere(3);
    const Shell rest = shell(mesh.positions, mesh.triangles);
    const std::array<int, 2> pair{0, 7};
    const std::vector<int> beside = beside_cuts(rest, {&pair, 1});
    EXPECT_TRUE(std::ranges::is_sorted(beside));
    EXPECT_TRUE(std::ranges::binary_search(beside, 0) && std::ranges::binary_search(beside, 7));
    EXPECT_GT(beside.size(), 40U);
    EXPECT_LT(std::ssize(beside), mesh.triangles.rows() / 4);
}

} // namespace
