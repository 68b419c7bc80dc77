// Moves of parts of a mesh that may not cut more than before.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/tangles.h"

#include <array>
#include <vector>

namespace meshtween {

using CutPairs = std::vector<std::array<int, 2>>; // of triangles, ascending

struct Cuts {
    CutPairs all;
    CutPairs fresh; // without those of the shapes themselves (tangles.h)
};
Cuts cuts_of(TangleSearch& search, const Points& positions);

// Vertices in `parts` have moved `from` somewhere `to` others. No part cuts more than it did `before` (the cuts of
// `from`), be it all that cuts or what the shapes do not cut themselves: where one would, the corners of what cuts anew
// go back. Returns the cuts of what is left of the moves; asks only around what has moved.
Cuts take_back_cuts(TangleSearch& search, const std::vector<std::vector<int>>& parts, const Points& from,
                    const Cuts& before, Points& to);

} // namespace meshtween
