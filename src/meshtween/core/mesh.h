// The few types that every part shares: plain data, a row a point.
#pragma once

#include <Eigen/Core>

#include <memory>
#include <string>

namespace meshtween {

using Point = Eigen::RowVector3d;
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;   // n x 3, a row a point
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;   // m x 3, counter-clockwise from outside
using Texcoords = Eigen::Matrix<float, Eigen::Dynamic, 2, Eigen::RowMajor>; // k x 2, v upwards as in OBJ
using Colors = Eigen::Matrix<float, Eigen::Dynamic, 4, Eigen::RowMajor>;    // n x 4, RGBA in 0..1

struct MeshFile; // io/mesh_file.h

// A triangle mesh. Vertex order and count are those of the file it came from, always.
struct Mesh {
    Points positions;
    Triangles triangles;
    Texcoords texcoords;          // empty where the file has none
    Triangles texcoord_triangles; // m x 3 indices into texcoords, a corner each (seams need them); empty with texcoords
    Colors colors;                // a row a vertex; empty where the file has none
    // What the file holds besides: polygons, groups, materials, its own bytes. It describes the triangles and
    // attributes above, not the positions; who changes those drops it. Null where no file gave the mesh.
    std::shared_ptr<const MeshFile> file = {};
};

// A point on a mesh: a triangle and its barycentric coordinates (they add up to 1).
struct SurfacePoint {
    int triangle = -1;
    Eigen::RowVector3d barycentric{1, 0, 0};
};

// Where a surface point lies while the mesh has these positions. 1 x 3, in the mesh's unit.
inline Point position(const Points& positions, const Triangles& triangles, const SurfacePoint& p) {
    const auto corners = triangles.row(p.triangle);
    return p.barycentric[0] * positions.row(corners[0]) + p.barycentric[1] * positions.row(corners[1]) +
           p.barycentric[2] * positions.row(corners[2]);
}

// A pair of corresponding points: on the source's surface, and in space on or near the target's.
struct Marker {
    std::string name;
    SurfacePoint source;
    Point target{0, 0, 0};
};

} // namespace meshtween
