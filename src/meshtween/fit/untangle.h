// A fitted mesh whose triangles are turned over or cut each other, mended patch by patch.
#pragma once

#include "meshtween/core/progress.h"
#include "meshtween/fit/refine.h"
#include "meshtween/fit/shell.h"
#include "meshtween/fit/tangles.h"

#include <span>
#include <vector>

namespace meshtween {

// Vertices near new cuts go towards the mean of their neighbours until none, or fewest, of the cuts are left: what is
// interpolated from a coarser level may be folded in small places, and a clean start can be kept clean.
Points eased(TangleSearch& search, const Points& positions);

// `now`, but near new cuts the vertices stay where they were `before`, fading out over a few rings: what would fold
// waits until the rest has moved on. Looked for where the mesh is folded by more than a right angle; what was cut
// already is not waited for.
Points held_back(TangleSearch& search, const Points& before, const Points& now);

struct Untangled {
    Points positions;
    Tangles left;
    int patches = 0;        // that were laid out anew and are better for it
    bool cancelled = false; // the progress said so: the positions are the best so far
};

// Each connected patch of `faults` (all that tangles() finds) and the rings around it are laid out anew (unfolded) with
// all else held; where that leaves fewer faults it is kept. What is left, if it is little, is nudged, then a wider
// patch is tried. What is left after that starts as a membrane over the patch's rim. A mesh without faults comes
// back as it was.
Untangled untangle(TangleSearch& search, const Points& positions, const Tangles& faults, std::span<const Pin> pins,
                   const Progress& progress = {});

} // namespace meshtween
