// A mesh with finer triangles on the same flat surface.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/geometry/topology.h"

#include <vector>

namespace meshtween {

// Each triangle becomes four at its edges' midpoints, `times` over (0: the mesh itself). Vertices stay first and where
// they are; new ones follow, one an edge, sorted by the edge's vertices. Texture coordinates and colours go along.
Mesh subdivide(const Mesh& mesh, int times);

// Only the flagged edges are cut at their midpoints (`cut`: a flag an edge of the mesh's topology); triangles become
// two, three or four, so that the mesh stays whole. Vertices as above.
Mesh subdivide(const Mesh& mesh, const Topology& topology, const std::vector<char>& cut);

// The same of a mesh whose numbering seams cut, where `whole` is it welded and topology and flags are of that: both are
// cut alike, triangle by triangle. New vertices on a seam lie in one place, one for each of the file's edges.
Mesh subdivide(const Mesh& mesh, const Mesh& whole, const Topology& topology, const std::vector<char>& cut);

} // namespace meshtween
