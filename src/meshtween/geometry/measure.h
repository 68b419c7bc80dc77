// Areas, normals, volume and extent of a mesh: the measures that need nothing but positions and triangles.
#pragma once

#include "meshtween/core/mesh.h"

#include <Eigen/Geometry>

namespace meshtween {

// The length of the bounding box's diagonal, the length to which all relative lengths refer. 0 for no points.
double diagonal(const Points& positions);

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
