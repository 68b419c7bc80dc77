#include "meshtween/fit/counterpart.h"

#include "meshtween/fit/refine.h"
#include "meshtween/fit/settle.h"
#include "meshtween/fit/surface_fit.h"
#include "meshtween/fit/untangle.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/search/self_intersections.h"

#include "support/shapes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace meshtween;

namespace {

// A flat square -1..1 in z = 0 of n x n squares.
Mesh square(int n) {
    Mesh mesh = wavy_sheet(n + 1, n + 1);
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) mesh.positions.row(i * (n + 1) + j) << 2.0 * j / n - 1, 2.0 * i / n - 1, 0;
    return mesh;
}

struct Sides {
    Shell shell;
    FitTarget target;
    Sides(const Mesh& mesh, const Mesh& open)
        : shell(meshtween::shell(mesh.positions, mesh.triangles)), target(fit_target(open.positions, open.triangles)) {}
};

TEST(AtBorder, IsTrueOfItsEdgesAndCornersAlone) {
    const Mesh two = square(1);
    const std::vector<char> all(4, 1), but_one{1, 1, 1, 0};
    EXPECT_TRUE(at_border({0, {1, 0, 0}}, two.triangles, all));
    EXPECT_TRUE(at_border({0, {0.5, 0.5, 0}}, two.triangles, all));
    EXPECT_FALSE(at_border({0, {0.2, 0.3, 0.5}}, two.triangles, all));
    for (int k = 0; k < 3; ++k)
        if (two.triangles(1, k) == 3) {
            Point corner(0, 0, 0), edge = Point::Constant(0.5);
            corner[k] = 1, edge[(k + 1) % 3] = 0;
            EXPECT_FALSE(at_border({1, corner}, two.triangles, but_one));
            EXPECT_FALSE(at_border({1, edge}, two.triangles, but_one));
        }
}

TEST(WithoutCounterpart, IsWhatTheTargetDoesNotShow) {
    const Mesh whole = square(20);
    const Mesh half = part_of_mesh(whole, [](const Point& p) { return p[0] < 0.05; });
    const Sides sides(whole, half);
    Points raised = whole.positions;
    raised.col(2).array() += 0.02;
    const std::vector<char> beyond = without_counterpart(sides.shell, raised, sides.target);
    for (Eigen::Index i = 0; i < raised.rows(); ++i) {
        const double x = raised(i, 0);
        if (x > 0.05 && x < 0.15) continue;
        EXPECT_EQ(beyond[static_cast<std::size_t>(i)], x > 0.1) << raised.row(i);
    }
    const Sides closed(whole, sphere(2));
    EXPECT_TRUE(without_counterpart(closed.shell, raised, closed.target).empty()) << "a closed target shows all";
}

TEST(WithoutCounterpart, AFurrowThatTheTargetHasNotBelongsToIt) {
    const Mesh flat = square(40);
    const Sides sides(flat, flat);
    Points furrowed = flat.positions;
    for (auto p : furrowed.rowwise()) p[2] -= 0.3 * std::exp(-std::pow(p.head<2>().norm() / 0.1, 4));
    const std::vector<char> beyond = without_counterpart(sides.shell, furrowed, sides.target);
    EXPECT_EQ(std::ranges::count(beyond, 1), 0);
}

TEST(WithoutBeyond, LeavesTrianglesThatLieThereWithAllCorners) {
    const Mesh two = square(1); // 0 1 2, 1 3 2
    EXPECT_EQ(without_beyond(two.triangles, {}, {0, 1}), (std::vector<int>{0, 1}));
    EXPECT_EQ(without_beyond(two.triangles, {1, 1, 1, 0}, {0, 1}), std::vector<int>{1});
    EXPECT_EQ(without_beyond(two.triangles, {1, 1, 1, 1}, {0, 1}), std::vector<int>{});
}

TEST(Settle, WhatLiesBeyondTheTargetStays) {
    const Mesh whole = square(10);
    const Sides sides(whole, whole);
    Points raised = whole.positions;
    raised.col(2).array() += 0.005;
    std::vector<char> beyond(sides.shell.area.size(), 0);
    for (std::size_t i = 0; i < beyond.size(); i += 2) beyond[i] = sides.shell.topology.on_boundary[i] == 0;
    const Settled settled = settle(sides.shell, raised, sides.target, {}, beyond);
    for (std::size_t i = 0; i < beyond.size(); ++i)
        EXPECT_NEAR(settled.positions(static_cast<Eigen::Index>(i), 2), beyond[i] ? 0.005 : 0, 1e-12);
}

TEST(Untangle, WhatLiesBeyondTheTargetStays) {
    const Mesh ball = sphere(4);
    const Sides sides(ball, ball);
    TangleSearch search{sides.shell, sides.target, {}};
    Points dented = ball.positions;
    const int vertex = ball.triangles(7, 0);
    dented.row(vertex) *= -0.5;
    search.beyond.assign(sides.shell.area.size(), 0);
    for (const int j : sides.shell.topology.neighbours[vertex]) search.beyond[static_cast<std::size_t>(j)] = 1;
    const Untangled held = untangle(search, dented, tangles(search, dented), {});
    for (const int j : sides.shell.topology.neighbours[vertex]) EXPECT_EQ(held.positions.row(j), dented.row(j));
    search.beyond.assign(sides.shell.area.size(), 1);
    EXPECT_EQ(untangle(search, dented, tangles(search, dented), {}).positions, dented);
    EXPECT_TRUE(tangles(search, dented).flips.empty());
}

// Half of the target is cut off: the fit of the other half is hardly worse for it, and what has no counterpart follows
// as it is instead of being drawn together.
TEST(SurfaceFit, APartOfTheTargetIsEnough) {
    const Mesh source = two_legs();
    Mesh target = source;
    for (auto p : target.positions.rowwise()) p = Point(1.2 * p[0], 0.9 * p[1] + 0.1 * p[0] * p[0], 1.1 * p[2]);
    const Mesh open = part_of_mesh(target, [](const Point& p) { return p[0] < 0.1; });
    std::vector<Marker> markers;
    for (int t = 0; t < source.triangles.rows(); t += 997)
        if (const int vertex = source.triangles(t, 0); target.positions(vertex, 0) < 0)
            markers.push_back({"m" + std::to_string(t), {t, {1, 0, 0}}, target.positions.row(vertex)});
    ASSERT_GE(markers.size(), 5U);
    const FitResult fitted = surface_fit(source, open, markers);
    double within = 0, beyond = 0;
    for (Eigen::Index i = 0; i < source.positions.rows(); ++i) {
        const double off = (fitted.positions.row(i) - target.positions.row(i)).norm() / diagonal(target);
        double& worst = target.positions(i, 0) < 0 ? within : beyond;
        worst = std::max(worst, off);
    }
    EXPECT_LT(within, 0.01);
    EXPECT_LT(beyond, 0.15);
    EXPECT_TRUE(self_intersections(fitted.positions, source.triangles).empty());
    EXPECT_TRUE(fitted.notes.empty()) << fitted.notes.front();
}

} // namespace
