// Alexa, Differential Coordinates for Local Mesh Morphing and Deformation, 2003, with the blend of Eq. 9: blended
// linearly, the coordinates of Eq. 8 give straight lines and nothing else, for they are linear in the positions. A
// vertex of each component moves on its straight line; the rest follows from one factorisation and one solve.
#include "meshtween/solve/laplacian.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/morph/laplacian_coordinates.h"
#include "meshtween/morph/methods.h"
#include "meshtween/solve/cholesky.h"

namespace meshtween {
namespace {

// Rows of D - W add up to nought over a component, so the held vertex's equation is the sum of all others', negated.
// With 1 added to its diagonal and its right side so, the system is regular and it takes the value `held` exactly.
Points solve_held(SparseMatrix matrix, Points right, const std::vector<int>& component, const Points& held) {
    std::vector<Eigen::Index> holder;
    for (Eigen::Index i = 0; i < right.rows(); ++i) {
        const auto c = static_cast<std::size_t>(component[static_cast<std::size_t>(i)]);
        if (c >= holder.size()) {
            holder.push_back(i);
            matrix.coeffRef(i, i) += 1;
            right.row(i) = held.row(i);
        } else {
            right.row(holder[c]) -= right.row(i);
        }
    }
    return SparseCholesky(matrix).solve(right);
}

} // namespace

Morph laplacian_morph(const Mesh& from, const Points& to) {
    const Topology top = topology(from.positions.rows(), from.triangles);
    Points right = middle_coordinates(uniform_laplacian(from.positions, top.neighbours),
                                      uniform_laplacian(to, top.neighbours)); // Eq. 8 and 9
    for (Eigen::Index i = 0; i < right.rows(); ++i) right.row(i) *= static_cast<double>(top.neighbours[i].size());
    Points middle = solve_held(graph_laplacian(top.neighbours), std::move(right), components(top),
                               (from.positions + to) / 2); // Eq. 10
    const auto at = [s = from.positions, c = std::move(middle), to](const auto& u) { return quadratic(s, c, to, u); };
    return {at, [at](const Eigen::VectorXd& u, double) { return at(u); }, [] { return SolveReport{}; }};
}

} // namespace meshtween
