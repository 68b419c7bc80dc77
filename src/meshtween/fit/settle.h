// The last steps of a fit: every vertex onto the surface, and no triangle turned over on the way.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/refine.h"
#include "meshtween/fit/shell.h"

#include <span>
#include <vector>

namespace meshtween {

struct SettleOptions {
    double reach = 0.01;       // of the target's diagonal: vertices further from the surface stay where they are
    double least_cosine = 0.5; // between a vertex's normal and the surface's
    int mending_rounds = 10;   // of relaxing around triangles that look into the surface
};

struct Settled {
    Points positions;
    std::vector<int> refused; // vertices that went only a part of the way, or none of it, ascending
    std::vector<int> mended;  // triangles that looked into the surface and no longer do, ascending
    std::vector<int> flipped; // triangles that still look into the surface, ascending
    std::vector<int> places;  // n: the target's triangle on which each vertex was last looked for, or -1
};

// Each vertex to its closest compatible point, one that a pin names to the closest whichever way it looks, or a half, a
// quarter, ... or none of the way there where a triangle would come to look away from the surface that it looked along
// before. Then triangles that look into the surface are relaxed with their surroundings and set down again. What lies
// `beyond` the target's border (without_counterpart) stays where it is.
Settled settle(const Shell& shell, const Points& positions, const FitTarget& target, std::span<const Pin> pins = {},
               const std::vector<char>& beyond = {}, const SettleOptions& options = {});

// Triangles whose normal opposes the target's at the point closest to their centre, ascending. `places`, one a vertex
// or none, are triangles of the target that are probably near.
std::vector<int> flipped_triangles(const Points& positions, const Triangles& triangles, const FitTarget& target,
                                   const std::vector<int>& places = {});

} // namespace meshtween
