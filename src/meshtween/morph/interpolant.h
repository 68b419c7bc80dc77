// Any path as the polynomial through a few of its shapes: what is bent, paced and joined before a curve is made of it.
#pragma once

#include "meshtween/morph/morph.h"

#include <Eigen/Core>

namespace meshtween {

// The polynomial through the path's shapes at Chebyshev-Lobatto nodes of [0, 1].
struct Interpolant {
    std::vector<double> parameters; // ascending, the first 0, the last 1
    std::vector<Points> nodes;      // the shapes there
    double error = 0;               // how far it may lie beside the path between nodes, a length
    double diagonal = 0;            // to which tolerances refer: the morph's, a length
    bool cancelled = false;         // the progress said so: then it has no nodes
    Points at(double u) const;
};

// K Chebyshev-Lobatto nodes of [0, 1], ascending: (1 - cos(k pi / (K - 1))) / 2.
std::vector<double> lobatto_nodes(int count);

// The weights, adding up to 1, of values at Lobatto nodes in their polynomial at u; they may be negative.
std::vector<double> lagrange_weights(const std::vector<double>& parameters, double u);

// The weights, adding up to 0, of values at Lobatto nodes in their polynomial's derivative at the first or last node.
std::vector<double> end_derivative_weights(const std::vector<double>& parameters, bool last);

// sum_k weights[k] shapes[k], over the weights that are not 0.
Points weighted_sum(const std::vector<Points>& shapes, const std::vector<double>& weights);

// Doubles K - 1 until the error is within the tolerance (parts of the diagonal), or as far as `most` nodes.
Interpolant interpolant(const Morph& morph, double tolerance, int most = 65, const Progress& progress = {});

// The same polynomial through at least `count` nodes.
Interpolant resampled(const Interpolant& path, int count);

} // namespace meshtween
