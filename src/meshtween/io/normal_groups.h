// Where a surface is smooth and where it has an edge, as the normals of its file say.
#pragma once

#include "meshtween/core/mesh.h"

#include <vector>

namespace meshtween {

// The corners of triangles that share a normal have one number.
struct NormalGroups {
    Triangles of;              // m x 3
    std::vector<int> vertices; // a group: one of its vertices
};

// Corners in one place whose normals in the file are the same share one, also across vertices that only a jump of the
// texture coordinates separates. Where the file has no normals each vertex of the
// surface has one, smooth across seams.
NormalGroups normal_groups(const Mesh& mesh);

// As above for corners at `vertices` (m x 3) with these normals, a row a corner of the triangles each; a row of zeros:
// the file says nothing there, and the corner goes with its vertex alone.
NormalGroups normal_groups(const Points& positions, const Triangles& vertices, const Points& corner_normals);

// A unit normal a group while its vertices lie at `positions`; (0, 1, 0) where its triangles have no area.
Points group_normals(const Points& positions, const NormalGroups& groups);

} // namespace meshtween
