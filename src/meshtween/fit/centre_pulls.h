// Pulls of the triangles' centres.
#pragma once

#include "meshtween/fit/refine.h"
#include "meshtween/fit/sample_pulls.h"

#include <vector>

namespace meshtween {

// The centre of each triangle is drawn to the plane of the target's triangle that is closest to it among those no
// further than `reach` that look its way. Their strengths add up to at most `weight`.
void add_centre_pulls(const Shell& shell, const Points& positions, const FitTarget& target, double weight,
                      double least_cosine, double reach, RelaxMemory& memory, std::vector<SamplePull>& pulls);

} // namespace meshtween
