// Eq. 8 of Yoo, Three-dimensional Morphing of Similar Shapes Using a Template Mesh; Pinkall and Polthier, Computing
// Discrete Minimal Surfaces and Their Conjugates, 1993; Sharp and Crane, A Laplacian for Nonmanifold Triangle Meshes,
// 2020 (the mollified lengths).
#include "meshtween/solve/laplacian.h"

#include "meshtween/core/parallel.h"

#include <cmath>

namespace meshtween {
namespace {

using Corners = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Triplets = std::vector<Eigen::Triplet<double>>;

SparseMatrix assemble(Eigen::Index n, const Triplets& triplets) {
    SparseMatrix matrix(n, n);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    return matrix;
}

} // namespace

Points neighbour_mean(const Points& positions, const Lists& neighbours) {
    Points mean(positions.rows(), 3);
    parallel_for(positions.rows(), [&](Eigen::Index i) {
        Point sum = Point::Zero();
        for (const int j : neighbours[i]) sum += positions.row(j);
        mean.row(i) = neighbours[i].empty() ? sum : sum / static_cast<double>(neighbours[i].size());
    });
    return mean;
}

Points uniform_laplacian(const Points& positions, const Lists& neighbours) {
    Points delta = positions - neighbour_mean(positions, neighbours);
    for (Eigen::Index i = 0; i < delta.rows(); ++i)
        if (neighbours[i].empty()) delta.row(i).setZero();
    return delta;
}

SparseMatrix graph_laplacian(const Lists& neighbours) {
    Triplets triplets;
    triplets.reserve(neighbours.items.size() / 2 + static_cast<std::size_t>(neighbours.size()));
    for (int i = 0; i < neighbours.size(); ++i) {
        triplets.emplace_back(i, i, static_cast<double>(neighbours[i].size()));
        for (const int j : neighbours[i])
            if (j < i) triplets.emplace_back(i, j, -1.0);
    }
    return assemble(neighbours.size(), triplets);
}

Corners edge_lengths(const Points& positions, const Triangles& triangles) {
    Corners lengths(triangles.rows(), 3);
    parallel_for(triangles.rows(), [&](Eigen::Index t) {
        for (int k = 0; k < 3; ++k)
            lengths(t, k) = (positions.row(triangles(t, (k + 1) % 3)) - positions.row(triangles(t, k))).norm();
    });
    return lengths;
}

Corners half_cotangents(const Corners& lengths, double mollify) {
    const Eigen::Index m = lengths.rows();
    if (m == 0) return lengths;
    const double mean = lengths.sum() / static_cast<double>(3 * m);
    if (mean <= 0) return half_cotangents(Corners::Ones(m, 3), mollify);
    const double slack = mollify * mean;
    double longer = 0; // what every length must grow by, so that a + b >= c + slack everywhere
    for (Eigen::Index t = 0; t < m; ++t)
        longer = std::max(longer, 2 * lengths.row(t).maxCoeff() - lengths.row(t).sum() + slack);
    Corners half(m, 3);
    parallel_for(m, [&](Eigen::Index t) {
        const Eigen::RowVector3d l = lengths.row(t).array() + longer;
        const double s = l.sum() / 2;
        const double area = std::sqrt(std::max(0.0, s * (s - l[0]) * (s - l[1]) * (s - l[2]))); // Heron
        const double squares = l.squaredNorm();
        for (int k = 0; k < 3; ++k) half(t, k) = area > 0 ? (squares - 2 * l[k] * l[k]) / (8 * area) : 0;
    });
    return half;
}

SparseMatrix cotangent_laplacian(Eigen::Index vertex_count, const Triangles& triangles, const Corners& weights) {
    Triplets triplets;
    triplets.reserve(static_cast<std::size_t>(9 * triangles.rows()));
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const int i = triangles(t, k), j = triangles(t, (k + 1) % 3);
            if (i == j) continue;
            triplets.emplace_back(std::max(i, j), std::min(i, j), -weights(t, k));
            triplets.emplace_back(i, i, weights(t, k));
            triplets.emplace_back(j, j, weights(t, k));
        }
    return assemble(vertex_count, triplets);
}

SparseMatrix held(SparseMatrix laplacian, const std::vector<int>& component) {
    int next = 0;
    for (std::size_t i = 0; i < component.size(); ++i)
        if (component[i] == next) {
            laplacian.coeffRef(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) += 1;
            ++next;
        }
    return laplacian;
}

} // namespace meshtween
