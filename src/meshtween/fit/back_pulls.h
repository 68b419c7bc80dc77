// Pulls from the target's side: each place of the target draws the nearest place of the mesh.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/refine.h"
#include "meshtween/fit/sample_pulls.h"
#include "meshtween/fit/shell.h"

#include <vector>

namespace meshtween {

// The pulls of the target's vertices. Where it has at least four times as many as the mesh has triangles (and 1000),
// one of several neighbours pulls for all of them, in each round another. Each draws the closest compatible place of
// the mesh no further than `reach` (diagonals) straight towards itself. All of them together weigh 1 where the mesh is
// near and `weight` where it is an edge or more away, since flat triangles miss a round surface everywhere. How much of
// that a vertex bears is for the caller (bearable). What lies beyond an open mesh's border does not pull.
// memory.mesh is at the positions (bring_mesh).
std::vector<SamplePull> back_pulls(const Shell& shell, const Points& positions, const FitTarget& target, double weight,
                                   double reach, int round, RelaxMemory& memory);

} // namespace meshtween
