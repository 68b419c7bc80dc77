// A mesh as glTF wants it: one texture coordinate and one normal a vertex, and a part for each material.
#pragma once

#include "meshtween/io/normal_groups.h"

#include <utility>
#include <vector>

namespace meshtween {

// Texture coordinates a corner of the mesh's triangles.
struct CornerTexcoords {
    Texcoords texcoords;
    Triangles corners; // m x 3: a row of texcoords, or -1
};

// All sets of a mesh: its own first.
std::vector<CornerTexcoords> corner_texcoords(const Mesh& mesh);

// Triangles of one material, with vertices of their own.
struct GltfPrimitive {
    int material = -1;
    std::vector<int> vertices; // the mesh's vertex for each of its own
    std::vector<int> corners;  // 3 t + c, a corner of the mesh that has the vertex's attributes; -1: no triangle has it
    Triangles triangles;
    std::vector<std::pair<int, int>> runs; // of the mesh's triangles: the first, and how many
};

struct GltfParts {
    std::vector<GltfPrimitive> primitives; // ascending materials; -1 first
    bool renumbered = false;               // vertices are repeated, or in another order than the mesh's
};

// Where all has one material, vertex i is vertex i of the mesh and repeated ones follow all others. `materials`: one a
// triangle, or none.
GltfParts split_parts(const Mesh& mesh, const std::vector<CornerTexcoords>& texcoords, const NormalGroups& groups,
                      const std::vector<int>& materials);

} // namespace meshtween
