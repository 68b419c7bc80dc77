// Conjugate gradients with a geometric multigrid V-cycle.
//
// Briggs, Henson, McCormick: A multigrid tutorial. SIAM 2000.
// Tatebe: The multigrid preconditioned conjugate gradient method. 1993.
#include "meshtween/solve/block_system.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>

#include <algorithm>

namespace meshtween {
namespace {

using Eigen::Matrix3d;

constexpr double damping = 0.6; // of the block Jacobi smoother: under 2 / the largest eigenvalue of D^-1 A
constexpr int sweeps = 2;       // before and after each visit of the coarser grid

double dot(const Points& a, const Points& b) {
    return parallel_sum(a.rows(), 0.0, [&](std::ptrdiff_t i) {
        const double *p = a.data() + 3 * i, *q = b.data() + 3 * i;
        return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    });
}

// y = right - A x
void residual(const BlockSystem& system, const Points& right, const Points& x, Points& y) {
    y.resize(x.rows(), 3);
    const Pattern& p = *system.pattern;
    parallel_for(x.rows(), [&](std::ptrdiff_t i) {
        const double* at = x.data() + 3 * i;
        const Matrix3d& d = system.blocks[static_cast<std::size_t>(i)];
        double sum[3];
        for (int k = 0; k < 3; ++k) sum[k] = right(i, k) - (d(0, k) * at[0] + d(1, k) * at[1] + d(2, k) * at[2]);
        for (int e = p.first[static_cast<std::size_t>(i)]; e < p.first[static_cast<std::size_t>(i) + 1]; ++e) {
            const double* other = x.data() + 3 * std::ptrdiff_t{p.column[static_cast<std::size_t>(e)]};
            const double value = system.values[static_cast<std::size_t>(e)];
            for (int k = 0; k < 3; ++k) sum[k] -= value * other[k];
        }
        for (int k = 0; k < 3; ++k) y(i, k) = sum[k];
    });
}

std::vector<Matrix3d> inverse_diagonal(const BlockSystem& system) {
    std::vector<Matrix3d> inverse(system.blocks.size());
    for (std::size_t i = 0; i < inverse.size(); ++i) {
        const double value = system.values[static_cast<std::size_t>(system.pattern->diagonal[i])];
        const Matrix3d block = system.blocks[i] + value * Matrix3d::Identity();
        inverse[i] = block.trace() > 0 ? Matrix3d(block.inverse()) : Matrix3d(Matrix3d::Zero());
    }
    return inverse;
}

Eigen::SparseMatrix<double> lower_triangle(const BlockSystem& system) {
    std::vector<Eigen::Triplet<double>> entries;
    const Pattern& p = *system.pattern;
    double greatest = 0;
    for (std::size_t i = 0; i < system.blocks.size(); ++i)
        greatest =
            std::max(greatest, system.values[static_cast<std::size_t>(p.diagonal[i])] + system.blocks[i].trace());
    for (std::size_t row = 0; row < system.blocks.size(); ++row) {
        const int i = static_cast<int>(row);
        for (int e = p.first[row]; e < p.first[row + 1]; ++e) {
            const int j = p.column[static_cast<std::size_t>(e)];
            const double value = system.values[static_cast<std::size_t>(e)];
            if (j < i)
                for (int k = 0; k < 3; ++k) entries.emplace_back(3 * i + k, 3 * j + k, value);
            else if (j == i)
                for (int k = 0; k < 3; ++k)
                    for (int l = 0; l <= k; ++l)
                        entries.emplace_back(3 * i + k, 3 * i + l,
                                             system.blocks[row](k, l) + (k == l ? value + 1e-12 * greatest : 0));
        }
    }
    const auto n = 3 * static_cast<Eigen::Index>(system.blocks.size());
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

} // namespace

std::size_t Pattern::at(int row, int col) const {
    const auto begin = column.begin() + first[static_cast<std::size_t>(row)];
    const auto end = column.begin() + first[static_cast<std::size_t>(row) + 1];
    return static_cast<std::size_t>(std::lower_bound(begin, end, col) - column.begin());
}

Pattern pattern(std::vector<std::vector<int>> rows) {
    Pattern result;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        auto& row = rows[i];
        row.push_back(static_cast<int>(i));
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        const auto own = std::lower_bound(row.begin(), row.end(), static_cast<int>(i)) - row.begin();
        result.diagonal.push_back(static_cast<int>(result.column.size()) + static_cast<int>(own));
        result.column.insert(result.column.end(), row.begin(), row.end());
        result.first.push_back(static_cast<int>(result.column.size()));
    }
    return result;
}

Points apply(const BlockSystem& system, const Points& x) {
    Points y;
    residual(system, Points::Zero(x.rows(), 3), x, y);
    return -y;
}

Interpolation interpolation(std::ptrdiff_t coarse_count, std::vector<std::array<int, 3>> points,
                            std::vector<Eigen::RowVector3d> weights) {
    Interpolation result;
    result.first.assign(static_cast<std::size_t>(coarse_count) + 1, 0);
    for (const auto& corners : points)
        for (const int c : corners) ++result.first[static_cast<std::size_t>(c) + 1];
    for (std::size_t i = 1; i < result.first.size(); ++i) result.first[i] += result.first[i - 1];
    std::vector<int> next(result.first.begin(), result.first.end() - 1);
    result.fine.resize(static_cast<std::size_t>(result.first.back()));
    result.slot.resize(result.fine.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const auto at =
                static_cast<std::size_t>(next[static_cast<std::size_t>(points[i][static_cast<std::size_t>(k)])]++);
            result.fine[at] = static_cast<int>(i);
            result.slot[at] = k;
        }
    result.points = std::move(points);
    result.weights = std::move(weights);
    return result;
}

Points to_fine(const Interpolation& interpolation, const Points& coarse) {
    Points fine(static_cast<Eigen::Index>(interpolation.points.size()), 3);
    parallel_for(fine.rows(), [&](std::ptrdiff_t i) {
        const auto& p = interpolation.points[static_cast<std::size_t>(i)];
        const auto& w = interpolation.weights[static_cast<std::size_t>(i)];
        fine.row(i) = w[0] * coarse.row(p[0]) + w[1] * coarse.row(p[1]) + w[2] * coarse.row(p[2]);
    });
    return fine;
}

template <typename Get, typename Sum>
static void gather(const Interpolation& interpolation, std::ptrdiff_t c, const Get& get, Sum& sum) {
    const auto i = static_cast<std::size_t>(c);
    for (auto e = static_cast<std::size_t>(interpolation.first[i]);
         e < static_cast<std::size_t>(interpolation.first[i + 1]); ++e) {
        const auto fine = static_cast<std::size_t>(interpolation.fine[e]);
        sum += interpolation.weights[fine][interpolation.slot[e]] * get(fine);
    }
}

Points to_coarse(const Interpolation& interpolation, const Points& fine) {
    Points coarse(static_cast<Eigen::Index>(interpolation.first.size()) - 1, 3);
    parallel_for(coarse.rows(), [&](std::ptrdiff_t c) {
        Point sum(0, 0, 0);
        gather(
            interpolation, c, [&](std::size_t i) { return fine.row(static_cast<Eigen::Index>(i)); }, sum);
        coarse.row(c) = sum;
    });
    return coarse;
}

std::vector<Matrix3d> to_coarse(const Interpolation& interpolation, const std::vector<Matrix3d>& fine) {
    std::vector<Matrix3d> coarse(interpolation.first.size() - 1, Matrix3d::Zero());
    parallel_for(static_cast<std::ptrdiff_t>(coarse.size()), [&](std::ptrdiff_t c) {
        gather(
            interpolation, c, [&](std::size_t i) { return fine[i]; }, coarse[static_cast<std::size_t>(c)]);
    });
    return coarse;
}

struct Multigrid::Data {
    std::vector<BlockSystem> systems;
    const std::vector<Interpolation>* interpolations;
    std::size_t offset;
    std::vector<std::vector<Matrix3d>> inverse;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> coarsest;
    mutable std::vector<Points> residuals;

