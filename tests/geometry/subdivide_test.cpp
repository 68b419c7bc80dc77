#include "meshtween/geometry/subdivide.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"

#include "support/closed.h"

#include <gtest/gtest.h>

namespace meshtween {
namespace {

TEST(Subdivide, KeepsTheSurfaceAndTheFirstVertices) {
    const Mesh ball = sphere(2), fine = subdivide(ball, 2);
    EXPECT_EQ(fine.triangles.rows(), 16 * ball.triangles.rows());
    EXPECT_EQ(fine.positions.topRows(ball.positions.rows()), ball.positions);
    EXPECT_TRUE(closed(fine));
    EXPECT_EQ(euler(fine), 2);
    EXPECT_NEAR(volume(fine.positions, fine.triangles), volume(ball.positions, ball.triangles), 1e-12);
    EXPECT_NEAR(surface_area(fine.positions, fine.triangles), surface_area(ball.positions, ball.triangles), 1e-12);
}

TEST(Subdivide, NoTimesIsTheMeshItself) {
    const Mesh ball = sphere(1), same = subdivide(ball, 0);
    EXPECT_EQ(same.positions, ball.positions);
    EXPECT_EQ(same.triangles, ball.triangles);
}

TEST(Subdivide, CarriesColoursAndSeams) {
    Mesh quad;
    quad.positions = Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    quad.triangles = Triangles{{0, 1, 2}, {0, 2, 3}};
    quad.colors = Colors::Zero(4, 4);
    quad.colors.row(1).setOnes();
    quad.texcoords = Texcoords{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}; // a seam along the diagonal
    quad.texcoord_triangles = Triangles{{0, 1, 2}, {3, 4, 5}};
    const Mesh fine = subdivide(quad, 1);
    ASSERT_EQ(fine.positions.rows(), 4 + 5);
    ASSERT_EQ(fine.texcoords.rows(), 6 + 6);
    EXPECT_FLOAT_EQ(fine.colors.bottomRows(5).col(0).sum(), 1); // two edges of five end at the white corner
    for (Eigen::Index t = 0; t < fine.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const auto place = fine.positions.row(fine.triangles(t, k));
            const auto at = fine.texcoords.row(fine.texcoord_triangles(t, k));
            EXPECT_FLOAT_EQ(static_cast<float>(place[0]), at[0]);
            EXPECT_FLOAT_EQ(static_cast<float>(place[1]), at[1]);
        }
}

TEST(Subdivide, AnySetOfEdgesLeavesTheSurfaceWhole) {
    const Mesh ball = sphere(2);
    const Topology edges = topology(ball.positions.rows(), ball.triangles);
    for (const std::size_t every : {1, 2, 3, 5, 7, 1000000}) {
        std::vector<char> cut(edges.edges.size(), 0);
        for (std::size_t e = 0; e < cut.size(); e += every) cut[e] = 1;
        const Mesh fine = subdivide(ball, edges, cut);
        const auto count = std::count(cut.begin(), cut.end(), 1);
        EXPECT_EQ(fine.positions.rows(), ball.positions.rows() + count);
        EXPECT_EQ(fine.triangles.rows(), ball.triangles.rows() + 2 * count);
        EXPECT_TRUE(closed(fine)) << every;
        EXPECT_EQ(euler(fine), 2);
        EXPECT_NEAR(volume(fine.positions, fine.triangles), volume(ball.positions, ball.triangles), 1e-12);
    }
    EXPECT_EQ(subdivide(ball, edges, std::vector<char>(edges.edges.size(), 1)).triangles, subdivide(ball, 1).triangles);
}

TEST(Subdivide, CutsSeamsWithTheirEdges) {
    Mesh quad;
    quad.positions = Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    quad.triangles = Triangles{{0, 1, 2}, {0, 2, 3}};
    quad.texcoords = Texcoords{{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    quad.texcoord_triangles = Triangles{{0, 1, 2}, {3, 4, 5}};
    const Topology edges = topology(4, quad.triangles);
    for (unsigned set = 0; set < 32; ++set) {
        std::vector<char> cut;
        for (unsigned e = 0; e < 5; ++e) cut.push_back(set >> e & 1 ? 1 : 0);
        const Mesh fine = subdivide(quad, edges, cut);
        for (Eigen::Index t = 0; t < fine.triangles.rows(); ++t) {
            EXPECT_GT(double_area_normal(fine.positions, fine.triangles, t)[2], 0);
            for (int k = 0; k < 3; ++k)
                EXPECT_LT((fine.positions.row(fine.triangles(t, k)).leftCols<2>().cast<float>() -
                           fine.texcoords.row(fine.texcoord_triangles(t, k)))
                              .norm(),
                          1e-6F);
        }
    }
}

} // namespace
} // namespace meshtween
