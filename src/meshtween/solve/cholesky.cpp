// Karypis and Kumar, A Fast and High Quality Multilevel Scheme for Partitioning Irregular Graphs, 1998 (the ordering).
#include "meshtween/solve/cholesky.h"

#include "meshtween/core/error.h"

#include <iostream> // Eigen's METIS header needs it

#include <Eigen/MetisSupport>
#include <Eigen/SparseCholesky>

namespace meshtween {

struct SparseCholesky::Data {
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::MetisOrdering<int>> factor;
};

SparseCholesky::SparseCholesky(const Eigen::SparseMatrix<double>& matrix) {
    auto data = std::make_unique<Data>();
    data->factor.compute(matrix);
    if (data->factor.info() != Eigen::Success || (data->factor.vectorD().array() <= 0).any())
        throw Error(ErrorKind::computation, "the mesh gives a singular system: a part of it is not held anywhere");
    data_ = std::move(data);
}

SparseCholesky::~SparseCholesky() = default;
SparseCholesky::SparseCholesky(SparseCholesky&&) noexcept = default;
SparseCholesky& SparseCholesky::operator=(SparseCholesky&&) noexcept = default;

Points SparseCholesky::solve(const Points& right) const {
    return data_->factor.solve(Eigen::MatrixXd(right));
}

} // namespace meshtween
