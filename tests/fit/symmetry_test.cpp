#include "meshtween/fit/symmetry.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/fit.h"
#include "meshtween/fit/marker_twins.h"
#include "meshtween/fit/markers.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/samples.h"
#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

using namespace meshtween;

namespace {

// Symmetric in z alone, its mesh too: wider and thicker towards one end, and bent.
Mesh wedge() {
    Mesh m = bar({1, 0.4, 0.5}, {24, 10, 12}, 0.08);
    for (Eigen::Index i = 0; i < m.positions.rows(); ++i) {
        const double x = m.positions(i, 0);
        m.positions(i, 1) *= 0.6 + 0.4 * x, m.positions(i, 2) *= 1.1 - 0.5 * x * x;
    }
    m.positions = bend(m.positions, 1, 0.7);
    m.positions /= diagonal(m);
    return m;
}

std::vector<Symmetry> symmetries_of(const Mesh& m) {
    return symmetries(m.positions, m.triangles, ClosestPointIndex(m));
}

std::vector<MarkerTwin> twins_of(const Mesh& source, const Mesh& target, const Points& from, const Points& to) {
    return marker_twins(source.positions, source.triangles, target.positions, target.triangles,
                        ClosestPointIndex(target), from, to);
}

Points some_vertices(const Points& all, int count, double least_z) {
    Points some(count, 3);
    int k = 0;
    for (Eigen::Index i = 7; k < count; i = (i + 61) % all.rows())
        if (all(i, 2) > least_z) some.row(k++) = all.row(i);
    return some;
}

TEST(Symmetry, FindsThePlaneOfAShapeTurnedAnyWay) {
    for (const double angle : {0.0, 0.4, 1.9, 2.8}) {
        Mesh m = wedge();
        const Point axis(1, 2, -0.7), moved(0.3, -0.2, 0.5);
        m.positions = turn(m.positions, axis, angle).rowwise() + moved;
        const Point normal = turn(Points(Point(0, 0, 1)), axis, angle).row(0);
        const auto found = symmetries_of(m);
        ASSERT_EQ(found.size(), 1u) << angle;
        EXPECT_NEAR(std::abs(found[0].plane.normal.dot(normal)), 1, 1e-12) << angle;
        EXPECT_NEAR(found[0].plane.height(moved), 0, 1e-6) << angle;
        EXPECT_DOUBLE_EQ(found[0].plane.normal.norm(), 1) << angle;
        EXPECT_GT(found[0].share, 0.999) << angle;
    }
}

TEST(Symmetry, ImagesOfImagesAreThePlacesThemselves) {
    const MirrorPlane plane{Point(1, 2, 3).normalized(), 0.4};
    const Point p(0.3, -1, 2);
    EXPECT_NEAR((plane.image(plane.image(p)) - p).norm(), 0, 1e-15);
    EXPECT_NEAR(plane.height(plane.image(p)), -plane.height(p), 1e-15);
    EXPECT_NEAR(plane.image_of_direction(plane.normal).dot(plane.normal), -1, 1e-15);
}

TEST(Symmetry, ABarHasThreePlanes) {
    Mesh m = bar({1, 0.7, 0.5}, {20, 14, 10}, 0.1);
    m.positions /= diagonal(m);
    EXPECT_EQ(symmetries_of(m).size(), 3u);
}

TEST(Symmetry, WhatIsTurnedOntoItselfHasNone) {
    Mesh ball = sphere(4);
    ball.positions /= diagonal(ball);
    EXPECT_TRUE(symmetries_of(ball).empty());
    Mesh ring = torus(0.3, 0.1, 60, 24);
    EXPECT_LE(symmetries_of(ring).size(), 1u); // that across its axis
}

TEST(Symmetry, AnAsymmetricShapeHasNone) {
    Mesh m = bar({1, 0.5, 0.3}, {24, 12, 8}, 0.08);
    for (Eigen::Index i = 0; i < m.positions.rows(); ++i) {
        const Point p = m.positions.row(i);
        m.positions(i, 1) = p[1] * (0.5 + p[0]) + 0.6 * p[2];
        m.positions(i, 2) = p[2] * (1.6 - 1.2 * p[0]) + 0.3 * p[0] * p[0];
    }
    m.positions = twist(m.positions, 1, 1.2);
    m.positions /= diagonal(m);
    EXPECT_TRUE(symmetries_of(m).empty());
}

TEST(Symmetry, TheSameBitsWithAnyNumberOfThreads) {
    const Mesh m = wedge();
    set_threads(1);
    const auto one = symmetries_of(m);
    set_threads(2);
    const auto two = symmetries_of(m);
    set_threads(0);
    ASSERT_EQ(one.size(), two.size());
    EXPECT_EQ(one[0].plane.normal, two[0].plane.normal);
    EXPECT_EQ(one[0].misfits, two[0].misfits);
}

TEST(Symmetry, ALiftedPartIsFarFromItsImageAndTheRestIsNot) {
    Mesh m = wedge();
    const Points before = m.positions;
    for (Eigen::Index i = 0; i < m.positions.rows(); ++i) // a dent on one side, at one end
        if (before(i, 2) > 0)
            m.positions(i, 1) += 0.2 * std::max(0.0, 0.25 - (before(i, 0) - before.col(0).minCoeff()));
    const auto found = symmetries_of(m);
    ASSERT_FALSE(found.empty());
    Eigen::Index first = 0, last = 0;
    (before.col(0) - before.col(2)).minCoeff(&first), (before.col(0) + before.col(2)).maxCoeff(&last);
    EXPECT_GT(asymmetry(found[0], m.positions.row(first)), 0.01);
    EXPECT_LT(asymmetry(found[0], m.positions.row(last)), 0.002);
}

TEST(MarkerTwins, AreTheImagesOnBothShapes) {
    const Mesh m = wedge();
    Mesh target = m;
    target.positions.col(0) *= 1.1;
    const Points from = some_vertices(m.positions, 8, 0.05);
    Points to = from;
    to.col(0) *= 1.1;
    const auto twins = twins_of(m, target, from, to);
    ASSERT_EQ(twins.size(), 8u);
    for (std::size_t k = 0; k < 8; ++k) {
        Point image = from.row(static_cast<Eigen::Index>(k));
        image[2] *= -1;
        EXPECT_LT((position(m.positions, m.triangles, twins[k].source) - image).norm(), 1e-6);
        image[0] *= 1.1;
        EXPECT_LT((twins[k].target - image).norm(), 1e-6);
        EXPECT_GT(twins[k].weight, 0.999);
        EXPECT_LT(twins[k].slack, 1e-3);
    }
}

TEST(MarkerTwins, NoneWhereAMarkerIsAlready) {
    const Mesh m = wedge();
    Points markers(10, 3);
    markers.topRows(5) = some_vertices(m.positions, 5, 0.05);
    markers.bottomRows(5) = markers.topRows(5);
    markers.bottomRows(5).col(2) *= -1;
    EXPECT_TRUE(twins_of(m, m, markers, markers).empty());
}

TEST(MarkerTwins, PairsThatDisagreeGiveSlack) {
    const Mesh m = wedge();
    Points from(9, 3);
    from.topRows(8) = some_vertices(m.positions, 8, 0.05);
    from.row(8) = from.row(0), from(8, 2) *= -1;
    Points to = from;
    to.row(8) += Point(0.008, 0, 0);
    const auto twins = twins_of(m, m, from, to);
    EXPECT_FALSE(twins.empty());
    for (const MarkerTwin& twin : twins) EXPECT_NEAR(twin.slack, 0.008, 0.001);
}

TEST(MarkerTwins, NoneWhereMarkersSayThatThePlanesDiffer) {
    const Mesh m = wedge();
    const Points from = some_vertices(m.positions, 12, -1);
    Points to = from;
    for (Eigen::Index k = 0; k < to.rows(); k += 2) to(k, 2) *= -1; // left and right at random
    EXPECT_FALSE(twins_of(m, m, from, from).empty());
    EXPECT_TRUE(twins_of(m, m, from, to).empty());
}

// The made woman and man are symmetric: markers on her left side alone.
TEST(MarkerTwins, BringTheOtherSideNearer) {
    const Sample s = sample("build");
    std::vector<MarkerPair> pairs;
    for (Eigen::Index k = 0; k < s.marker_source.rows(); ++k)
        if (s.marker_source(k, 0) > 0)
            pairs.push_back(
                {s.marker_names[static_cast<std::size_t>(k)], s.marker_source.row(k), s.marker_target.row(k)});
    const std::vector<Marker> markers = place_markers(pairs, s.source);
    const auto error = [&](bool symmetry) {
        FitOptions options;
        options.symmetry = symmetry;
        const FitResult r = fit(s.source, s.target, markers, options);
        EXPECT_EQ(r.twins > 0, symmetry);
        return (r.positions - s.truth).rowwise().norm().mean() / diagonal(s.target);
    };
    EXPECT_LT(error(true), 0.9 * error(false));
}

} // namespace
