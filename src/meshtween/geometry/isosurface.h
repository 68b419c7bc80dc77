// The surface where a field is nought, as a closed mesh.
#pragma once

#include "meshtween/geometry/implicit.h"

namespace meshtween {

struct Box {
    Point low{0, 0, 0}, high{1, 1, 1};
};

// Marching tetrahedra on a lattice of cubes of this size: always closed, manifold and counter-clockwise from outside
// where the field is positive on the box's faces; parts thinner than a cube may be missed. Triangles may be slivers:
// meant as the start of remesh().
Mesh isosurface(const Field& field, const Box& box, double cell);

} // namespace meshtween
