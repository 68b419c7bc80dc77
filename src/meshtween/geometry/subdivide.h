// A mesh with finer triangles on the same flat surface.
#pragma once

#include "meshtween/core/mesh.h"

namespace meshtween {

// Each triangle becomes four at its edges' midpoints, `times` over (0: the mesh itself). Vertices stay first and where
// they are; new ones follow, one an edge, sorted by the edge's vertices. Texture coordinates and colours go along.
Mesh subdivide(const Mesh& mesh, int times);

} // namespace meshtween
