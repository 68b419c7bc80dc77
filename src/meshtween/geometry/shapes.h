// Simple shapes and simple maps of space, for samples and tests: all closed, counter-clockwise seen from outside.
#pragma once

#include "meshtween/core/mesh.h"

#include <array>

namespace meshtween {

// The unit sphere: an icosahedron whose triangles are quartered `subdivisions` times, 10 * 4^subdivisions + 2 vertices.
Mesh sphere(int subdivisions);

// A box from (0, -size_y/2, -size_z/2) to (size_x, size_y/2, size_z/2), its faces cut into `cells` squares along x, y
// and z, edges and corners rounded with this radius (at most half the smallest size; 0 leaves them sharp).
Mesh bar(const Point& size, const std::array<int, 3>& cells, double rounding = 0);

// A torus around the y axis: the middle circle's radius, the tube's radius, vertices around the axis and the tube.
Mesh torus(double radius, double tube, int around, int across);

// Bends the x axis over 0..length into a circular arc of `angle` radians in the x-y plane, towards +y; its length is
// kept, and so are the sections across it. What lies beyond the ends goes on straight.
Points bend(const Points& points, double length, double angle);

// Turns each section across the x axis about it, by 0 at x = 0 to `angle` radians at x = length.
Points twist(const Points& points, double length, double angle);

// Turns about an axis through the origin (of any length but 0) by `angle` radians.
Points turn(const Points& points, const Point& axis, double angle);

} // namespace meshtween
