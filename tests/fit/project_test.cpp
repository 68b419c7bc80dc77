#include "meshtween/fit/project.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meshtween {
namespace {

Mesh square(double size, int n, double height = 0) { // centred, looking up
    Mesh mesh;
    mesh.positions.resize((n + 1) * (n + 1), 3);
    mesh.triangles.resize(2 * n * n, 3);
    const auto id = [&](int i, int j) { return i * (n + 1) + j; };
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            mesh.positions.row(id(i, j)) << size * (i / double(n) - 0.5), size * (j / double(n) - 0.5), height;
    for (int i = 0, t = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            mesh.triangles.row(t++) << id(i, j), id(i + 1, j), id(i + 1, j + 1);
            mesh.triangles.row(t++) << id(i, j), id(i + 1, j + 1), id(i, j + 1);
        }
    return mesh;
}

Goals goals_of(const Mesh& mesh, const Mesh& target, double near = 0.03, GoalOptions options = {}) {
    const TargetSurface surface = target_surface(target.positions, target.triangles);
    const Surroundings around = surroundings(mesh.positions.rows(), mesh.triangles);
    const auto attached = attached_boundary(mesh.positions, mesh.triangles, around, surface, near);
    return closest_compatible(mesh.positions, mesh.triangles, around, surface, attached, options);
}

TEST(Project, ABallGoesStraightInwards) {
    Mesh ball = sphere(3);
    ball.positions *= 1.1;
    const Goals goals = goals_of(ball, sphere(5));
    for (Eigen::Index i = 0; i < ball.positions.rows(); ++i) {
        ASSERT_TRUE(goals.found(i));
        EXPECT_LT((goals.positions.row(i) - ball.positions.row(i) / 1.1).norm(), 2e-3) << i;
        EXPECT_GT(goals.normals.row(i).dot(ball.positions.row(i).normalized()), 0.99);
    }
}

TEST(Project, TheOtherSideOfASheetIsNotCompatible) { // a thin box: a square near its underside looks up
    const Mesh box = bar({1, 1, 0.05}, {8, 8, 2});
    Mesh sheet = square(0.4, 4);
    sheet.positions.rowwise() += Point(0.5, 0, -0.03);
    const Goals goals = goals_of(sheet, box);
    for (Eigen::Index i = 0; i < sheet.positions.rows(); ++i) EXPECT_NEAR(goals.positions(i, 2), 0.025, 1e-12) << i;
    const Goals near_only = goals_of(sheet, box, 0.03, {0.3, 0.02});
    EXPECT_EQ(near_only.positions, sheet.positions); // the upper side lies out of reach
    EXPECT_TRUE(std::all_of(near_only.triangles.begin(), near_only.triangles.end(), [](int t) { return t < 0; }));
}

TEST(Project, WhatTheTargetEndsBeforeStays) {
    const Mesh large = square(2, 10, 0.1), small = square(1, 7);
    const Goals goals = goals_of(large, small);
    for (Eigen::Index i = 0; i < large.positions.rows(); ++i) {
        const bool over = large.positions.row(i).head<2>().cwiseAbs().maxCoeff() < 0.5 - 1e-9;
        EXPECT_EQ(goals.found(i), over) << large.positions.row(i);
    }
}

TEST(Project, NearBoundariesBelongTogether) {
    const Mesh target = square(1, 7), same = square(1.02, 10, 0.01), inside = square(0.6, 10, 0.01);
    const TargetSurface surface = target_surface(target.positions, target.triangles);
    const auto attached = [&](const Mesh& mesh) {
        const Surroundings around = surroundings(mesh.positions.rows(), mesh.triangles);
        const auto flags = attached_boundary(mesh.positions, mesh.triangles, around, surface, 0.03);
        return std::count(flags.begin(), flags.end(), 1);
    };
    EXPECT_EQ(attached(same), 40);
    EXPECT_EQ(attached(inside), 0);
    const Goals goals = goals_of(same, target);
    const Surroundings around = surroundings(same.positions.rows(), same.triangles);
    for (Eigen::Index i = 0; i < same.positions.rows(); ++i)
        if (!around.rim[i].empty()) {
            EXPECT_NEAR(goals.positions.row(i).head<2>().cwiseAbs().maxCoeff(), 0.5, 1e-12) << i;
        }
}

long turned_over(const Points& before, const Points& after, const Triangles& triangles) {
    long count = 0;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        count += double_area_normal(before, triangles, t).dot(double_area_normal(after, triangles, t)) <= 0;
    return count;
}

TEST(GuardedStep, TurnsNothingOver) {
    const Mesh sheet = square(1, 20);
    std::srand(3);
    Points to = sheet.positions;
    to.leftCols<2>() += 0.08 * Eigen::MatrixXd::Random(to.rows(), 2);
    ASSERT_GT(turned_over(sheet.positions, to, sheet.triangles), 10);
    const Points up = Point(0, 0, 1).replicate(to.rows(), 1);
    for (const Points& normals : {up, Points(Points::Zero(to.rows(), 3))}) {
        const GuardedStep step = guarded_step(sheet.positions, to, normals, sheet.triangles);
        EXPECT_EQ(turned_over(sheet.positions, step.positions, sheet.triangles), 0);
        EXPECT_GT(step.shortened, 0);
        EXPECT_LT(step.shortened, to.rows());
        EXPECT_LT((step.positions - to).norm(), (sheet.positions - to).norm());
    }
}

TEST(GuardedStep, IsWholeWhereNothingTurns) {
    const Mesh ball = sphere(3);
    const Points to = 1.3 * ball.positions;
    const GuardedStep step = guarded_step(ball.positions, to, ball.positions, ball.triangles);
    EXPECT_EQ(step.positions, to);
    EXPECT_EQ(step.shortened, 0);
}

TEST(GuardedStep, WhatLooksTheWrongWayMayTurnBack) {
    Mesh sheet = square(1, 2);
    const Points right = sheet.positions;
    sheet.positions.row(4) << 0.9, 0.9, 0; // the middle vertex beyond a corner: some triangles look down
    const Points up = Point(0, 0, 1).replicate(9, 1);
    const GuardedStep step = guarded_step(sheet.positions, right, up, sheet.triangles);
    EXPECT_EQ(step.positions, right);
}

TEST(GuardedStep, DoesNotCollapse) {
    const Mesh sheet = square(1, 4);
    const Points point = Point(0.1, 0.1, 0).replicate(sheet.positions.rows(), 1);
    const GuardedStep step = guarded_step(sheet.positions, point, Points::Zero(25, 3), sheet.triangles);
    for (Eigen::Index t = 0; t < sheet.triangles.rows(); ++t)
        EXPECT_GT(triangle_area(step.positions, sheet.triangles, t), 0) << t;
}

TEST(Project, SameBitsForAnyThreads) {
    Mesh ball = sphere(5);
    std::srand(4);
    ball.positions += 0.05 * Points::Random(ball.positions.rows(), 3);
    const auto run = [&](int count) {
        set_threads(count);
        const Goals goals = goals_of(ball, sphere(4));
        return guarded_step(ball.positions, goals.positions, goals.normals, ball.triangles).positions;
    };
    const Points one = run(1);
    EXPECT_EQ(run(2), one);
    set_threads(0);
}

} // namespace
} // namespace meshtween
