#include "meshtween/fit/hierarchy.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

#include <numbers>

using namespace meshtween;

namespace {

std::vector<Eigen::Index> sizes(const Mesh& mesh, const HierarchyOptions& options) {
    std::vector<Eigen::Index> result;
    for (const Level& level : hierarchy(mesh.positions, mesh.triangles, options))
        result.push_back(level.positions.rows());
    return result;
}

TEST(Hierarchy, EndsAtTheSameSizeWhateverItStartsAt) {
    const Mesh mesh = sphere(4); // 2562 vertices
    EXPECT_EQ(sizes(mesh, {250, 4}), (std::vector<Eigen::Index>{2562, 640, 250}));
    EXPECT_EQ(sizes(mesh, {330, 4}), (std::vector<Eigen::Index>{2562, 330})) << "640 would be less than twice as many";
    EXPECT_EQ(sizes(mesh, {2562, 4}), (std::vector<Eigen::Index>{2562})) << "small enough";
    EXPECT_EQ(sizes(mesh, {2000, 4}), (std::vector<Eigen::Index>{2562})) << "no further step is worth its while";
}

TEST(Hierarchy, LevelsLieOnTheMeshAndPlacesAreNear) {
    const Mesh m = sphere(5);
    const auto levels = hierarchy(m.positions, m.triangles, {100, 4});
    ASSERT_GE(levels.size(), 3u);
    for (std::size_t k = 1; k < levels.size(); ++k) {
        const Level& level = levels[k];
        for (std::size_t i = 0; i < level.finer.size(); ++i)
            EXPECT_EQ(level.positions.row(static_cast<Eigen::Index>(i)), levels[k - 1].positions.row(level.finer[i]));
        EXPECT_GT(volume(level.positions, level.triangles), 0.75 * 4 * std::numbers::pi / 3);
        ASSERT_EQ(level.place.size(), static_cast<std::size_t>(levels[k - 1].positions.rows()));
        for (std::size_t i = 0; i < level.place.size(); ++i)
            EXPECT_LT((position(level.positions, level.triangles, level.place[i]) -
                       levels[k - 1].positions.row(static_cast<Eigen::Index>(i)))
                          .norm(),
                      0.3);
    }
}

} // namespace
