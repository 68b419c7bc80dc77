// The floor or table under what was scanned.
#pragma once

#include "meshtween/core/mesh.h"

#include <vector>

namespace meshtween {

// A flag a triangle: those of a plane on which everything else stands and that reaches out from under it. Which way is
// up does not matter. Flat bottoms of a bust reach no further than the bust, and are none. None at all where there is
// no such plane.
std::vector<char> ground_faces(const Points& positions, const Triangles& triangles);

} // namespace meshtween
