// The last triangles that look into the target or cut another, mended by small moves of the vertices around them.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/core/progress.h"
#include "meshtween/fit/refine.h"
#include "meshtween/fit/tangles.h"

#include <span>

namespace meshtween {

constexpr std::size_t few_faults = 300;   // of more, only what looks into the target is nudged
constexpr std::size_t many_faults = 2000; // of more, the shapes are unlike, and most of them stay

struct Nudged {
    Points positions;
    Tangles left;
    bool cancelled = false; // the progress said so: the positions are the best so far
};

// Around the triangles that look into the target (facing_into) or cut another (before.cuts), the corners and their
// neighbours go, one after another, by less than an edge, to where the least is wanting around them: the detours to
// places that look the same way, the lengths of cuts, and the distances. They stay on the target, or, with `leave`,
// within a fifth of an edge. Rounds go on while fewer faults are left. No triangle grows much thinner, no pin comes to
// lie further off, and no part of the mesh cuts more than it did. `before` are the tangles of the positions; `places`,
// a triangle of the target that is probably near for each vertex, make it faster. Nothing moves where more than one
// triangle in twenty is at fault, and thousands are: that would take minutes and mend next to nothing.
Nudged nudge(TangleSearch& search, const Points& positions, const Tangles& before, std::span<const Pin> pins,
             bool leave = false, const std::vector<int>& places = {}, const Progress& progress = {});

} // namespace meshtween
