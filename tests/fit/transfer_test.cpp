#include "meshtween/fit/transfer.h"

#include "meshtween/fit/correspondence.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"

#include "support/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace meshtween;

namespace {

// A sheet over [0, 1]^2 with texture coordinates that are its x and y, as one chart.
Mesh textured_sheet(int rows, int columns) {
    Mesh mesh = wavy_sheet(rows, columns);
    for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i)
        mesh.positions.row(i) << static_cast<double>(i % columns) / (columns - 1),
            static_cast<double>(i / columns) / (rows - 1), 0;
    mesh.texcoords = mesh.positions.leftCols<2>().cast<float>();
    mesh.texcoord_triangles = mesh.triangles;
    return mesh;
}

// A tube of length 1 around z whose u is the angle over a turn: a seam where u falls from 1 to 0.
Mesh textured_tube(int around, int along) {
    const Mesh sheet = textured_sheet(along + 1, around + 1);
    Mesh tube;
    tube.texcoords = sheet.texcoords, tube.texcoord_triangles = sheet.triangles;
    tube.positions.resize(around * (along + 1), 3);
    for (int j = 0; j <= along; ++j)
        for (int i = 0; i < around; ++i) {
            const double angle = 2 * std::numbers::pi * i / around;
            tube.positions.row(j * around + i) << std::cos(angle), std::sin(angle), 1.0 * j / along;
        }
    tube.triangles =
        sheet.triangles.unaryExpr([&](int v) { return v / (around + 1) * around + v % (around + 1) % around; });
    return tube;
}

TEST(Transfer, LinearValuesAreCarriedExactly) {
    const Mesh giver = textured_sheet(7, 5), receiver = textured_sheet(4, 9);
    Eigen::MatrixXd values(giver.positions.rows(), 2);
    values.col(0) = 3 * giver.positions.col(0) - giver.positions.col(1);
    values.col(1).setConstant(7);
    const Eigen::MatrixXd got = carried(values, giver.triangles, places_on(receiver, giver));
    EXPECT_LT((got.col(0) - 3 * receiver.positions.col(0) + receiver.positions.col(1)).norm(), 1e-12);
    EXPECT_LT((got.col(1).array() - 7).matrix().norm(), 1e-12);
}

TEST(Transfer, ColoursAndTextureCoordinatesOfAChart) {
    Mesh giver = textured_sheet(7, 5);
    giver.colors = Colors::Ones(giver.positions.rows(), 4);
    giver.colors.col(1) = giver.positions.col(0).cast<float>();
    Mesh receiver = textured_sheet(4, 9);
    receiver.texcoords.resize(0, 2), receiver.texcoord_triangles.resize(0, 3);
    const Mesh got = with_attributes(receiver, giver, places_on(receiver, giver));
    EXPECT_EQ(got.triangles, receiver.triangles);
    EXPECT_LT((got.colors.col(1) - receiver.positions.col(0).cast<float>()).norm(), 1e-5F);
    EXPECT_EQ(got.texcoords.rows(), receiver.positions.rows()); // one a vertex where there is no seam
    for (Eigen::Index t = 0; t < got.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            EXPECT_LT((got.texcoords.row(got.texcoord_triangles(t, k)) -
                       receiver.positions.row(receiver.triangles(t, k)).leftCols<2>().cast<float>())
                          .norm(),
                      1e-5F);
}

TEST(Transfer, NoTriangleIsDrawnAcrossASeam) {
    const Mesh giver = textured_tube(40, 10);
    Mesh receiver = textured_tube(29, 8);
    receiver.positions = turn(receiver.positions, {0, 0, 1}, 0.1); // so that triangles lie across the giver's seam
    const Mesh got = with_attributes(receiver, giver, places_on(receiver, giver));
    for (Eigen::Index t = 0; t < got.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const auto a = got.texcoords.row(got.texcoord_triangles(t, k)),
                       b = got.texcoords.row(got.texcoord_triangles(t, (k + 1) % 3));
            EXPECT_LT(std::abs(a[0] - b[0]), 1.5F / 29); // an edge of the receiver, not the way around
        }
}

TEST(Transfer, AGiverWhoseNumberingIsCutGivesTheSame) {
    const Mesh giver = textured_tube(40, 10), receiver = textured_tube(29, 8);
    Mesh cut = giver; // a vertex of its own for each texture coordinate, as files of glTF have it
    cut.triangles = giver.texcoord_triangles;
    cut.positions.resize(giver.texcoords.rows(), 3);
    for (Eigen::Index t = 0; t < giver.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            cut.positions.row(giver.texcoord_triangles(t, k)) = giver.positions.row(giver.triangles(t, k));
    const Mesh whole = with_attributes(receiver, giver, places_on(receiver, giver)),
               got = with_attributes(receiver, cut, places_on(receiver, cut));
    EXPECT_EQ(got.texcoords, whole.texcoords);
    EXPECT_EQ(got.texcoord_triangles, whole.texcoord_triangles);
}

TEST(Transfer, PointsGoThereAndBack) {
    const Mesh coarse = sphere(4);
    Mesh fitted = coarse, target = sphere(5);
    for (Mesh* m : {&fitted, &target})
        m->positions = (3 * turn(m->positions, {1, 0, 0}, 1.0)).rowwise() + Point(9, 0, 0);
    const TwoShapes ours{coarse, fitted}, theirs{target, target};
    const Points given = coarse.positions.topRows(30);
    const Points there = carried_points(given, ours, theirs);
    EXPECT_LT((there - fitted.positions.topRows(30)).rowwise().norm().maxCoeff(), 0.02);
    const Points back = carried_points(there, theirs, ours);
    EXPECT_LT((back - given).rowwise().norm().maxCoeff(), 0.01);
}

} // namespace
