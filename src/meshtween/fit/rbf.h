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
    double smoothing = 0; // at least 0; stiffens the diagonal of Eq. 5, in normalised coordinates; 0 meets the points
};

// f(x) = x + sum_j lambda_j phi(x - c_j) + P(x), kept in coordinates where the points' centre is the
// origin and their RMS distance from it 1/2.
struct RbfWarp {
    Kernel kernel = Kernel::thin_plate;
    Points centres;                                                               // c_j, N x 3, normalised
    Points lambda;                                                                // N x 3
    Eigen::Matrix<double, 4, 3> polynomial = Eigen::Matrix<double, 4, 3>::Zero(); // P: rows 1, x, y, z
    Point origin{0, 0, 0};
    double scale = 1; // normalised = (x - origin) * scale

    // n x 3 to n x 3, in parallel and vectorised. The warp of a point does not depend on the other points, to the bit.
    Points operator()(const Points& points) const;
};

// Solves Eq. 5 for `from` -> `to`, both N x 3 with 3 <= N <= 5000 or so (O(N^3) time, O(N^2) memory). Affine maps are
// met everywhere; where the points lie on a plane (3 points always do), the plane goes as they say and its normal
// direction as the best rigid motion with scale does. Points that coincide and go to one place count once. Throws
// Error(argument) for points that do not pair up or are not finite, Error(computation) for fewer than 3 points, points
// all on a line, or points that (nearly) coincide but go to different places; `names`, if given, are used in messages.
RbfWarp warp(const Points& from, const Points& to, const RbfOptions& options = {},
             const std::vector<std::string>& names = {});

} // namespace meshtween
