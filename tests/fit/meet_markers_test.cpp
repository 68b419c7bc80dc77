#include "meshtween/fit/meet_markers.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/fit.h"
#include "meshtween/fit/quality.h"
#include "meshtween/fit/settle.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"

#include "support/errors.h"

#include <gtest/gtest.h>

#include <limits>

using namespace meshtween;

namespace {

// Markers within triangles of a sphere whose targets lie a little way along it, and on it.
std::vector<Marker> displaced(const Mesh& sphere, int count, double angle) {
    std::vector<Marker> markers;
    for (int k = 0; k < count; ++k) {
        const auto t = static_cast<int>(k * sphere.triangles.rows() / count);
        const SurfacePoint place{t, {0.5, 0.3, 0.2}};
        const Points at = position(sphere.positions, sphere.triangles, place);
        markers.push_back({"m" + std::to_string(k), place, turn(at, {1, 1, 0}, angle).row(0).normalized()});
    }
    return markers;
}

double worst(const Points& x, const Mesh& mesh, const std::vector<Marker>& markers) {
    double most = 0;
    for (const Marker& m : markers) most = std::max(most, (position(x, mesh.triangles, m.source) - m.target).norm());
    return most;
}

TEST(MeetMarkers, MeetsThemOnTheSurfaceAndTurnsNothingOver) {
    const Mesh m = sphere(5), target = sphere(6);
    const auto markers = displaced(m, 20, 0.08);
    ASSERT_GT(worst(m.positions, m, markers), 0.05); // about two edges
    const MetMarkers met = meet_markers(m, target, markers);
    EXPECT_TRUE(met.missed.empty());
    EXPECT_LT(worst(met.positions, m, markers), 1e-9 * diagonal(target));
    EXPECT_TRUE(flipped_triangles(met.positions, m.triangles, fit_target(target.positions, target.triangles)).empty());
    const Eigen::VectorXd radius = met.positions.rowwise().norm();
    EXPECT_LT((radius.array() - 1).abs().maxCoeff(), 2e-3); // the sagitta of its triangles and of the target's
    EXPECT_LT((radius.array() - 1).abs().mean(), 2e-4);
}

TEST(MeetMarkers, WhatIsMetAlreadyStays) {
    const Mesh m = sphere(3);
    std::vector<Marker> markers = displaced(m, 5, 0);
    for (Marker& marker : markers) marker.target = position(m.positions, m.triangles, marker.source);
    EXPECT_EQ(meet_markers(m, m, markers).positions, m.positions);
}

TEST(MeetMarkers, FarVerticesStay) {
    const Mesh m = sphere(5);
    std::vector<Marker> markers = displaced(m, 1, 0.01);
    const MetMarkers met = meet_markers(m, m, markers);
    const Point at = markers[0].target;
    for (Eigen::Index i = 0; i < m.positions.rows(); ++i)
        if ((m.positions.row(i) - at).norm() > 1) {
            EXPECT_LT((met.positions.row(i) - m.positions.row(i)).norm(), 1e-12);
        }
}

TEST(MeetMarkers, ContradictionsAreMissedAndNamed) {
    const Mesh m = sphere(3);
    std::vector<Marker> markers = displaced(m, 4, 0.02);
    markers.push_back(markers[2]);
    markers.back().target += Point(0.05, 0, 0);
    const MetMarkers met = meet_markers(m, m, markers);
    EXPECT_EQ(met.missed, (std::vector<std::size_t>{2, 4}));
    EXPECT_TRUE(met.positions.allFinite());
    FitOptions options;
    options.markers_exact = true;
    const FitResult r = fit(m, m, markers, options);
    EXPECT_NE(r.notes.back().find("'m2'"), std::string::npos) << r.notes.back();
}

TEST(MeetMarkers, BothFitsEndOnTheirMarkers) {
    const Mesh m = sphere(4);
    Mesh target = sphere(5);
    target.positions.col(0) *= 1.2;
    std::vector<Marker> markers = displaced(m, 12, 0.05);
    for (Marker& marker : markers) marker.target[0] *= 1.2;
    for (const FitMethod method : {FitMethod::paper, FitMethod::surface}) {
        FitOptions options;
        options.method = method;
        options.markers_exact = true;
        const FitResult r = fit(m, target, markers, options);
        EXPECT_LT(worst(r.positions, m, markers), 1e-9 * diagonal(target));
    }
}

TEST(MeetMarkers, TheSameBitsWithAnyNumberOfThreads) {
    const Mesh m = sphere(4);
    const auto markers = displaced(m, 9, 0.05);
    set_threads(1);
    const Points one = meet_markers(m, m, markers).positions;
    set_threads(2);
    const Points two = meet_markers(m, m, markers).positions;
    set_threads(0);
    EXPECT_EQ(one, two);
}

TEST(MeetMarkers, WeightsOutOfRangeAreRefused) {
    const Mesh m = sphere(2);
    for (const double weight : {-1.0, 2000.0, std::numeric_limits<double>::quiet_NaN()}) {
        FitOptions options;
        options.marker_weight = weight;
        EXPECT_NE(message_of(ErrorKind::argument, [&] { fit(m, m, {}, options); }).find("marker weight"),
                  std::string::npos);
    }
}

} // namespace
