// A sparse symmetric system that is factorised once and solved often.
#pragma once

#include "meshtween/core/mesh.h"

#include <Eigen/SparseCore>

#include <memory>

namespace meshtween {

class SparseCholesky {
public:
    // `matrix` holds at least the lower triangle of a symmetric positive definite matrix. Nested dissection (METIS), so
    // that a surface mesh of n vertices fills O(n log n). Throws Error(computation) where it is not positive definite.
    explicit SparseCholesky(const Eigen::SparseMatrix<double>& matrix);
    ~SparseCholesky();
    SparseCholesky(SparseCholesky&&) noexcept;
    SparseCholesky& operator=(SparseCholesky&&) noexcept;

    // x with matrix x = right. n x 3. Safe from several threads.
    Points solve(const Points& right) const;

private:
    struct Data;
    std::unique_ptr<const Data> data_;
};

} // namespace meshtween
