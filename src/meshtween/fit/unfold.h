// A patch of a fitted mesh laid out anew on the target, so that none of its triangles is turned over.
#pragma once

#include "meshtween/fit/refine.h"
#include "meshtween/fit/shell.h"

#include <span>
#include <vector>

namespace meshtween {

// A part of the target that wants to be covered.
struct TargetSample {
    Point position{0, 0, 0}, normal{0, 0, 0};
    double area = 0; // in squared diagonals
};
std::vector<TargetSample> target_samples(const FitTarget& target); // its vertices and the middles of its triangles

struct FoldedPatch {
    std::vector<int> vertices;  // that may move, ascending; none is on the mesh's border
    std::vector<double> remote; // one each, 0 at the fault to 1 at the patch's rim: how firmly it stays where it is
    std::vector<int> samples;   // of the target, for which the patch answers
    bool any_sheet = true;      // at first every vertex takes the nearest surface, whichever way it looks there
    bool membrane = false;      // it is spanned over the rim first: one layer, drawn out again by what is uncovered
};

// Where the patch's vertices go, a row each; all others hold. Markers inside the patch are drawn to their targets.
Points unfolded(const Shell& shell, const Points& positions, const FoldedPatch& patch, const FitTarget& target,
                std::span<const TargetSample> samples, std::span<const Pin> pins);

} // namespace meshtween
