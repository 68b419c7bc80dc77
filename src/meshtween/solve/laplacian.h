// Laplacians of a mesh, with their signs and normalisations.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/geometry/topology.h"

#include <Eigen/SparseCore>

namespace meshtween {

using SparseMatrix = Eigen::SparseMatrix<double>;

// The mean of each vertex's neighbours. n x 3; a vertex without neighbours gives a zero row.
Points neighbour_mean(const Points& positions, const Lists& neighbours);

// The Laplacian coordinates of Eq. 8: p_i minus the mean of its neighbours, or nought for a vertex without neighbours.
// n x 3, the mesh's unit; they point outwards where the surface is convex.
Points uniform_laplacian(const Points& positions, const Lists& neighbours);

// The lower triangle of D - W (degree minus adjacency): symmetric, positive semidefinite, rows add up to nought. It is
// the matrix of Eq. 8 with each row multiplied by the vertex's number of neighbours.
SparseMatrix graph_laplacian(const Lists& neighbours);

// Half the cotangent of each triangle's angle opposite the edge from corner k to corner k + 1. m x 3, without unit.
// Computed from edge lengths, which are first lengthened, all by the same amount, so that each triangle keeps its
// inequality by `mollify` times the mean length (Sharp and Crane, A Laplacian for Nonmanifold Triangle Meshes, 2020):
// finite for any triangle, and the quadratic form stays positive semidefinite. Lengths that are all nought count as
// equal.
Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>
half_cotangents(const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>& lengths, double mollify = 1e-5);

// The lengths of each triangle's edges from corner k to corner k + 1. m x 3, the mesh's unit.
Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> edge_lengths(const Points& positions,
                                                                       const Triangles& triangles);

// The lower triangle of the cotangent Laplacian with these weights (Pinkall and Polthier 1993): entry ij is minus the
// sum of the half cotangents opposite the edge, rows add up to nought; positive semidefinite, not divided by areas.
SparseMatrix cotangent_laplacian(Eigen::Index vertex_count, const Triangles& triangles,
                                 const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>& weights);

// The same with 1 added to the diagonal of the first vertex of each component (as numbered by components()). It is
// regular; where the right side adds up to nought over a component, that vertex comes out as nought.
SparseMatrix held(SparseMatrix laplacian, const std::vector<int>& component);

} // namespace meshtween
