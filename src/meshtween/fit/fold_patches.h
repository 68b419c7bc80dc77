// The parts of a fitted mesh around its faults.
#pragma once

#include "meshtween/fit/tangles.h"
#include "meshtween/fit/unfold.h"

#include <vector>

namespace meshtween {

struct FoldedPatches {
    std::vector<FoldedPatch> list;
    std::vector<int> of; // a vertex: its patch or -1
    int of_triangle(const Triangles& triangles, int t) const;
};

// What lies within `rings` of a fault, in connected parts, without what nothing tells where to lay it.
FoldedPatches patches_around(const TangleSearch& search, const Tangles& faults, int rings);

// Without the patches that are not kept, a flag each.
void keep_patches(FoldedPatches& patches, const std::vector<char>& kept);

// What a patch alone surrounds becomes a part of it: of all that lies beside the patch the largest is its outside, what
// lies elsewhere is inside, such as the tip of a tail whose root is at fault. Not where the mesh or the target ends.
void fill_holes(const TangleSearch& search, FoldedPatches& patches);

// How many of the faults are in each patch.
std::vector<long> faults_of(const FoldedPatches& patches, const Triangles& triangles, const Tangles& faults);

} // namespace meshtween
