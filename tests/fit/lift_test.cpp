#include "meshtween/fit/lift.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/facing.h"
#include "meshtween/fit/fit.h"
#include "meshtween/fit/quality.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace meshtween;

namespace {

Points lifted_onto(const Mesh& mesh, const Mesh& target) {
    return lifted(mesh.positions, mesh.triangles, topology(mesh.positions.rows(), mesh.triangles),
                  fit_target(target.positions, target.triangles));
}

Mesh moved(Mesh mesh, Points positions) {
    mesh.positions = std::move(positions);
    return mesh;
}

TEST(Lift, HalvesTheDistanceOfACoarseBallFromARoundOne) {
    const Mesh coarse = sphere(2), round = sphere(6);
    const Mesh after = moved(coarse, lifted_onto(coarse, round));
    EXPECT_GT(after.positions.rowwise().norm().minCoeff(), 1.001) << "outwards, where the ball is convex";
    const Quality was = measure(coarse, coarse, round), is = measure(coarse, after, round);
    EXPECT_LT(is.fitted_to_target.mean, 0.5 * was.fitted_to_target.mean);
    EXPECT_LT(is.target_to_fitted.mean, 0.5 * was.target_to_fitted.mean);
    EXPECT_LT(std::abs(volume(after.positions, after.triangles) / volume(round.positions, round.triangles) - 1),
              0.2 *
                  std::abs(volume(coarse.positions, coarse.triangles) / volume(round.positions, round.triangles) - 1));
}

TEST(Lift, WhatLiesOnTheTargetStays) {
    const Mesh ball = sphere(3);
    EXPECT_LT((lifted_onto(ball, ball) - ball.positions).rowwise().norm().maxCoeff(), 1e-12);
    const Mesh box = bar({1, 1, 1}, {4, 4, 4}, 0), finer = bar({1, 1, 1}, {9, 9, 9}, 0);
    EXPECT_LT((lifted_onto(box, finer) - box.positions).rowwise().norm().maxCoeff(), 1e-9) << "faces are flat";
}

TEST(Lift, FarPartsAndSliversStay) {
    Mesh ball = sphere(2);
    const Point far = 1.5 * ball.positions.row(7);
    ball.positions.row(7) = far;
    const Points after = lifted_onto(ball, sphere(5));
    EXPECT_EQ(Point(after.row(7)), far);
    Mesh slivers = sphere(2);
    for (Eigen::Index t = 0; t < slivers.triangles.rows(); t += 7) { // one corner almost on the opposite edge
        const auto f = slivers.triangles.row(t);
        slivers.positions.row(f[0]) = (0.49 * slivers.positions.row(f[1]) + 0.49 * slivers.positions.row(f[2]) +
                                       0.02 * slivers.positions.row(f[0]))
                                          .normalized();
    }
    const Points settled = lifted_onto(slivers, sphere(5));
    for (Eigen::Index t = 0; t < slivers.triangles.rows(); ++t)
        EXPECT_GE(double_area_normal(settled, slivers.triangles, t)
                      .dot(double_area_normal(slivers.positions, slivers.triangles, t)),
                  0);
}

TEST(Lift, TurnsNoTriangleIntoATargetThatIsFoldedItself) {
    const Mesh mesh = sphere(5);
    Mesh target = sphere(4);
    for (Eigen::Index t = 0; t < target.triangles.rows(); t += 7) { // a corner drawn over the opposite edge
        const auto f = target.triangles.row(t);
        target.positions.row(f[0]) =
            (0.6 * target.positions.row(f[1]) + 0.6 * target.positions.row(f[2]) - 0.2 * target.positions.row(f[0]))
                .normalized();
    }
    const FitTarget surface = fit_target(target.positions, target.triangles);
    Points on_it = mesh.positions;
    for (Eigen::Index i = 0; i < on_it.rows(); ++i) on_it.row(i) = surface.index.closest(Point(on_it.row(i))).position;
    const std::vector<int> before = facing_into(on_it, mesh.triangles, surface),
                           after = facing_into(lifted_onto(moved(mesh, on_it), target), mesh.triangles, surface);
    EXPECT_TRUE(std::includes(before.begin(), before.end(), after.begin(), after.end()));
}

TEST(Lift, TheSameBitsWithAnyNumberOfThreads) {
    const Mesh coarse = sphere(4), round = sphere(5);
    set_threads(1);
    const Points one = lifted_onto(coarse, round);
    set_threads(2);
    EXPECT_EQ(one, lifted_onto(coarse, round));
    set_threads(0);
}

TEST(Lift, AFitCanStayOnTheSurface) {
    const Mesh coarse = sphere(3), round = sphere(5);
    std::vector<Marker> markers;
    for (int t = 0; t < coarse.triangles.rows(); t += 100)
        markers.push_back({std::to_string(t), {t, {1, 0, 0}}, coarse.positions.row(coarse.triangles(t, 0))});
    FitOptions options;
    EXPECT_GT(fit(coarse, round, markers, options).positions.rowwise().norm().mean(), 1.0005);
    options.on_surface = true;
    EXPECT_LT(fit(coarse, round, markers, options).positions.rowwise().norm().maxCoeff(), 1 + 1e-9);
    options.on_surface = false, options.markers_exact = true;
    const Points exact = fit(coarse, round, markers, options).positions;
    for (const Marker& m : markers)
        EXPECT_LT((position(exact, coarse.triangles, m.source) - m.target).norm(), 1e-8) << "exact markers come last";
}

} // namespace
