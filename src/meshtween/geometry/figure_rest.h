// The figure at rest: arms half raised to the sides, legs a little apart, so that no two parts touch that do not belong
// together. Metres; y up, facing +z, its left at +x; soles at y = 0. Shared by the figure's own files.
#pragma once

#include "meshtween/geometry/implicit.h"

#include <numbers>

namespace meshtween::figure_rest {

// Joints of the left side; those of the right are mirrored in x.
inline const Point shoulder(0.168, 1.405, -0.018);
inline const Point arm_axis(std::numbers::sqrt2 / 2, -std::numbers::sqrt2 / 2, 0);
inline constexpr double elbow = 0.29, wrist = 0.55, knuckles = 0.64; // along the arm's axis
inline const Point hip(0.090, 0.91, 0.0);
inline const Point ankle(0.122, 0.075, -0.022);
inline constexpr double knee = 0.43; // along the line from hip to ankle

// A point of the left arm: along its axis, towards the palm, and to the front.
inline Point on_arm(double along, double palm, double front) {
    const Point inwards(-arm_axis[0], arm_axis[1], 0);
    return shoulder + along * arm_axis + palm * inwards + Point(0, 0, front);
}

Sculpture body();

} // namespace meshtween::figure_rest
