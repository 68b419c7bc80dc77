// Named places on a body, told by rays from inside it.
#pragma once

#include "meshtween/geometry/implicit.h"

#include <string>
#include <vector>

namespace meshtween {

struct Landmarks {
    std::vector<std::string> names;
    Points points;
};

// Where a ray leaves the body; a pair is two places, `_L` at +x and `_R` at -x.
struct LandmarkSpot {
    std::string name;
    Point inside, direction;
    bool pair = false;
};

// Rays are followed up to `reach`. The body must be its own mirror image in x = 0 where places are pairs.
Landmarks landmarks(const Field& body, const std::vector<LandmarkSpot>& places, double reach);

} // namespace meshtween
