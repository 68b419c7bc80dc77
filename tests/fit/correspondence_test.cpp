#include "meshtween/fit/correspondence.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/io/table.h"

#include "support/scratch.h"
#include "support/shapes.h"

#include <gtest/gtest.h>

using namespace meshtween;

namespace {

TEST(Correspondence, AMeshAnswersToItself) {
    const Mesh m = sphere(4);
    const Correspondence c = correspondence(m, m);
    for (Eigen::Index i = 0; i < m.positions.rows(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        EXPECT_LT((position(m.positions, m.triangles, c.places[k]) - m.positions.row(i)).norm(), 1e-12);
        EXPECT_GT(c.agreement[k], 0.99);
        EXPECT_GT(c.trust[k], 0.99);
        EXPECT_EQ(c.border[k], 0);
    }
}

TEST(Correspondence, AVertexBetweenTwoSheetsFindsTheOneThatLooksItsWay) {
    Mesh sheet = wavy_sheet(6, 6);
    sheet.positions.col(2) *= 0.1;
    Mesh two = sheet; // the second, a little above, looks down
    const auto n = sheet.positions.rows(), m = sheet.triangles.rows();
    two.positions.conservativeResize(2 * n, 3);
    two.positions.bottomRows(n) = sheet.positions;
    two.positions.bottomRows(n).col(2).array() += 0.010;
    two.triangles.conservativeResize(2 * m, 3);
    for (Eigen::Index t = 0; t < m; ++t)
        two.triangles.row(m + t) << n + sheet.triangles(t, 0), n + sheet.triangles(t, 2), n + sheet.triangles(t, 1);
    Mesh between = sheet;
    between.positions.col(2).array() += 0.0055; // nearer to the wrong one
    for (const SurfacePoint& place : places_on(between, two)) EXPECT_LT(place.triangle, m);
}

TEST(Correspondence, NothingAnswersBeyondAHole) {
    const Mesh m = sphere(4);
    const Mesh half = part_of_mesh(m, [](const Point& p) { return p[2] < 0.3; });
    const Correspondence c = correspondence(m, half);
    for (Eigen::Index i = 0; i < m.positions.rows(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (m.positions(i, 2) > 0.35) {
            EXPECT_EQ(c.border[k], 1);
            EXPECT_EQ(c.trust[k], 0);
        }
        if (m.positions(i, 2) < 0.1) {
            EXPECT_GT(c.trust[k], 0.99);
        }
    }
}

TEST(Correspondence, ALegTheTargetHasNotFindsNoneInTheOther) {
    const Mesh m = two_legs();
    const Mesh one = part_of_mesh(m, [](const Point& p) { return p[0] < 0.1 || p[2] > 0; });
    const Correspondence c = correspondence(m, one);
    for (Eigen::Index i = 0; i < m.positions.rows(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        if (m.positions(i, 2) > 0.1 || m.positions(i, 0) < 0) {
            EXPECT_GT(c.trust[k], 0.9);
        } else if (m.positions(i, 2) < -1.1) {
            EXPECT_EQ(c.border[k], 1);
        }
    }
}

TEST(Correspondence, WhatTheMeshDoesNotCoverCostsTrustWhereItIs) {
    const Mesh m = sphere(4);
    Mesh horned = m;
    Eigen::Index top = 0;
    m.positions.col(2).maxCoeff(&top);
    horned.positions.row(top) *= 1.3;
    const Correspondence c = correspondence(m, horned);
    EXPECT_NEAR(c.uncovered[static_cast<std::size_t>(top)], 0.3 / diagonal(horned), 1e-6);
    EXPECT_LT(c.trust[static_cast<std::size_t>(top)], 0.01);
    Eigen::Index bottom = 0;
    m.positions.col(2).minCoeff(&bottom);
    EXPECT_GT(c.trust[static_cast<std::size_t>(bottom)], 0.99);
}

TEST(Correspondence, WhatLiesBeyondAnOpenTemplateIsNotUncovered) {
    const Mesh m = sphere(4);
    const Mesh half = part_of_mesh(m, [](const Point& p) { return p[2] < 0; });
    for (const double far : correspondence(half, m).uncovered) EXPECT_LT(far, 1e-9);
}

TEST(Correspondence, FilesSayWhatIsKnown) {
    const Scratch folder;
    const Mesh m = sphere(2);
    const Correspondence c = correspondence(m, m);
    write_map(c, folder.path("map.csv"));
    const Table map = read_table(folder.path("map.csv"));
    EXPECT_EQ(map.names, (std::vector<std::string>{"triangle", "a", "b", "c", "distance"}));
    ASSERT_EQ(map.values.rows(), m.positions.rows());
    for (Eigen::Index i = 0; i < map.values.rows(); ++i) {
        const SurfacePoint place{static_cast<int>(map.values(i, 0)), map.values.row(i).segment<3>(1)};
        EXPECT_LT((position(m.positions, m.triangles, place) - m.positions.row(i)).norm(), 1e-12);
    }
    write_weights(c, folder.path("weights.csv"));
    const Table weights = read_table(folder.path("weights.csv"));
    EXPECT_EQ(weights.names.front(), "trust");
    for (Eigen::Index i = 0; i < weights.values.rows(); ++i)
        EXPECT_NEAR(weights.values(i, 0), c.trust[static_cast<std::size_t>(i)], 1e-5);
    const Colors colors = trust_colors(c);
    EXPECT_GT(colors(0, 1), colors(0, 0)); // trusted: green
}

} // namespace
