// The mesh's own vertices in a GLB that had to repeat some of them: where texture coordinates or normals jump, and
// where materials meet. Our GLBs tell the vertex in the attribute _VERTEX, and in a primitive's extras which triangles
// of the mesh it holds, so that reading gives back the mesh that was written.
#pragma once

#include "meshtween/io/gltf_scene.h"
#include "meshtween/io/polygons.h"

#include <vector>

namespace meshtween {

struct GltfNumbering {
    std::vector<int> vertices; // the mesh's vertex for each of the file's; empty where they are the same
    std::vector<int> polygons; // for each triangle of the file its place in the mesh; empty where they are in order
    int count = 0;             // the mesh's vertices
};

// Tells the numbering of a file whose vertices lie at `coordinates` and which has so many triangles; empty for a file
// that tells none, and for one whose repeated vertices have come apart since.
GltfNumbering gltf_numbering(const GltfData& data, const GltfLayout& layout, const std::vector<double>& coordinates,
                             std::size_t triangles);

// Takes the file's vertices as the mesh's. Normals and texture coordinates stay a corner each.
void apply_numbering(const GltfNumbering& numbering, PolygonMesh& mesh);

} // namespace meshtween
