// Whether a triangle looks along the surface under it, and if not, how much is wanting.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/refine.h"

#include <vector>

namespace meshtween {

struct Facing {
    double squared_distance = 0; // from the triangle's centre to the target
    double cosine = 1;           // between the triangle's normal and the target's there
    double detour = 0;           // how much further it is to the nearest place that looks the same way
    int place = -1;              // the target's triangle there
    bool into() const { return cosine < 0; }
};

// On an edge or a corner of the target, more than one of its triangles is closest, and which of them answers hangs on a
// rounding: the least cosine of all counts. `hint` is a triangle of the target that is probably near, or -1.
Facing facing(const Point& centre, const Point& area_normal, const FitTarget& target, int hint = -1);

// Triangles of the mesh that look into the target by this measure, ascending: those of flipped_triangles, and those
// that are closest to an edge of the target and agree with one side of it alone.
std::vector<int> facing_into(const Points& positions, const Triangles& triangles, const FitTarget& target);

// The same after some triangles, a flag each, have moved; `before` are those before.
std::vector<int> facing_into(const Points& positions, const std::vector<int>& before, const std::vector<char>& moved,
                             const Triangles& triangles, const FitTarget& target);

} // namespace meshtween
