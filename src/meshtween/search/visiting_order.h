// In which order to ask for many points, so that each finds what it needs where the last one left it.
#pragma once

#include "meshtween/core/mesh.h"

#include <vector>

namespace meshtween::search {

// The points' numbers along a space-filling curve through cells of a thousandth of their extent; in a cell by their
// coordinates. Their own order tells only what lies in one place. Points that are not finite come anywhere. O(n) but
// for cells with many points.
std::vector<int> curve_order(const Points& points);

// The same; empty where the points' own order is as good or there are few.
std::vector<int> visiting_order(const Points& points);

} // namespace meshtween::search
