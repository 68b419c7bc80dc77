// Pairs of faces that cut each other.
#pragma once

#include "meshtween/core/mesh.h"

#include <array>
#include <vector>

namespace meshtween {

// Pairs of triangles (smaller index first, ascending) that meet in more than their shared vertices or edge, decided
// with exact predicates. Degenerate triangles are left out. Faces that share an edge count where they are folded flat
// onto each other; faces that share a vertex count where an opposite edge of one meets the other.
// What comes as near to a triangle's plane as `gap` lies in it: triangles that almost touch count too.
std::vector<std::array<int, 2>> self_intersections(const Points& positions, const Triangles& triangles, double gap = 0);

// Those of them with a chosen triangle (a flag each): the sooner, the fewer are chosen.
std::vector<std::array<int, 2>> self_intersections(const Points& positions, const Triangles& triangles,
                                                   const std::vector<char>& chosen, double gap = 0);

} // namespace meshtween
