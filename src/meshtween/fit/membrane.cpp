#include "meshtween/fit/membrane.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <utility>
#include <vector>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

std::vector<std::pair<int, int>> edges_of(const Triangles& triangles) {
    std::vector<std::pair<int, int>> edges;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) edges.push_back(std::minmax({triangles(t, k), triangles(t, (k + 1) % 3)}));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

// From which vertices something held can be reached.
std::vector<char> spanned(Eigen::Index count, const std::vector<std::pair<int, int>>& edges, Eigen::Index free) {
    std::vector<char> reached(idx(count), 0);
    for (Eigen::Index i = free; i < count; ++i) reached[idx(i)] = 1;
    for (bool more = true; more;) {
        more = false;
        for (const auto& [i, j] : edges)
            if (reached[idx(i)] != reached[idx(j)]) reached[idx(i)] = reached[idx(j)] = 1, more = true;
    }
    return reached;
}

} // namespace

Points membrane(const Points& positions, const Triangles& triangles, Eigen::Index free) {
    const std::vector<std::pair<int, int>> edges = edges_of(triangles);
    const std::vector<char> moves = spanned(positions.rows(), edges, free);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(free, 3);
    for (Eigen::Index i = 0; i < free; ++i)
        if (!moves[idx(i)]) {
            entries.emplace_back(i, i, 1);
            right.row(i) = positions.row(i);
        }
    for (const auto& [i, j] : edges) { // j > i: of two, j may be held
        if (i >= free || !moves[idx(i)]) continue;
        entries.emplace_back(i, i, 1);
        if (j < free) {
            entries.emplace_back(j, j, 1);
            entries.emplace_back(j, i, -1); // the lower triangle
        } else {
            right.row(i) += positions.row(j);
        }
    }
    Eigen::SparseMatrix<double> matrix(free, free);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    Points result = positions;
    if (solver.info() == Eigen::Success) result.topRows(free) = solver.solve(right);
    return result;
}

} // namespace meshtween
