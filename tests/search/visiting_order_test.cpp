#include "meshtween/search/visiting_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace meshtween::search {
namespace {

Points random_points(Eigen::Index count) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> coordinate(-3, 5);
    return Points::NullaryExpr(count, 3, [&] { return coordinate(random); });
}

double way(const Points& points, const std::vector<int>& order) {
    double sum = 0;
    for (std::size_t i = 1; i < order.size(); ++i) sum += (points.row(order[i]) - points.row(order[i - 1])).norm();
    return sum;
}

TEST(VisitingOrder, VisitsEachPointOnceOnAShortWay) {
    const Points points = random_points(5000);
    const std::vector<int> order = visiting_order(points);
    std::vector<int> sorted = order, own(5000);
    std::sort(sorted.begin(), sorted.end());
    for (int i = 0; i < 5000; ++i) own[static_cast<std::size_t>(i)] = i;
    ASSERT_EQ(sorted, own);
    EXPECT_LT(way(points, order), 0.2 * way(points, own));
}

TEST(VisitingOrder, LeavesAGoodOrderAlone) {
    Points line(5000, 3);
    for (int i = 0; i < 5000; ++i) line.row(i) << i, std::sin(0.01 * i), 0;
    EXPECT_TRUE(visiting_order(line).empty());
    EXPECT_TRUE(visiting_order(random_points(100)).empty());
    EXPECT_TRUE(visiting_order(Points::Constant(5000, 3, 2.5)).empty());
    EXPECT_TRUE(visiting_order(Points(0, 3)).empty());
}

TEST(VisitingOrder, TheCurveIsTheSameInAnyOrder) {
    Points points(4000, 3);
    for (int i = 0; i < 4000; ++i) points.row(i) << (i % 1999) * 1e-6, i, 1; // many to a cell
    const auto along = [](const Points& p) {
        Points sorted(p.rows(), 3);
        const std::vector<int> order = curve_order(p);
        for (Eigen::Index i = 0; i < p.rows(); ++i) sorted.row(i) = p.row(order[static_cast<std::size_t>(i)]);
        return sorted;
    };
    EXPECT_EQ(along(points), along(points.colwise().reverse()));
    EXPECT_EQ(curve_order(Points::Constant(3, 3, 2.5)), (std::vector{0, 1, 2}));
    EXPECT_TRUE(curve_order(Points(0, 3)).empty());
}

TEST(VisitingOrder, TakesPointsThatAreNotFinite) {
    Points points = random_points(3000);
    points.row(17).setConstant(NAN);
    points.row(99).setConstant(INFINITY);
    EXPECT_EQ(visiting_order(points).size(), 3000u);
    for (int i = 0; i < 3000; i += 7) points.row(i) << NAN, (i % 5) * 0.1, NAN; // in one cell with others
    std::vector<int> sorted = curve_order(points);
    std::sort(sorted.begin(), sorted.end());
    for (int i = 0; i < 3000; ++i) ASSERT_EQ(sorted[static_cast<std::size_t>(i)], i);
}

} // namespace
} // namespace meshtween::search
