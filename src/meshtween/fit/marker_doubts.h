// What is wrong with pairs of markers, told by the markers alone.
#pragma once

#include "meshtween/core/mesh.h"

#include <string>
#include <vector>

namespace meshtween {

// Sentences for people: the pairs fit a mirror image far better than what they are; two pairs fit far better with their
// targets exchanged; a pair lies far from where the others say (by a thin-plate warp through them), the worst first.
// None for fewer than 8 pairs; of more than 120 the mirror image alone.
std::vector<std::string> marker_doubts(const Points& source, const Points& target,
                                       const std::vector<std::string>& names);

} // namespace meshtween
