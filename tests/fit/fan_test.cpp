#include "meshtween/fit/fan.h"

#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

using namespace meshtween;

namespace {

constexpr double all = std::numeric_limits<double>::infinity();

// A vertex of a coarse ball on a finer one.
struct OnBall {
    Mesh mesh = sphere(2);
    Shell rest;
    FitTarget target;
    int vertex = 0;
    Point place, across; // its own, and beyond an edge of its ring

    OnBall() : target(make()) {
        vertex = mesh.triangles(0, 0);
        place = mesh.positions.row(vertex);
        const Point middle = (mesh.positions.row(mesh.triangles(0, 1)) + mesh.positions.row(mesh.triangles(0, 2))) / 2;
        across = target.index.closest(Point(middle + 0.1 * (middle - place))).position;
    }
    FanGround ground(std::vector<Pin> pins = {}) const { return {rest, target, std::move(pins), 0.3}; }

private:
    FitTarget make() {
        rest = shell(mesh.positions, mesh.triangles);
        const Mesh finer = sphere(4);
        return fit_target(finer.positions, finer.triangles);
    }
};

TEST(Fan, NothingIsWantingWhereNothingIsTurnedOver) {
    const OnBall ball;
    const Fan fan = fan_around(ball.ground(), ball.mesh.positions, ball.vertex, {}, 0.3);
    EXPECT_LT(fan.wanting, fault_costs);
    EXPECT_DOUBLE_EQ(wanting(ball.ground(), fan, ball.place, 0, all), fan.wanting);
    EXPECT_GT(wanting(ball.ground(), fan, ball.across, 0, all), fault_costs) << "a triangle looks inwards";
    EXPECT_GT(wanting(ball.ground(), fan, ball.place, 0.1, all), fan.wanting) << "off the target";
    EXPECT_GE(wanting(ball.ground(), fan, ball.across, 0, 0.05), 0.05) << "no more is asked for";
}

TEST(Fan, TheWorstTriangleComesFirst) {
    OnBall ball;
    ball.mesh.positions.row(ball.vertex) = ball.across;
    const Fan fan = fan_around(ball.ground(), ball.mesh.positions, ball.vertex, {}, 0.3);
    EXPECT_TRUE(std::ranges::is_sorted(fan.blades, std::greater(), &Fan::Judged::wanting));
    EXPECT_GT(fan.blades[0].wanting, fault_costs);
}

TEST(Fan, WhatTrianglesCouldCutIsJudgedToo) {
    const OnBall ball;
    // One more triangle, that stands in the ball close beside the vertex.
    Points x(ball.mesh.positions.rows() + 3, 3);
    const Point ahead = (ball.across - ball.place).normalized(), aside = ahead.cross(ball.place).normalized();
    const Point foot = ball.place + 0.6 * (ball.across - ball.place);
    x << ball.mesh.positions, 0.8 * foot + 0.1 * aside, 0.8 * foot - 0.1 * aside, 1.5 * foot;
    Triangles triangles(ball.mesh.triangles.rows() + 1, 3);
    const int n = static_cast<int>(ball.mesh.positions.rows());
    triangles << ball.mesh.triangles, n, n + 1, n + 2;
    const Shell rest = shell(x, triangles);
    const FanGround ground{rest, ball.target, {}, 0.3};
    std::vector<int> sheets(static_cast<std::size_t>(triangles.rows()));
    std::iota(sheets.begin(), sheets.end(), 0);
    const Fan with = fan_around(ground, x, ball.vertex, sheets, 0.05),
              without = fan_around(ground, x, ball.vertex, {}, 0.05);
    EXPECT_GT(with.wanting, without.wanting + fault_costs) << "it stands in the fan";
    std::size_t kept = 0;
    for (const Fan::Judged& judged : with.blades) {
        kept += judged.sheets.size();
        for (const Sheet& other : judged.sheets) EXPECT_EQ(std::ranges::count(other.vertices, ball.vertex), 0);
        for (const Blade& fellow : judged.fellows) EXPECT_EQ(fellow.lies.vertices[fellow.corner], ball.vertex);
    }
    EXPECT_LT(kept, with.blades.size() * sheets.size() / 4) << "what is far off is left out";
}

TEST(Fan, TrianglesThatGrowThinAndPinsThatComeOffAreNotBearable) {
    const OnBall ball;
    const int t = ball.rest.topology.vertex_triangles[ball.vertex].front();
    Pin pin{{t, {0, 0, 0}}, {0, 0, 0}, ball.place};
    for (int k = 0; k < 3; ++k) pin.where.barycentric[k] = ball.mesh.triangles(t, k) == ball.vertex ? 1 : 0;
    const Point aside = ball.place + 0.1 * (ball.across - ball.place);
    const Fan free = fan_around(ball.ground(), ball.mesh.positions, ball.vertex, {}, 0.3),
              held = fan_around(ball.ground({pin}), ball.mesh.positions, ball.vertex, {}, 0.3);
    EXPECT_TRUE(bearable(free, aside));
    EXPECT_FALSE(bearable(held, aside));
    EXPECT_TRUE(bearable(held, ball.place));
    EXPECT_FALSE(bearable(free, ball.mesh.positions.row(ball.rest.topology.neighbours[ball.vertex].front())));
}

} // namespace
