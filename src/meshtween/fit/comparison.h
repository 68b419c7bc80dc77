// A fitted mesh beside its target: the searches that measuring a fit and mapping it both need, made once.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/io/seams.h"
#include "meshtween/search/closest_point.h"

#include <vector>

namespace meshtween {

struct Comparison {
    // Both must outlive it. `weld`: vertices that seams of a file split count once (weld.h). Throws Error(computation)
    // where one has no triangles.
    Comparison(const Mesh& fitted, const Mesh& target, bool weld = true);

    const Mesh &fitted, &target;
    bool weld;
    double diagonal; // the target's
    Weld fitted_seams, target_seams;
    ClosestPointIndex on_fitted, on_target;
    std::vector<ClosestPoint> vertices; // the fitted mesh's: the closest place of the target
};

} // namespace meshtween
