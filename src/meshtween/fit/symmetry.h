// Planes in which a shape is its own mirror image, or nearly and for the most part.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/search/closest_point.h"

#include <vector>

namespace meshtween {

// The points x with normal . x = offset; the normal is unit.
struct MirrorPlane {
    Point normal{1, 0, 0};
    double offset = 0;

    double height(const Point& p) const { return normal.dot(p) - offset; }
    Point image(const Point& p) const { return p - 2 * height(p) * normal; }
    Point image_of_direction(const Point& d) const { return d - 2 * normal.dot(d) * normal; }
};

struct Symmetry {
    MirrorPlane plane;
    Points places;               // samples, evenly over the surface
    std::vector<double> misfits; // of each: from its image to the surface there, 0.1 where none looks the same way
    double share = 0;            // of the samples whose misfit is under 0.01
};

// A surface's planes of symmetry, the best first, three at most: those that hold for half of it or more, and that no
// turn leaves as they are; a sphere, which has every plane, has none. `index` is of the same mesh. Lengths are parts of
// the diagonal: the caller scales.
std::vector<Symmetry> symmetries(const Points& positions, const Triangles& triangles, const ClosestPointIndex& index);

// How far the surface near a place (within 0.03) lies from its mirror image: the root of the mean square.
double asymmetry(const Symmetry& symmetry, const Point& place);

} // namespace meshtween
