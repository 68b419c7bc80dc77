// In which order to ask for many points, so that each finds what it needs where the last one left it.
#pragma once

#include "meshtween/core/mesh.h"

#include <vector>

namespace meshtween::search {

// The points' numbers along a space-filling curve; empty where their own order is as good or there are few. Points that
// are not finite come anywhere. O(n).
std::vector<int> visiting_order(const Points& points);

} // namespace meshtween::search
