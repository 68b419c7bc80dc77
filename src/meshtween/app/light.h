// A studio's light on a shape: a bright dome, a soft key light, a rim, and the shadows that the shape casts.
#pragma once

#include "meshtween/core/mesh.h"

#include <vector>

namespace meshtween {

// The view's axes, as rows: to the right, upwards, and towards the eye.
using ViewAxes = Eigen::Matrix3d;
ViewAxes view_axes(double azimuth_degrees, double elevation_degrees);

// A place that is lit.
struct SurfaceSpot {
    Eigen::Vector3d position, normal;
};

struct Lit {
    Eigen::Vector3f dome{0, 0, 0}, softbox{0, 0, 0}; // what a white surface sends back of them, together about 1
    float key = 0;                                   // how much of the softbox is seen, 0..1
};

// The light at each place while the mesh casts shadows. The lights stand with the viewer: the key at the upper left.
std::vector<Lit> light(const std::vector<SurfaceSpot>& places, const Points& positions, const Triangles& triangles,
                       const ViewAxes& view);

// What a viewer sees of a place of this colour (linear RGB) from the direction towards the eye.
Eigen::Vector3f shade(const SurfaceSpot& place, const Lit& lit, const Eigen::Vector3f& albedo,
                      const Eigen::Vector3d& to_eye, const ViewAxes& view);

// m x 9: the unit normals of each triangle's corners, smooth but for edges sharper than this angle.
using CornerNormals = Eigen::Matrix<float, Eigen::Dynamic, 9, Eigen::RowMajor>;
CornerNormals corner_normals(const Points& positions, const Triangles& triangles, double sharp_degrees = 50);

} // namespace meshtween
