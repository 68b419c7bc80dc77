#include "meshtween/fit/unfold.h"

#include "meshtween/fit/fold_energy.h"
#include "meshtween/fit/tangles.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace meshtween;

namespace {

// Two triangles over a square with one more vertex that moves, pulled about and partly turned over.
FoldEnergy some_energy() {
    FoldEnergy energy;
    energy.free = 1;
    energy.triangles.resize(4, 3);
    energy.triangles << 0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1;
    for (int t = 0; t < 4; ++t) {
        Eigen::Matrix2d edges;
        edges << 1, 0.3, 0, 0.8 + 0.1 * t;
        energy.inverse.push_back(edges.inverse());
        energy.share.push_back(0.25);
        energy.outward.push_back(Point(0.1 * t, 0.2, 1).normalized());
    }
    energy.softness = 0.3;
    energy.planes = {{0.1, 0, 0.2}};
    energy.normals = {Point(0.2, 0.1, 1).normalized()};
    energy.homes = {{0, 0.1, 0}};
    energy.onto = {2};
    energy.home = {0.7};
    energy.pulls = {{{0, 1, 2}, {0.5, 0.25, 0.25}, {0.3, 0.4, 0.5}, 1.5}};
    return energy;
}

Points some_places() {
    Points x(5, 3);
    x << 1.3, 0.2, 0.1, 1, 0, 0, 0, 1, 0.1, -1, 0, 0, 0, -1, 0.2; // the first outside the square: a fold
    return x;
}

TEST(FoldEnergy, GradientIsTheDerivative) {
    const FoldEnergy energy = some_energy();
    const Points x = some_places();
    Points gradient, ignored;
    fold_energy(energy, x, gradient);
    for (int c = 0; c < 3; ++c) {
        constexpr double h = 1e-6;
        Points more = x, less = x;
        more(0, c) += h, less(0, c) -= h;
        const double slope = (fold_energy(energy, more, ignored) - fold_energy(energy, less, ignored)) / (2 * h);
        EXPECT_NEAR(gradient(0, c), slope, 1e-6 * std::max(1.0, std::abs(slope)));
    }
}

TEST(FoldEnergy, LeastStretchTellsTrianglesTurnedOver) {
    const FoldEnergy energy = some_energy();
    Points x = some_places();
    EXPECT_LT(least_stretch(energy, x), 0);
    x.row(0) << 0, 0, 0.1;
    EXPECT_GT(least_stretch(energy, x), 0);
}

TEST(FoldEnergy, SlidingVerticesKeepToTheSurface) {
    FoldEnergy energy = some_energy();
    energy.sliding = true;
    Points gradient;
    fold_energy(energy, some_places(), gradient);
    EXPECT_NEAR(gradient.row(0).dot(energy.normals[0]), 0, 1e-12);
    EXPECT_GT(gradient.norm(), 0.1);
}

TEST(PlanarEdges, KeepsLengthsAndRefusesPoints) {
    Points rest(3, 3);
    rest << 1, 1, 1, 1, 3, 1, 1, 2, 4;
    Triangles t(1, 3);
    t << 0, 1, 2;
    Eigen::Matrix2d edges;
    ASSERT_TRUE(planar_edges(rest, t, 0, edges));
    EXPECT_NEAR(edges.col(0).norm(), 2, 1e-12);
    EXPECT_NEAR(edges.col(1).norm(), std::sqrt(10.0), 1e-12);
    EXPECT_NEAR(edges.determinant(), 6, 1e-12);
    rest.row(1) = rest.row(0);
    EXPECT_FALSE(planar_edges(rest, t, 0, edges));
}

TEST(TargetSamples, ShareOutTheSurface) {
    const Mesh m = sphere(2);
    const FitTarget target = fit_target(m.positions, m.triangles);
    double area = 0, whole = 0;
    for (const TargetSample& sample : target_samples(target)) area += sample.area;
    for (Eigen::Index t = 0; t < m.triangles.rows(); ++t) {
        const Eigen::RowVector3d a = m.positions.row(m.triangles(t, 0)), b = m.positions.row(m.triangles(t, 1)),
                                 c = m.positions.row(m.triangles(t, 2));
        whole += (b - a).cross(c - a).norm() / 2;
    }
    EXPECT_NEAR(area, whole, 1e-9);
}

// A ball with a horn, the mesh being the target itself: with the horn spanned away, it has to come back.
TEST(Unfolded, WhatAMembraneFlattensIsDrawnOutAgainWhereTheTargetHasIt) {
    Mesh mesh = sphere(4);
    FoldedPatch patch;
    for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
        const double angle = std::acos(std::clamp(mesh.positions(i, 2) / mesh.positions.row(i).norm(), -1.0, 1.0));
        if (angle < 0.4) mesh.positions.row(i) *= 1 + 0.5 * std::pow(1 - angle / 0.4, 2);
        if (angle > 1) continue;
        patch.vertices.push_back(static_cast<int>(i));
        patch.remote.push_back(angle);
    }
    mesh.positions /= diagonal(mesh);
    const FitTarget target = fit_target(mesh.positions, mesh.triangles);
    const Shell shell = meshtween::shell(mesh.positions, mesh.triangles);
    const std::vector<TargetSample> samples = target_samples(target);
    for (std::size_t k = 0; k < samples.size(); ++k)
        if (samples[k].position[2] > 0.2) patch.samples.push_back(static_cast<int>(k));
    patch.membrane = true;
    const Points places = unfolded(shell, mesh.positions, patch, target, samples, {});
    EXPECT_NEAR(places.col(2).maxCoeff(), mesh.positions.col(2).maxCoeff(), 0.03);
    Points now = mesh.positions;
    for (std::size_t i = 0; i < patch.vertices.size(); ++i)
        now.row(patch.vertices[i]) = places.row(static_cast<Eigen::Index>(i));
    TangleSearch search{shell, target, {}};
    EXPECT_EQ(tangles(search, now).count(), 0u);
}

} // namespace
