// A smooth warp of space that takes one set of points to another (the paper's Eq. 1-5).
#pragma once

#include "meshtween/core/mesh.h"

#include <string>
#include <vector>

namespace meshtween {

enum class Kernel {
    thin_plate, // r^2 log r, Eq. 2
    linear,     // r, the biharmonic kernel of three-dimensional space
};

struct RbfOptions {
    Kernel kernel = Kernel::thin_plate;
    double smoothing = 0; // added to the diagonal of Eq. 5, in normalised coordinates; 0 meets the points exactly
};

// f(x) = x + sum_j lambda_j phi(x - c_j) + P(x), kept in coordinates where the points lie in a box of unit diagonal.
struct RbfWarp {
    Kernel kernel = Kernel::thin_plate;
    Points centres;                                                               // c_j, N x 3, normalised
    Points lambda;                                                                // N x 3
    Eigen::Matrix<double, 4, 3> polynomial = Eigen::Matrix<double, 4, 3>::Zero(); // P: rows 1, x, y, z
    Point origin{0, 0, 0};
    double scale = 1; // normalised = (x - origin) * scale

    // n x 3 to n x 3, in parallel and vectorised.
    Points operator()(const Points& points) const;
};

// Solves Eq. 5 for `from` -> `to`, both N x 3 with 4 <= N <= 5000 or so (O(N^3)); with 3 points or points on a plane
// the polynomial part is the best rigid motion with scale. Throws Error(computation) naming coincident points that go
// to different places, or points all on a line; `names`, if given, are used in messages.
RbfWarp warp(const Points& from, const Points& to, const RbfOptions& options = {},
             const std::vector<std::string>& names = {});

} // namespace meshtween
