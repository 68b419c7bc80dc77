#include "meshtween/geometry/measure.h"
#include "meshtween/morph/curve.h"
#include "meshtween/morph/morph.h"
#include "meshtween/morph/path_quality.h"
#include "support/posed.h"

#include <gtest/gtest.h>

namespace meshtween {
namespace {

const Eigen::Vector3d axis(1, 2, 0.5);

struct Kept {
    double edges = 0, volume = 0;
};

// Edge error and relative volume of the half-way shape.
Kept half_way(const Mesh& from, const Points& to) {
    const Points shape = morph(from, to).at(0.5);
    const double ends = (volume(from.positions, from.triangles) + volume(to, from.triangles)) / 2;
    return {test::edge_error(from.triangles, from.positions, to, shape), volume(shape, from.triangles) / ends};
}

TEST(Rigid, BendsKeepLengthsAndVolume) {
    const Mesh bar = test::bar(40, 4);
    for (const double angle : {90, 180, 270}) {
        const Kept kept = half_way(bar, test::bent(bar.positions, angle * test::degree));
        EXPECT_LT(kept.edges, 0.005) << angle;
        EXPECT_NEAR(kept.volume, 1, 0.005) << angle;
    }
}

TEST(Rigid, TwistsKeepLengthsAndVolume) {
    const Mesh bar = test::bar(48, 4);
    for (const double angle : {180, 270}) {
        const Kept kept = half_way(bar, test::twisted(bar.positions, angle * test::degree));
        EXPECT_LT(kept.edges, 0.005) << angle;
        EXPECT_NEAR(kept.volume, 1, 0.005) << angle;
    }
}

TEST(Rigid, ThickBarsTwistToo) { // 4 : 1 : 1, where half the twist would miss the lengths by 1.6 %
    const Mesh bar = test::bar(32, 8);
    for (const double angle : {180, 225, 270}) {
        const PathQuality quality =
            path_quality(bar.triangles, morph(bar, test::twisted(bar.positions, angle * test::degree)).at,
                         {.frames = 5, .self_intersections = false});
        for (const FrameQuality& frame : quality.frames) {
            EXPECT_LT(frame.edge_strain_mean, 0.005) << angle << " at " << frame.u;
            EXPECT_NEAR(frame.volume_ratio, 1, 0.005) << angle << " at " << frame.u;
            EXPECT_TRUE(frame.flipped.empty()) << angle << " at " << frame.u;
        }
    }
}

TEST(Rigid, AMiddleOfMeanSize) { // a bar that twists and grows: lengths decide, not the mean of the volumes
    const Mesh bar = test::bar(32, 8);
    const Points to = 1.5 * test::twisted(bar.positions, 200 * test::degree);
    const Points half = morph(bar, to).at(0.5);
    EXPECT_NEAR(volume(half, bar.triangles) / volume(bar.positions, bar.triangles), std::pow(1.25, 3), 0.02);
}

TEST(Rigid, TwoWholeTurns) {
    const Mesh bar = test::bar(96, 4);
    const Points to = test::twisted(bar.positions, 720 * test::degree);
    EXPECT_LT(half_way(bar, to).edges, 0.02);
    const Mesh thick = test::bar(48, 8);
    const PathQuality quality =
        path_quality(thick.triangles, morph(thick, test::twisted(thick.positions, 720 * test::degree)).at,
                     {.frames = 3, .self_intersections = false});
    EXPECT_LT(quality.frames[1].edge_strain_mean, 0.02);
    EXPECT_TRUE(quality.frames[1].flipped.empty());
    const Points shape = morph(bar, to).at(0.5), wanted = test::twisted(bar.positions, 360 * test::degree);
    // Every section lies half-way round: both ends' corners are as far apart as in the bar of one turn.
    const double apart = (shape.row(0) - shape.row(shape.rows() - 1)).norm();
    EXPECT_GT(volume(shape, bar.triangles), 0.95 * volume(wanted, bar.triangles));
    EXPECT_NEAR(apart, (wanted.row(0) - wanted.row(wanted.rows() - 1)).norm(), 0.02 * apart);
}

TEST(Rigid, ATurnedShapeStaysCongruent) {
    const Mesh bar = test::bar(12, 3);
    for (const double angle : {10, 90, 179, 180, 250}) {
        const Points to = test::turned(bar.positions, angle * test::degree, axis, {4, 5, 6});
        const Morph path = morph(bar, to);
        for (const double u : {0.25, 0.5, 0.8})
            EXPECT_LT(test::edge_error(bar.triangles, bar.positions, to, path.at(u), u), 1e-9) << angle;
    }
}

TEST(Rigid, ATurnedTargetGivesTheSameShapes) {
    const Mesh bar = test::bar(20, 3);
    for (const Points& shape : {test::bent(bar.positions, 2), test::twisted(bar.positions, 4)}) {
        const Points to = test::shaken(shape, 0.1);
        const Points one = morph(bar, to).at(0.4);
        const Points other = morph(bar, test::turned(to, 2.5, axis, {3, -9, 1})).at(0.4);
        EXPECT_LT(test::edge_error(bar.triangles, one, one, other), 1e-6);
    }
}

TEST(Rigid, BackwardsIsTheSamePath) {
    const Mesh bar = test::bar(30, 3);
    const Points to = test::shaken(test::twisted(test::bent(bar.positions, 2), 3), 0.1);
    Mesh end = bar;
    end.positions = to;
    const Points there = morph(bar, to).at(0.3), back = morph(end, bar.positions).at(0.7);
    EXPECT_LT(test::distance(there, back), 1e-3 * diagonal(to));
}

TEST(Rigid, StretchIsBlendedLinearly) {
    const Mesh bar = test::bar(10, 3);
    const Points to = 2 * bar.positions;
    EXPECT_LT(test::distance(morph(bar, to).at(0.5), 1.5 * bar.positions), 1e-9);
}

TEST(Rigid, PartsGoAlongWithTheirNeighbours) { // a bar that bends, and a small box floating at its far end
    Mesh mesh = test::bar(40, 4);
    const Mesh box = test::bar(2, 2);
    const auto n = mesh.positions.rows(), m = mesh.triangles.rows();
    mesh.positions.conservativeResize(n + box.positions.rows(), 3);
    mesh.positions.bottomRows(box.positions.rows()) = box.positions.rowwise() + Point(36, 5, 0);
    mesh.triangles.conservativeResize(m + box.triangles.rows(), 3);
    mesh.triangles.bottomRows(box.triangles.rows()) = box.triangles.array() + static_cast<int>(n);
    const Points to = test::bent(mesh.positions, 180 * test::degree);
    const Points half = morph(mesh, to).at(0.5), wanted = test::bent(mesh.positions, 90 * test::degree);
    const auto gap = [&](const Points& p) {
        return (p.bottomRows(box.positions.rows()).colwise().mean() - p.topRows(n).colwise().mean()).norm();
    };
    EXPECT_NEAR(gap(half), gap(wanted), 0.01 * gap(wanted));
}

TEST(Rigid, OpenSheetsRoll) {
    Mesh sheet = test::bar(30, 6);
    std::vector<Eigen::Index> kept; // the side that faces up
    for (Eigen::Index t = 0; t < sheet.triangles.rows(); ++t)
        if (double_area_normal(sheet.positions, sheet.triangles, t)[1] > 0.5) kept.push_back(t);
    sheet.triangles = Triangles(sheet.triangles(kept, Eigen::all));
    const Points to = test::bent(sheet.positions, 300 * test::degree);
    EXPECT_LT(half_way(sheet, to).edges, 0.02);
}

TEST(Rigid, CurvesAreSmooth) {
    const Mesh bar = test::bar(40, 4);
    const Curve c = curve(morph(bar, test::bent(bar.positions, 270 * test::degree)));
    EXPECT_LE(c.nodes.size(), 9u);
    EXPECT_LE(c.deviation, 1e-4);
}

} // namespace
} // namespace meshtween
