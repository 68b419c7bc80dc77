// Normals of a mesh's file for another shape of the mesh.
#pragma once

#include "meshtween/core/mesh.h"

namespace meshtween {

// Beside MeshFile::normals, unit length. Each is the sum of the triangles' normals at the corners that use it, weighted
// by their angles there. What is one normal in the file stays one, and normals that are alike at one place stay alike:
// the surface is smooth and has edges where the file has them. A normal that no triangle with an area uses stays as it
// was. The mesh's file describes it (is_described).
Points file_normals(const Mesh& mesh);

} // namespace meshtween
