// Eq. 9: blending the direction and the length of Laplacian coordinates apart.
#pragma once

#include "meshtween/core/mesh.h"

namespace meshtween {

// The coordinates of the in-between shape at u, Eq. 9a-c, the blended direction not normalised again, as printed. A
// coordinate without length has no direction; it counts as nought. n x 3.
Points blended_coordinates(const Points& from, const Points& to, double u);
Points blended_coordinates(const Points& from, const Points& to, const Eigen::VectorXd& u); // a parameter a row

// The middle control point of that blend: Eq. 9 is quadratic in u, so that
// blended(u) = (1 - u)^2 from + 2 u (1 - u) middle + u^2 to with middle = (|from| to/|to| + |to| from/|from|) / 2.
Points middle_coordinates(const Points& from, const Points& to);

// The quadratic curve with these control points. n x 3.
Points quadratic(const Points& from, const Points& middle, const Points& to, double u);
Points quadratic(const Points& from, const Points& middle, const Points& to, const Eigen::VectorXd& u);

} // namespace meshtween
