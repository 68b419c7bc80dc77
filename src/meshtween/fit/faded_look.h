// A mesh between two looks.
#pragma once

#include "meshtween/core/mesh.h"

namespace meshtween {

// Whether the mesh's materials show something besides vertex colours: a picture, or a colour that is not white.
bool shows_materials(const Mesh& mesh);

// The vertex colours of a mesh, linear RGB; plain where it has none.
Colors linear_colors(const Mesh& mesh);

// As many vertex colours (sRGB) as a surface has that has none of its own.
Colors plain_colors(Eigen::Index count);

// The mesh with vertex colours between its own and those of `other`, the same triangles, mixed in linear light: u = 0
// is its own. A picture cannot be mixed in: where one of the two shows materials, it is the nearer of the two.
Mesh faded_look(const Mesh& mesh, const Mesh& other, double u);

} // namespace meshtween
