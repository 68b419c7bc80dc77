// Large turns of a part of a shape by the marker warp (the paper's Fig. 17 and 18).
#pragma once

#include "meshtween/fit/rbf.h"

namespace meshtween {

struct RotateOptions {
    double max_step = 30; // degrees at most for one warp; a larger angle is divided evenly
    RbfOptions warp;
};

// Turns the points `turning` by `angle` degrees, counter-clockwise seen against `axis`, about the line through
// `centre`, holds the points `holding`, and takes `positions` (n x 3) along: the displacements of Eq. 3 are rotational,
// a warp for each step. Throws Error(argument) for an axis without length, angles that are not finite and a step that
// is not positive; Error(computation) where the points do not determine a warp.
Points rotate(const Points& positions, const Points& turning, const Points& holding, const Point& axis,
              const Point& centre, double angle, const RotateOptions& options = {});

} // namespace meshtween
