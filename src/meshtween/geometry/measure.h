// Areas, normals, volume and extent of a mesh: the measures that need nothing but positions and triangles.
#pragma once

#include "meshtween/core/mesh.h"

#include <Eigen/Geometry>

namespace meshtween {

// The box around the vertices of faces: a vertex of no face may lie anywhere and says nothing of the shape. Around all
// points where there is no face.
Eigen::AlignedBox3d bounding_box(const Points& positions, const Triangles& triangles);

// The length of that box's diagonal, the length to which all relative lengths refer. 0 for no points.
double diagonal(const Points& positions, const Triangles& triangles);
double diagonal(const Points& positions); // of the box around all
inline double diagonal(const Mesh& mesh) {
    return diagonal(mesh.positions, mesh.triangles);
}

// Twice the area times the outward normal of triangle t. 1 x 3, unit squared.
inline Point double_area_normal(const Points& positions, const Triangles& triangles, Eigen::Index t) {
    const Point a = positions.row(triangles(t, 0)), b = positions.row(triangles(t, 1)),
                c = positions.row(triangles(t, 2));
    return (b - a).cross(c - a);
}

double triangle_area(const Points& positions, const Triangles& triangles, Eigen::Index t);
double surface_area(const Points& positions, const Triangles& triangles);

// The enclosed volume, positive where triangles turn counter-clockwise seen from outside; for an open mesh the volume
// of the cone over its first vertex.
double volume(const Points& positions, const Triangles& triangles);

// m x 3 unit normals; a zero row for a triangle without area.
Points triangle_normals(const Points& positions, const Triangles& triangles);

// n x 3 unit normals, the faces around a vertex weighted by their angle there (Thuermer and Wuethrich 1998), which
// does not depend on how the surface is cut into triangles. A zero row for a vertex of no face.
Points vertex_normals(const Points& positions, const Triangles& triangles);

} // namespace meshtween
