// Pulls at points within a mesh's triangles.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/shell.h"
#include "meshtween/solve/block_system.h"

#include <vector>

namespace meshtween {

// Draws a point of the mesh by `way`, as far as that lies along `direction` (unit).
struct SamplePull {
    SurfacePoint where; // triangle -1: no pull
    Point way{0, 0, 0}, direction{0, 0, 0};
    double strength = 0; // beside closeness, whose strengths over the whole surface add up to 1
};

// The share of each vertex's pulls that counts, so that none is drawn harder than `most` (n): much that is uncovered
// must not tear at the few that are near.
std::vector<double> bearable(const std::vector<SamplePull>& pulls, const Triangles& triangles,
                             const std::vector<double>& area, double most);

// Adds pulls to a system (blocks, n x 3 right side). Those whose way is shorter than `near` sizes of their triangle act
// on the points themselves, by the least share (n) of their corners: triangles may turn under them. The others act on
// the corners as if all three moved alike, each by its own share: stiffer, so that far goals tear at nothing. Once a
// system, which couples neighbours of the shell then if `near` is not 0.
void add_pulls(const std::vector<SamplePull>& pulls, const std::vector<double>& shares, double near, const Shell& shell,
               const Points& positions, BlockSystem& system, Points& right);

} // namespace meshtween
