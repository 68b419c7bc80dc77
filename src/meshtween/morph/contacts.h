// Where a moving shape cuts itself: pairs of triangles of many frames, gathered into contacts of two sides.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/morph/patches.h"

#include <array>
#include <vector>

namespace meshtween {

using CutPairs = std::vector<std::array<int, 2>>; // triangles, smaller index first, ascending

struct Contact {
    std::vector<int> sides[2]; // triangles that are cut in some frame, ascending
    std::vector<int> cuts;     // how many pairs, a frame each
    int first_frame = 0, last_frame = 0, worst_frame = 0;
    bool at_an_end = false; // an end is cut there too
    bool fold = false;      // both sides are one region: a crease
};

// Pairs whose triangles lie in the same or neighbouring cells belong to one contact, in whatever frame they are. `ends`
// holds the pairs of both ends. Contacts that only the ends have are left out.
std::vector<Contact> contacts(const std::vector<CutPairs>& frames, const CutPairs& ends, const Patches& cells);

} // namespace meshtween
