// A curve for players: meshes in float, a frame at the speed of memory.
#pragma once

#include "meshtween/morph/curve.h"

#include <span>

namespace meshtween {

using FloatPoints = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>; // n x 3, a row a point

struct FloatCurve {
    SplineBasis basis;
    std::vector<FloatPoints> nodes; // K control meshes
};

FloatCurve to_float(const Curve& curve);

// The shape at u: a weighted sum of the nodes. Reads degree + 1 meshes and writes one.
FloatPoints frame(const FloatCurve& curve, double u);

// The same into memory of the caller's, 3 n floats, for players that show many frames. Throws Error(argument) for
// another size.
void frame_into(const FloatCurve& curve, double u, std::span<float> result);

} // namespace meshtween
