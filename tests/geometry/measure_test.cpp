#include "meshtween/geometry/measure.h"

#include "support/shapes.h"

#include <gtest/gtest.h>

namespace meshtween {
namespace {

TEST(Measure, Cube) {
    const Mesh cube = unit_cube();
    EXPECT_DOUBLE_EQ(volume(cube.positions, cube.triangles), 1);
    EXPECT_DOUBLE_EQ(surface_area(cube.positions, cube.triangles), 6);
    EXPECT_DOUBLE_EQ(diagonal(cube), std::sqrt(3.0));
}

TEST(Measure, InsideOutHasNegativeVolume) {
    Mesh cube = unit_cube();
    cube.triangles.col(0).swap(cube.triangles.col(1));
    EXPECT_DOUBLE_EQ(volume(cube.positions, cube.triangles), -1);
}

TEST(Measure, VolumeDoesNotDependOnThePlace) {
    Mesh cube = unit_cube();
    cube.positions.rowwise() += Point(1e6, -1e6, 1e6);
    EXPECT_NEAR(volume(cube.positions, cube.triangles), 1, 1e-9);
}

TEST(Measure, NormalsOfTheCubeLookAlongItsDiagonals) {
    const Mesh cube = unit_cube();
    const Points normals = vertex_normals(cube.positions, cube.triangles);
    for (int i = 0; i < 8; ++i) {
        const Point outward = (cube.positions.row(i) - Point(0.5, 0.5, 0.5)).normalized();
        EXPECT_NEAR((normals.row(i) - outward).norm(), 0, 1e-12) << i;
    }
}

TEST(Measure, NoAreaNoNormal) {
    Points line(3, 3);
    line << 0, 0, 0, 1, 0, 0, 2, 0, 0;
    Triangles one(1, 3);
    one << 0, 1, 2;
    EXPECT_EQ(triangle_normals(line, one).norm(), 0);
    EXPECT_EQ(vertex_normals(line, one).norm(), 0);
    EXPECT_EQ(diagonal(Points(0, 3)), 0);
}

} // namespace
} // namespace meshtween
