// A morph whose every shape is known: a bar twisted about its length.
#pragma once

#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/morph/curve.h"
#include "meshtween/morph/spline_fit.h"

#include <numbers>

namespace meshtween {

inline Mesh straight_bar(int fineness = 1) {
    return bar(Point(3, 0.8, 0.8), {30 * fineness, 8 * fineness, 8 * fineness}, 0.12);
}

// The polynomial through `nodes` shapes of the bar twisted by u * angle, with as many control meshes.
inline Curve twist_curve(const Mesh& mesh, double angle = std::numbers::pi, int nodes = 9) {
    Interpolant path;
    path.parameters = lobatto_nodes(nodes);
    for (const double u : path.parameters) path.nodes.push_back(twist(mesh.positions, 3, u * angle));
    Curve curve;
    curve.diagonal = diagonal(mesh);
    curve.basis = even_basis(nodes - 1, 1);
    curve.nodes = control_meshes(curve.basis, {path, {}, 0});
    curve.keys = {0, 1};
    return curve;
}

} // namespace meshtween
