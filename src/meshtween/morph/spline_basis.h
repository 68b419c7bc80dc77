// B-splines on a row of knots: weights that are never negative, never over 1, and add up to 1.
#pragma once

#include <vector>

namespace meshtween {

// Knots ascend; the first and last value stand degree + 1 times. There are as many weights as knots, less degree + 1.
struct SplineBasis {
    int degree = 1;
    std::vector<double> knots;
    std::size_t size() const; // the number of weights
    // At u, or at the nearer end where u lies outside. At an end, and at a knot that stands `degree` times, one weight
    // is 1 and the others are 0. No more than degree + 1 are above 0.
    std::vector<double> weights(double u) const;
    std::vector<double> spans() const; // the knots that differ, ascending
};

// `count` equal spans of [0, 1].
SplineBasis even_basis(int degree, int spans);

} // namespace meshtween
