#include "meshtween/geometry/topology.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meshtween {
namespace {

Triangles strip() { // two triangles that share the edge 1-2, and a vertex 4 of no triangle
    Triangles t(2, 3);
    t << 0, 1, 2, 2, 1, 3;
    return t;
}

TEST(Topology, Strip) {
    const Topology top = topology(5, strip());
    ASSERT_EQ(top.edges.size(), 5u);
    const auto inner = std::find_if(top.edges.begin(), top.edges.end(), [](const Edge& e) { return e.count == 2; });
    EXPECT_EQ(inner->vertices, (std::array{1, 2}));
    EXPECT_EQ(inner->triangles, (std::array{0, 1}));
    EXPECT_EQ(std::vector(top.neighbours[1].begin(), top.neighbours[1].end()), (std::vector{0, 2, 3}));
    EXPECT_EQ(top.neighbours[4].size(), 0u);
    EXPECT_EQ(top.vertex_triangles[2].size(), 2u);
    EXPECT_EQ(top.on_boundary, (std::vector<char>{1, 1, 1, 1, 0}));
}

TEST(Topology, Components) {
    const Topology top = topology(5, strip());
    EXPECT_EQ(components(top), (std::vector{0, 0, 0, 0, 1}));
}

TEST(Topology, BoundaryRunsWithTheTriangles) {
    const auto loops = boundary_loops(strip(), topology(5, strip()));
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_EQ(loops[0], (std::vector{0, 1, 3, 2}));
}

TEST(Topology, ThreeTrianglesOnAnEdge) {
    Triangles t(3, 3);
    t << 0, 1, 2, 0, 1, 3, 0, 1, 4;
    const Topology top = topology(5, t);
    EXPECT_EQ(std::count_if(top.edges.begin(), top.edges.end(), [](const Edge& e) { return e.count == 3; }), 1);
}

} // namespace
} // namespace meshtween
