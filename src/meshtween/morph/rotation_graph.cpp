#include "meshtween/morph/rotation_graph.h"

#include "meshtween/core/error.h"

#include <Eigen/SVD>
#include <Eigen/SparseCholesky>

#include <algorithm>

namespace meshtween {
namespace {

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& m) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d sign(1, 1, 1);
    if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) sign[2] = -1;
    return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

} // namespace

// Row by row of X: the unknowns are the transposed X, one below the other, and the matrix has 3 x 3 blocks -weight M.
Quaternions synchronised(int count, const std::vector<RotationLink>& links, const std::vector<RotationRoot>& roots) {
    std::vector<Eigen::Triplet<double>> triplets;
    triplets.reserve(15 * links.size());
    for (const RotationLink& link : links)
        for (int i = 0; i < 3; ++i) {
            const int row = 3 * link.first + i;
            triplets.emplace_back(row, row, link.weight);
            triplets.emplace_back(3 * link.second + i, 3 * link.second + i, link.weight);
            for (int j = 0; j < 3; ++j) { // the lower triangle
                const int column = 3 * link.second + j;
                triplets.emplace_back(std::max(row, column), std::min(row, column), -link.weight * link.rotation(i, j));
            }
        }
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(3 * static_cast<Eigen::Index>(count), 3);
    for (const RotationRoot& root : roots)
        for (int i = 0; i < 3; ++i) {
            triplets.emplace_back(3 * root.node + i, 3 * root.node + i, root.weight);
            right.row(3 * root.node + i) = root.weight * root.rotation.col(i).transpose();
        }
    Eigen::SparseMatrix<double> matrix(right.rows(), right.rows());
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    if (solver.info() != Eigen::Success) throw Error(ErrorKind::computation, "some rotations are not held anywhere");
    const Eigen::MatrixXd x = solver.solve(right);
    Quaternions rotations;
    for (int p = 0; p < count; ++p)
        rotations.emplace_back(nearest_rotation(x.middleRows<3>(3 * static_cast<Eigen::Index>(p)).transpose()));
    return rotations;
}

} // namespace meshtween
