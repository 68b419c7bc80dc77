// The faces of a mesh without those that are none: marching cubes, merged scans and exporters leave triangles without
// area, the same triangle twice, and parts that have shrunk to a point.
#pragma once

#include "meshtween/core/mesh.h"

#include <vector>

namespace meshtween {

struct SoundFaces {
    Triangles triangles;     // all of the mesh's; vertices that edges of no length join are one: the first of them
    std::vector<int> kept;   // which of them are faces, ascending
    std::vector<int> vertex; // n: the vertex that stands for each
    long collapsed = 0;      // faces left out because two of their corners are in one place
    long doubled = 0;        // faces left out because another has the same corners
};

// Edges up to a billionth of the diagonal have no length. O(m log m).
SoundFaces sound_faces(const Points& positions, const Triangles& triangles);

// The connected parts of these triangles, by edges and vertices: a number for each, the first met is 0.
std::vector<int> parts_of(Eigen::Index vertices, const Triangles& triangles, const std::vector<int>& chosen);

} // namespace meshtween
