#include "meshtween/fit/marker_noise.h"

#include "meshtween/fit/markers.h"
#include "meshtween/fit/surface_fit.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

using namespace meshtween;

namespace {

Points noise(Eigen::Index count, double deviation, unsigned seed = 5) {
    std::mt19937 engine(seed);
    std::normal_distribution<double> normal(0, deviation);
    Points result(count, 3);
    for (Eigen::Index i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) result(i, k) = normal(engine);
    return result;
}

// A sample whose target has a diagonal of 1.
struct Scaled {
    Sample sample;
    Points positions, goals;
    explicit Scaled(const std::string& name) : sample(meshtween::sample(name)) {
        const double size = diagonal(sample.target.positions, sample.target.triangles);
        positions = sample.target.positions / size;
        goals = sample.marker_target / size;
    }
};

TEST(MarkerNoise, GoalsLieOnTheTargetAndOneHeightIsNoNoise) {
    const Scaled head("head");
    const FitTarget target = fit_target(head.positions, head.sample.target.triangles);
    Points floating = head.goals;
    for (Eigen::Index k = 0; k < floating.rows(); ++k) {
        const ClosestPoint closest = target.index.closest(Point(floating.row(k)));
        floating.row(k) += 0.02 * normal_at(target, closest.where);
    }
    const MarkerGoals goals = marker_goals(floating, target);
    EXPECT_EQ(goals.noise, 0);
    for (Eigen::Index k = 0; k < floating.rows(); ++k)
        EXPECT_LT(target.index.closest(Point(goals.places.row(k))).squared_distance, 1e-20);
    EXPECT_LT((goals.places - head.goals).rowwise().norm().mean(), 0.005); // of 0.02
}

TEST(MarkerNoise, ScatterIsTold) {
    const Scaled head("head");
    const FitTarget target = fit_target(head.positions, head.sample.target.triangles);
    EXPECT_EQ(marker_goals(head.goals, target).noise, 0);
    const MarkerGoals goals = marker_goals(head.goals + noise(head.goals.rows(), 0.01), target);
    EXPECT_GT(goals.noise, 0.006);
    EXPECT_LT(goals.noise, 0.014);
}

TEST(MarkerNoise, WhatIsFarOffStays) {
    const Scaled head("head");
    const FitTarget target = fit_target(head.positions, head.sample.target.triangles);
    Points far = head.goals;
    far.row(0) += Point(1, 1, 1);
    EXPECT_EQ(Point(marker_goals(far, target).places.row(0)), Point(far.row(0)));
}

TEST(MarkerNoise, WhatNeighboursShareIsNoNoise) {
    const Points places = noise(40, 0.2);
    constexpr double deviation = 0.01;
    Points shared(40, 3);
    for (Eigen::Index k = 0; k < 40; ++k) shared.row(k) = Point(0.05, 0.1 * places(k, 0), 0.08 * places(k, 1));
    const Points errors = noise(40, deviation, 11);
    const auto size = [](const Points& p) { return p.rowwise().norm().mean(); };
    EXPECT_LT(size(smooth_misfits(places, shared + errors, deviation) - shared), 0.6 * size(errors));
    EXPECT_LT(size(smooth_misfits(places, errors, deviation)), 0.3 * size(errors));
}

// Mean distance of the vertices from where they belong, in diagonals.
double error_of_fit(const Sample& s, const Points& marker_target) {
    std::vector<MarkerPair> pairs;
    for (Eigen::Index k = 0; k < marker_target.rows(); ++k)
        pairs.push_back({s.marker_names[static_cast<std::size_t>(k)], s.marker_source.row(k), marker_target.row(k)});
    const FitResult fit = surface_fit(s.source, s.target, place_markers(pairs, s.source));
    return (fit.positions - s.truth).rowwise().norm().mean() / diagonal(s.target.positions, s.target.triangles);
}

TEST(MarkerNoise, NoisyMarkersCostLittle) {
    const Sample s = sample("build");
    const double size = diagonal(s.target.positions, s.target.triangles);
    const double exact = error_of_fit(s, s.marker_target);
    const double noisy = error_of_fit(s, s.marker_target + noise(s.marker_target.rows(), 0.01 * size));
    EXPECT_LT(noisy, 3 * exact); // nine times where the markers do not yield
}

} // namespace
