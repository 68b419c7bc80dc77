// Pulls at points within a mesh's triangles.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/solve/block_system.h"

#include <vector>

namespace meshtween {

// Draws a point of the mesh by `way`, as far as that lies along `direction` (unit).
struct SamplePull {
    SurfacePoint where;
    Point way{0, 0, 0}, direction{0, 0, 0};
    double strength = 0; // beside closeness, whose strengths over the whole surface add up to 1
};

// The share of each vertex's pulls that counts, so that none is drawn harder than `most` (n): much that is uncovered
// must not tear at the few that are near.
std::vector<double> bearable(const std::vector<SamplePull>& pulls, const Triangles& triangles,
                             const std::vector<double>& area, double most);

// Adds to a system (blocks, n x 3 right side) pulls on the triangles' corners as if all three moved alike, each by its
// share (n): stiffer than the points themselves are, so that far goals tear at nothing.
void add_lumped(const std::vector<SamplePull>& pulls, const std::vector<double>& shares, const Points& positions,
                const Triangles& triangles, BlockSystem& system, Points& right);

// Adds pulls on the points themselves, each by the least share of its corners: triangles may turn under them. Once a
// system.
void add_together(const std::vector<SamplePull>& pulls, const std::vector<double>& shares, const Points& positions,
                  const Triangles& triangles, BlockSystem& system, Points& right);

} // namespace meshtween
