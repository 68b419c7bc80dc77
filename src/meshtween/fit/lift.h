// Vertices lifted a little off the surface, so that the triangles between them lie on it in the mean.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/refine.h"
#include "meshtween/geometry/topology.h"

namespace meshtween {

// A triangle whose corners lie on a curved surface lies beside it everywhere else. Each vertex moves along its normal
// so that the squared distance of the whole mesh from the target is least; where the target lies further off than
// triangles of that size can miss a surface, and where it looks another way, nothing is asked of it. No vertex moves
// further than a tenth of its shortest edge, none that would turn a triangle over. n x 3.
Points lifted(const Points& positions, const Triangles& triangles, const Topology& topology, const FitTarget& target);
Points lifted(const Mesh& fitted, const Mesh& target); // in any unit

} // namespace meshtween
