// A region of the source that nothing draws: it goes along with the rest, to which it is attached.
#pragma once

#include "meshtween/geometry/portion.h"

#include <vector>

namespace meshtween {

// `guess`: where each of the region's vertices would go by what lies around; `held`: a flag a vertex, those that the
// region shares with the fitted part. What the guess lacks there is spread over the region, as smooth as can be
// (harmonic with cotangent weights: Pinkall and Polthier 1993).
Points attached(const Portion& region, const Points& guess, const std::vector<char>& held, const Points& places);

} // namespace meshtween
