#include "meshtween/geometry/figure.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/surface_lookup.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace meshtween {
namespace {

TEST(Figure, RestPoseOfTheDefaultBuildIsTheBodyItself) {
    const Points marks = figure_landmarks().points;
    const Points same = figure(marks, {}, {});
    const Point shift = same.row(0) - marks.row(0);
    EXPECT_LT((same - marks).cwiseAbs().maxCoeff(), 0.03); // only its stance is put over the origin
    EXPECT_LT(((same.rowwise() - shift) - marks).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Figure, HasFortyNamesAndMirroredPairs) {
    const Landmarks marks = figure_landmarks();
    EXPECT_EQ(marks.names.size(), 40u);
    EXPECT_EQ(std::set(marks.names.begin(), marks.names.end()).size(), 40u);
    for (std::size_t i = 0; i < marks.names.size(); ++i) {
        if (!marks.names[i].ends_with("_L")) continue;
        std::string other = marks.names[i];
        other.back() = 'R';
        const auto j = std::find(marks.names.begin(), marks.names.end(), other) - marks.names.begin();
        ASSERT_LT(j, 40) << other;
        const Point left = marks.points.row(static_cast<Eigen::Index>(i)), right = marks.points.row(j);
        EXPECT_GT(left[0], 0);
        EXPECT_LT((left - Point(-right[0], right[1], right[2])).norm(), 1e-12);
    }
}

TEST(Figure, ForearmAndHeadTurnRigidly) {
    Points two(4, 3);
    two << 0.50, 1.08, -0.02, 0.53, 1.05, -0.01, 0, 1.70, 0.05, 0.02, 1.66, -0.05;
    FigurePose pose;
    pose.left_arm = {120, 30, 10, 60, 0};
    pose.neck = 30, pose.spine = 40, pose.pelvis = 50, pose.head_turn = 20;
    const Points moved = figure(two, {}, pose);
    EXPECT_NEAR((moved.row(0) - moved.row(1)).norm(), (two.row(0) - two.row(1)).norm(), 1e-9);
    EXPECT_NEAR((moved.row(2) - moved.row(3)).norm(), (two.row(2) - two.row(3)).norm(), 1e-9);
}

TEST(Figure, TallerBuildIsTaller) {
    Points top(2, 3);
    top << 0, 1.74, 0, 0, 0.001, 0;
    FigureBuild tall;
    tall.height = 1.1;
    const Points moved = figure(top, tall, {});
    EXPECT_NEAR(moved(0, 1) - moved(1, 1), 1.1 * 1.739, 1e-9);
}

TEST(Figure, HalfTheWayIsHalfOfEachAngle) {
    FigurePose a, b;
    b.spine = 40, b.left_arm.elbow = 90, b.right_leg.knee = 10;
    const FigurePose half = mix(a, b, 0.5);
    EXPECT_DOUBLE_EQ(half.spine, 20);
    EXPECT_DOUBLE_EQ(half.left_arm.elbow, 45);
    EXPECT_DOUBLE_EQ(half.right_leg.knee, 5);
    EXPECT_DOUBLE_EQ(half.left_arm.raise, 45);
}

TEST(SurfaceLookup, FindsFacesEdgesAndCorners) {
    Mesh mesh;
    mesh.positions.resize(4, 3);
    mesh.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    mesh.triangles.resize(4, 3);
    mesh.triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
    const SurfaceLookup lookup(mesh, 0.5);
    EXPECT_LT((lookup.closest(Point(0.2, 0.2, -0.1)) - Point(0.2, 0.2, 0)).norm(), 1e-12);
    EXPECT_LT((lookup.closest(Point(0.5, -0.1, -0.1)) - Point(0.5, 0, 0)).norm(), 1e-12);
    EXPECT_LT((lookup.closest(Point(-0.1, -0.1, -0.1)) - Point(0, 0, 0)).norm(), 1e-12);
    EXPECT_EQ(lookup.closest(Point(9, 9, 9)), Point(9, 9, 9));
}

} // namespace
} // namespace meshtween
