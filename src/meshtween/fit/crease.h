// Vertices beside a crease of the target, set onto it.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/tangles.h"

#include <vector>

namespace meshtween {

// A mesh whose vertices all lie on a surface still cuts its creases off wherever none of them lies on the crease. Where
// an edge of the mesh leads across a crease of the target, its nearer vertex moves onto the crease, by less than half
// of its mean edge, if the mesh around it comes nearer to the target by that, no triangle grows too thin, and nothing
// is turned over or cut that was not so `before`. n x 3; vertices beside no crease keep their bits.
// `places`, a triangle of the target that is probably near for each vertex, make it faster.
Points creased(TangleSearch& search, const Points& positions, const Tangles& before,
               const std::vector<int>& places = {});

} // namespace meshtween
