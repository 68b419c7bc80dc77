// A minimum of a smooth function of many points, from where they are.
#pragma once

#include "meshtween/core/mesh.h"

#include <functional>

namespace meshtween {

struct LbfgsOptions {
    int iterations = 40;
    std::size_t memory = 6;  // of steps, from which the curvature is guessed
    double first_step = 0.1; // of the point that moves furthest, same unit as the points
    double longest_step = 1; // likewise
    double tolerance = 1e-5; // stop where a step gains less than this part of the value
};

// `value` returns the function at x and writes its gradient there, n x 3. Values never rise from step to step.
Points lbfgs(Points x, const std::function<double(const Points& x, Points& gradient)>& value,
             const LbfgsOptions& options = {});

} // namespace meshtween
