// The shape whose edges are as long as the blend of both ends' says.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/solve/cholesky.h"

namespace meshtween {

// What the search needs: both ends, the triangles with their half cotangents, and the Poisson system made of those.
struct LengthProblem {
    const Points& from;
    const Points& to;
    const Triangles& triangles;
    const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>& weights;
    const Lists& vertex_triangles;
    const SparseCholesky& poisson;
    bool closed = false; // the shapes have a volume, to be kept at the mean of the ends'
};

// The mean relative difference between the edges' lengths and the mean of their lengths at both ends, over the sides of
// triangles.
double middle_strain(const LengthProblem& problem, const Points& shape);

// Rounds of laying every triangle, with the mean of both ends' side lengths, onto where it is, and putting the
// triangles together by the Poisson system; accelerated. Begins with `shape`; each component comes out at a place of
// its own. The shape of the round with the least strain.
Points with_blended_lengths(const LengthProblem& problem, const Points& shape, int rounds);

} // namespace meshtween
