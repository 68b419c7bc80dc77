#include "meshtween/fit/free_region.h"

#include "meshtween/solve/cholesky.h"
#include "meshtween/solve/laplacian.h"

namespace meshtween {

Points attached(const Portion& region, const Points& guess, const std::vector<char>& held, const Points& places) {
    const Eigen::Index n = guess.rows();
    SparseMatrix matrix =
        cotangent_laplacian(n, region.triangles, half_cotangents(edge_lengths(region.positions, region.triangles)));
    const double strength = 1e6 * (1 + matrix.diagonal().maxCoeff()); // so much firmer that held is held
    Points right = Points::Zero(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) {
        matrix.coeffRef(i, i) += 1e-9 * strength * 1e-6; // what is attached to nothing stays as guessed
        if (held[static_cast<std::size_t>(i)] == 0) continue;
        matrix.coeffRef(i, i) += strength;
        right.row(i) = strength * (places.row(i) - guess.row(i));
    }
    Points result = guess + SparseCholesky(matrix).solve(right);
    for (Eigen::Index i = 0; i < n; ++i)
        if (held[static_cast<std::size_t>(i)] != 0) result.row(i) = places.row(i);
    return result;
}

} // namespace meshtween
