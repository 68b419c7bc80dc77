// A morph whose every shape is known: a bar twisted about its length.
#pragma once

#include "meshtween/geometry/shapes.h"
#include "meshtween/morph/curve.h"

#include <numbers>

namespace meshtween {

inline Mesh straight_bar(int fineness = 1) {
    return bar(Point(3, 0.8, 0.8), {30 * fineness, 8 * fineness, 8 * fineness}, 0.12);
}

// The polynomial through `nodes` shapes of the bar twisted by u * angle.
inline Curve twist_curve(const Mesh& mesh, double angle = std::numbers::pi, int nodes = 9) {
    Curve curve;
    curve.parameters = lobatto_nodes(nodes);
    for (const double u : curve.parameters) curve.nodes.push_back(twist(mesh.positions, 3, u * angle));
    return curve;
}

} // namespace meshtween
