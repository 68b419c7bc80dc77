// The last few triangles that look into the target, turned by moving one vertex at a time.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/tangles.h"

namespace meshtween {

struct Nudged {
    Points positions;
    Tangles left;
};

// Each vertex of a triangle turned over goes, on the target and by less than half of its shortest edge, where the
// fewest triangles around it look into the target, and of such places where the mesh around lies nearest to it. No
// triangle grows much thinner; what comes to be turned over or cut by it goes back. `before` are the tangles of the
// positions.
Nudged nudge(TangleSearch& search, const Points& positions, const Tangles& before);

} // namespace meshtween
