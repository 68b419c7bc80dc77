// How many handles a surface has: none like a ball, one like a ring.
#pragma once

#include "meshtween/core/mesh.h"

#include <optional>

namespace meshtween {

// Of all parts together, holes counted as closed, by Euler's formula: parts with n vertices, e edges, m triangles and b
// boundaries have (2 parts - b - (n - e + m)) / 2. None where an edge has three triangles or more, or triangles meet in
// a vertex alone, or sides cannot be told apart.
std::optional<long> handles(const Points& positions, const Triangles& triangles);

} // namespace meshtween
