// A sparse symmetric system that is factorised once and solved often.
#pragma once

#include "meshtween/core/mesh.h"

#include <Eigen/SparseCore>

#include <memory>

namespace meshtween {

struct Supernodes; // where a factor has entries

// For matrices with entries in the same places, the lower triangle given: found once, by nested dissection (METIS), so
// that a surface mesh of n vertices fills O(n log n).
std::shared_ptr<const Supernodes> factor_pattern(const Eigen::SparseMatrix<double>& matrix);

class SparseCholesky {
public:
    // `matrix` holds at least the lower triangle of a symmetric positive definite matrix; `pattern` is factor_pattern's
    // of its places, or none. Throws Error(computation) where it is not positive definite.
    explicit SparseCholesky(const Eigen::SparseMatrix<double>& matrix,
                            std::shared_ptr<const Supernodes> pattern = nullptr);
    ~SparseCholesky();
    SparseCholesky(SparseCholesky&&) noexcept;
    SparseCholesky& operator=(SparseCholesky&&) noexcept;

    // x with matrix x = right. n x 3; or n. Safe from several threads.
    Points solve(const Points& right) const;
    Eigen::VectorXd solve_vector(const Eigen::VectorXd& right) const;

private:
    struct Data;
    std::unique_ptr<const Data> data_;
};

} // namespace meshtween
