#include "meshtween/morph/path_quality.h"

#include "meshtween/core/error.h"
#include "meshtween/morph/morph.h"
#include "support/posed.h"

#include <gtest/gtest.h>

namespace meshtween {
namespace {

TEST(PathQuality, ARigidTurnIsPerfect) {
    const Mesh bar = test::bar(10, 3);
    const auto at = [&](double u) { return test::turned(bar.positions, 3 * u, {1, 2, 3}, {u, 0, 0}); };
    for (const FrameQuality& frame : path_quality(bar.triangles, at).frames) {
        EXPECT_NEAR(frame.volume_ratio, 1, 1e-9);
        EXPECT_NEAR(frame.area_ratio, 1, 1e-9);
        EXPECT_NEAR(frame.edge_strain_max, 0, 1e-9);
        EXPECT_TRUE(frame.flipped.empty());
        EXPECT_TRUE(frame.self_intersections.empty());
    }
}

TEST(PathQuality, StraightLinesThroughAHalfTwistCollapse) {
    const Mesh bar = test::bar(40, 4);
    const Points to = test::twisted(bar.positions, 180 * test::degree);
    const Morph path = morph(bar, to, {.method = MorphMethod::linear});
    const PathQuality quality = path_quality(bar.triangles, path.at, {.frames = 3});
    ASSERT_EQ(quality.frames.size(), 3u);
    EXPECT_LT(quality.frames[1].volume_ratio, 0.7);
    EXPECT_GT(quality.frames[1].edge_strain_mean, 0.1);
    EXPECT_GT(quality.frames[1].edge_strain_max, quality.frames[1].edge_strain_mean);
}

TEST(PathQuality, FindsAFlippedTriangleAndACut) {
    Mesh bar = test::bar(10, 4);
    const auto at = [&](double u) {
        Points p = test::bent(bar.positions, 0.1 + u);
        if (u > 0 && u < 1) { // one vertex of the top thrown over its neighbours
            for (int i = 0; i < p.rows(); ++i)
                if ((bar.positions.row(i) - Point(5, 2, 0)).norm() < 1e-9)
                    p.row(i) += 2.5 * (p.row(i + 1) - p.row(i)).normalized();
        }
        return p;
    };
    const PathQuality quality = path_quality(bar.triangles, at, {.frames = 3});
    EXPECT_FALSE(quality.frames[1].flipped.empty());
    EXPECT_LT(quality.frames[1].flipped.size(), 8u);
    EXPECT_FALSE(quality.frames[1].self_intersections.empty());
    EXPECT_TRUE(quality.frames[0].flipped.empty());
    EXPECT_TRUE(path_quality(bar.triangles, at, {.frames = 3, .self_intersections = false})
                    .frames[1]
                    .self_intersections.empty());
}

TEST(PathQuality, CancelledAndBadOptions) {
    const Mesh bar = test::bar(3, 2);
    const auto at = [&](double) { return bar.positions; };
    EXPECT_TRUE(path_quality(bar.triangles, at, {}, [](double, std::string_view) { return false; }).cancelled);
    EXPECT_THROW(path_quality(bar.triangles, at, {.frames = 1}), Error);
}

} // namespace
} // namespace meshtween