    // z += damping * D^-1 r
    void relax(std::size_t grid, const Points& r, Points& z) const {
        parallel_for(r.rows(), [&](std::ptrdiff_t i) {
            z.row(i) += damping * r.row(i) * inverse[grid][static_cast<std::size_t>(i)];
        });
    }

    Points cycle(std::size_t grid, const Points& right) const {
        if (grid + 1 == systems.size()) {
            const Eigen::VectorXd x = coarsest.solve(Eigen::Map<const Eigen::VectorXd>(right.data(), right.size()));
            return Eigen::Map<const Points>(x.data(), right.rows(), 3);
        }
        Points z = Points::Zero(right.rows(), 3);
        Points& r = residuals[grid];
        relax(grid, right, z);
        for (int sweep = 1; sweep < sweeps; ++sweep) {
            residual(systems[grid], right, z, r);
            relax(grid, r, z);
        }
        residual(systems[grid], right, z, r);
        const Interpolation& up = (*interpolations)[offset + grid];
        z += to_fine(up, cycle(grid + 1, to_coarse(up, r)));
        for (int sweep = 0; sweep < sweeps; ++sweep) {
            residual(systems[grid], right, z, r);
            relax(grid, r, z);
        }
        return z;
    }
};

Multigrid::Multigrid(std::vector<BlockSystem> systems, const std::vector<Interpolation>& interpolations,
                     std::size_t offset)
    : data_(std::make_unique<Data>()) {
    data_->systems = std::move(systems);
    data_->interpolations = &interpolations;
    data_->offset = offset;
    for (std::size_t k = 0; k + 1 < data_->systems.size(); ++k)
        data_->inverse.push_back(inverse_diagonal(data_->systems[k]));
    data_->residuals.resize(data_->systems.size());
    data_->coarsest.compute(lower_triangle(data_->systems.back()));
    if (data_->coarsest.info() != Eigen::Success)
        throw Error(ErrorKind::computation,
                    "the system of the coarsest mesh is singular: part of it is held by nothing");
}

Multigrid::~Multigrid() = default;
Multigrid::Multigrid(Multigrid&&) noexcept = default;

SolveSummary Multigrid::solve(const Points& right, Points& x, int max_iterations, double tolerance) const {
    SolveSummary summary;
    if (data_->systems.size() == 1) {
        x = data_->cycle(0, right);
        summary.reduction = 0;
        return summary;
    }
    const BlockSystem& system = data_->systems[0];
    Points r, q;
    residual(system, right, x, r);
    Points z = data_->cycle(0, r), p = z;
    const Points zero = Points::Zero(x.rows(), 3);
    double rz = dot(r, z);
    const double start = rz;
    while (summary.iterations < max_iterations && rz > tolerance * tolerance * start && rz > 0) {
        residual(system, zero, p, q); // -A p
        const double alpha = -rz / dot(p, q);
        x += alpha * p;
        r += alpha * q;
        z = data_->cycle(0, r);
        const double next = dot(r, z);
        p = z + (next / rz) * p;
        rz = next;
        ++summary.iterations;
    }
    summary.reduction = start > 0 ? std::sqrt(std::max(0.0, rz / start)) : 0;
    return summary;
}

} // namespace meshtween
