#include "meshtween/fit/renumber.h"

#include "meshtween/fit/surface_fit.h"
#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

using namespace meshtween;

namespace {

// The same mesh with its vertices and triangles in any order; `vertex` and `triangle` tell the number of each before.
struct Shuffled {
    Mesh mesh;
    std::vector<int> vertex, triangle;
};

Shuffled shuffled(const Mesh& mesh, unsigned seed) {
    std::mt19937 random(seed);
    Shuffled result;
    result.vertex.resize(static_cast<std::size_t>(mesh.positions.rows()));
    result.triangle.resize(static_cast<std::size_t>(mesh.triangles.rows()));
    std::vector<int> now(result.vertex.size());
    for (auto* list : {&result.vertex, &result.triangle}) {
        std::iota(list->begin(), list->end(), 0);
        std::shuffle(list->begin(), list->end(), random);
    }
    result.mesh.positions = in_order_of(result.vertex, mesh.positions);
    for (std::size_t i = 0; i < now.size(); ++i) now[static_cast<std::size_t>(result.vertex[i])] = static_cast<int>(i);
    result.mesh.triangles.resize(mesh.triangles.rows(), 3);
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            result.mesh.triangles(t, k) =
                now[static_cast<std::size_t>(mesh.triangles(result.triangle[static_cast<std::size_t>(t)], k))];
    return result;
}

TEST(Renumber, NeighboursAreNearAndTheSameInAnyOrder) {
    const Mesh m = sphere(5);
    const Renumbered one = renumbered(m.positions, m.triangles);
    const Shuffled other = shuffled(m, 1);
    const Renumbered two = renumbered(other.mesh.positions, other.mesh.triangles);
    EXPECT_EQ(one.positions, two.positions);
    EXPECT_EQ(one.triangles, two.triangles);
    EXPECT_EQ(as_before(one.vertex, one.positions), m.positions);
    for (std::size_t t = 0; t < one.triangle.size(); ++t)
        for (int k = 0; k < 3; ++k)
            ASSERT_EQ(one.vertex[static_cast<std::size_t>(one.triangles(static_cast<Eigen::Index>(t), k))],
                      m.triangles(one.triangle[t], k));
    const auto spread = [](const Triangles& triangles) { // between the numbers of a triangle's corners
        return (triangles.rowwise().maxCoeff() - triangles.rowwise().minCoeff()).cast<double>().mean();
    };
    EXPECT_LT(spread(one.triangles), 0.1 * spread(other.mesh.triangles));
}

TEST(SurfaceFit, HowAFileCountsChangesNothing) {
    const Mesh m = bar({4, 1, 1}, {24, 6, 6}, 0.15);
    Mesh target = bar({4, 1, 1}, {26, 7, 7}, 0.15);
    target.positions = bend(target.positions, 4, 1.2);
    const Points goals = bend(m.positions, 4, 1.2);
    const Shuffled other = shuffled(m, 2);
    std::vector<Marker> markers;
    for (int k = 0; k < 12; ++k) {
        const auto t = static_cast<int>(k * m.triangles.rows() / 12);
        markers.push_back({"", {t, {1, 0, 0}}, goals.row(m.triangles(t, 0))});
    }
    std::swap(markers[4].target, markers[5].target); // which turns triangles over
    const FitResult one = surface_fit(m, target, markers);
    for (Marker& marker : markers)
        marker.source.triangle = static_cast<int>(
            std::find(other.triangle.begin(), other.triangle.end(), marker.source.triangle) - other.triangle.begin());
    const FitResult two = surface_fit(other.mesh, shuffled(target, 3).mesh, markers);
    EXPECT_LT((as_before(other.vertex, two.positions) - one.positions).rowwise().norm().maxCoeff(), 1e-9);
    ASSERT_FALSE(one.mended.empty());
    const auto before = [](std::vector<int> list, const std::vector<int>& numbers) {
        for (int& i : list) i = numbers[static_cast<std::size_t>(i)];
        std::sort(list.begin(), list.end());
        return list;
    };
    EXPECT_EQ(before(two.refused, other.vertex), one.refused);
    EXPECT_EQ(before(two.mended, other.triangle), one.mended);
}

} // namespace
