// What a mesh's file holds, for the mesh with finer triangles.
#pragma once

#include "meshtween/geometry/topology.h"
#include "meshtween/io/mesh_file.h"

#include <memory>

namespace meshtween {

// The triangle from which each of subdivide()'s was cut: as many of triangle t as it has flagged edges, and one.
std::vector<int> uncut_triangles(const Triangles& triangles, const Topology& topology, const std::vector<char>& cut);

// Objects, groups, smoothing groups and materials, given to the pieces of the polygons that had them; `uncut` is the
// source's triangle of each of `finer`'s. Polygons of which nothing was cut stay, the others become triangles. Null
// where the source's file does not describe it.
std::shared_ptr<const MeshFile> refined_file(const Mesh& source, const Mesh& finer, const std::vector<int>& uncut);

} // namespace meshtween
