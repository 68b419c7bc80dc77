#include "meshtween/fit/worst_places.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"

#include "support/shapes.h"

#include <gtest/gtest.h>

using namespace meshtween;

namespace {

Eigen::Index topmost(const Mesh& mesh, int axis) {
    Eigen::Index top = 0;
    mesh.positions.col(axis).maxCoeff(&top);
    return top;
}

std::vector<WorstPlace> faults_of(const Mesh& source, const Mesh& fitted, const Mesh& target) {
    return place_faults(source, fitted, correspondence(fitted, target));
}

TEST(WorstPlaces, APerfectFitHasNone) {
    const Mesh m = sphere(4);
    EXPECT_TRUE(worst_places(m, faults_of(m, m, m)).empty());
}

TEST(WorstPlaces, EachKindIsFoundWhereItIs) {
    const Mesh m = sphere(4);
    Mesh fitted = m, target = m;
    const Eigen::Index lifted = topmost(m, 0), horn = topmost(m, 2);
    fitted.positions.row(lifted) *= 1.08;
    target.positions.row(horn) *= 1.4;
    const auto worst = worst_places(fitted, faults_of(m, fitted, target));
    ASSERT_GE(worst.size(), 2u);
    EXPECT_EQ(worst[0].vertex, horn);
    EXPECT_EQ(worst[0].fault, PlaceFault::uncovered);
    EXPECT_NEAR(worst[0].value, 0.4 / diagonal(target), 1e-6);
    EXPECT_EQ(worst[1].vertex, lifted);
    EXPECT_EQ(worst[1].fault, PlaceFault::off_target);
    for (std::size_t i = 1; i < worst.size(); ++i) EXPECT_LE(worst[i].badness, worst[i - 1].badness);
}

TEST(WorstPlaces, StretchIsBesideTheChangeOfTheWhole) {
    const Mesh m = sphere(4);
    Mesh grown = m;
    grown.positions *= 7;
    EXPECT_TRUE(worst_places(grown, faults_of(m, grown, grown)).empty());
    Mesh drawn = m;
    const Eigen::Index i = topmost(m, 1);
    drawn.positions.row(i) += Point(0.05, 0, 0.05); // along the surface, so that other triangles there shrink
    const auto worst = worst_places(drawn, faults_of(m, drawn, drawn));
    ASSERT_FALSE(worst.empty());
    EXPECT_EQ(worst[0].fault, PlaceFault::stretched);
    EXPECT_LT((m.positions.row(worst[0].vertex) - m.positions.row(i)).norm(), 0.2);
}

TEST(WorstPlaces, WhatTheTargetDoesNotShowIsNoFault) {
    const Mesh m = two_legs();
    const Mesh body = part_of_mesh(m, [](const Point& p) { return p[2] > -0.3; });
    Mesh fitted = m;
    fitted.positions.row(topmost(m, 2)) *= 1.08;
    const std::vector<WorstPlace> faults = faults_of(m, fitted, body);
    const auto worst = worst_places(fitted, faults);
    ASSERT_GE(worst.size(), 2U);
    EXPECT_EQ(worst[0].fault, PlaceFault::off_target);
    EXPECT_EQ(worst[1].fault, PlaceFault::beyond);
    EXPECT_EQ(worst[1].badness, 1);
    for (const MarkerSuggestion& s : suggest_markers(m, body, correspondence(fitted, body), faults, {}))
        EXPECT_GT(m.positions(s.place.vertex, 2), -0.5);
}

TEST(SuggestMarkers, StartAtTheWorstAndKeepApart) {
    const Mesh m = sphere(4);
    Mesh target = m;
    const Eigen::Index horn = topmost(m, 2);
    target.positions.row(horn) *= 1.4;
    const Correspondence map = correspondence(m, target);
    const auto faults = place_faults(m, m, map);
    const auto next = suggest_markers(m, target, map, faults, {});
    ASSERT_EQ(next.size(), 5u);
    EXPECT_EQ(next[0].place.vertex, horn);
    EXPECT_LT((next[0].target - target.positions.row(horn)).norm(), 1e-9); // where the uncovered part is
    for (std::size_t a = 0; a < next.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            EXPECT_GT((m.positions.row(next[a].place.vertex) - m.positions.row(next[b].place.vertex)).norm(),
                      0.05 * diagonal(m));
}

TEST(SuggestMarkers, NoneBesideAMarker) {
    const Mesh m = sphere(4);
    Mesh target = m;
    const Eigen::Index horn = topmost(m, 2);
    target.positions.row(horn) *= 1.4;
    std::vector<Marker> markers;
    for (Eigen::Index t = 0; t < m.triangles.rows() && markers.empty(); ++t)
        if (m.triangles(t, 0) == horn) markers.push_back({"horn", {static_cast<int>(t), {1, 0, 0}}, {0, 0, 0}});
    ASSERT_EQ(markers.size(), 1u);
    const Correspondence map = correspondence(m, target);
    for (const MarkerSuggestion& s : suggest_markers(m, target, map, place_faults(m, m, map), markers, 10))
        EXPECT_GT((m.positions.row(s.place.vertex) - m.positions.row(horn)).norm(), 0.03 * diagonal(m));
}

} // namespace
