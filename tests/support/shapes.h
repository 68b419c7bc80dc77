// Small meshes with known properties.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/geometry/shapes.h"

#include <cmath>

namespace meshtween {

// The cube 0..1 with eight vertices, outward.
inline Mesh unit_cube() {
    Mesh mesh;
    mesh.positions.resize(8, 3);
    for (int i = 0; i < 8; ++i) mesh.positions.row(i) << (i & 1), (i >> 1 & 1), (i >> 2 & 1);
    mesh.triangles.resize(12, 3);
    mesh.triangles << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5,
        3, 7, 5;
    return mesh;
}

// rows x columns vertices of a wavy open sheet, facing +z.
inline Mesh wavy_sheet(int rows, int columns) {
    Mesh mesh;
    mesh.positions.resize(rows * columns, 3);
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j)
            mesh.positions.row(i * columns + j) << j / 7.0, i / 3.0, std::sin(0.7 * i) * std::cos(1.1 * j);
    mesh.triangles.resize(2 * (rows - 1) * (columns - 1), 3);
    Eigen::Index t = 0;
    for (int i = 0; i + 1 < rows; ++i)
        for (int j = 0; j + 1 < columns; ++j) {
            const int a = i * columns + j;
            mesh.triangles.row(t++) << a, a + 1, a + columns;
            mesh.triangles.row(t++) << a + 1, a + columns + 1, a + columns;
        }
    return mesh;
}

// A ball of radius 1 with two legs, 1.5 long, below it at x = -0.5 and 0.5.
inline Mesh two_legs() {
    Mesh mesh = sphere(5);
    for (auto p : mesh.positions.rowwise()) {
        const double away = std::hypot(std::abs(p[0]) - 0.5, p[1]);
        if (p[2] < 0) p[2] -= 1.5 * std::exp(-std::pow(away / 0.3, 4));
    }
    return mesh;
}

// The part of a mesh whose vertices all satisfy `keep`; vertices stay.
template <typename Keep>
Mesh part_of_mesh(const Mesh& mesh, const Keep& keep) {
    Mesh result = mesh;
    Eigen::Index count = 0;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
        bool all = true;
        for (int k = 0; k < 3; ++k) all = all && keep(mesh.positions.row(mesh.triangles(t, k)));
        if (all) result.triangles.row(count++) = mesh.triangles.row(t);
    }
    result.triangles.conservativeResize(count, 3);
    return result;
}

} // namespace meshtween
