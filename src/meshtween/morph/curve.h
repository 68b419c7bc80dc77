// Any path as a few meshes and their weights: what makes frames cheap and glTF files small.
#pragma once

#include "meshtween/morph/morph.h"

namespace meshtween {

struct CurveOptions {
    double tolerance = 1e-4; // largest deviation from the path, checked between nodes, parts of `from`'s diagonal
    int max_nodes = 33;      // Chebyshev-Lobatto nodes at most, 2 or more
};

// p(u) = sum_k weights(u)[k] nodes[k]: the polynomial through the path at Chebyshev-Lobatto nodes of [0, 1], or one
// such polynomial after the other where the path has several pieces.
struct Curve {
    std::vector<double> parameters; // K ascending nodes, the first 0, the last 1
    std::vector<Points> nodes;      // K meshes, the first and last the ends exactly
    std::vector<int> knots;         // the nodes where pieces begin and end, 0 and K - 1 among them; empty for one piece
    double deviation = 0;           // the largest found between nodes, parts of the diagonal
    bool cancelled = false;         // the progress said so: the nodes are those of the last full step
    std::vector<double> weights(double u) const; // K barycentric Lagrange weights, adding up to 1, 0 in other pieces
    Points at(double u) const;
};

// Where pieces begin and end, from 0 to 1.
std::vector<double> key_times(const Curve& curve);

// The same polynomial through at least `count` nodes; a curve of one piece.
Curve resampled(const Curve& curve, int count);

// K Chebyshev-Lobatto nodes of [0, 1], ascending: (1 - cos(k pi / (K - 1))) / 2.
std::vector<double> lobatto_nodes(int count);

// Doubles K - 1 until the deviation is within the tolerance; says in `deviation` where max_nodes was not enough.
// Throws Error(argument) for a tolerance that is not above 0 or max_nodes below 2.
Curve curve(const Morph& morph, const CurveOptions& options = {}, const Progress& progress = {});

} // namespace meshtween
