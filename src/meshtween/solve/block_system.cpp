// Conjugate gradients with a geometric multigrid V-cycle (v_cycle).
//
// Tatebe: The multigrid preconditioned conjugate gradient method. 1993.
#include "meshtween/solve/block_system.h"

#include "meshtween/core/parallel.h"
#include "meshtween/solve/v_cycle.h"

#include <algorithm>

namespace meshtween {
namespace {

using Eigen::Matrix3d;

double dot(const Points& a, const Points& b) {
    return parallel_sum(a.rows(), 0.0, [&](std::ptrdiff_t i) {
        const double *p = a.data() + 3 * i, *q = b.data() + 3 * i;
        return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    });
}

// Row i of A x.
Eigen::RowVector3d row_times(const BlockSystem& system, const Points& x, std::ptrdiff_t i) {
    const Pattern& p = *system.pattern;
    const double* at = x.data() + 3 * i;
    const Matrix3d& d = system.blocks[static_cast<std::size_t>(i)];
    double sum[3];
    for (int k = 0; k < 3; ++k) sum[k] = d(0, k) * at[0] + d(1, k) * at[1] + d(2, k) * at[2];
    for (int e = p.first[static_cast<std::size_t>(i)]; e < p.first[static_cast<std::size_t>(i) + 1]; ++e) {
        const double* other = x.data() + 3 * std::ptrdiff_t{p.column[static_cast<std::size_t>(e)]};
        const double value = system.values[static_cast<std::size_t>(e)];
        for (int k = 0; k < 3; ++k) sum[k] += value * other[k];
    }
    return {sum[0], sum[1], sum[2]};
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
    Points y(x.rows(), 3);
    parallel_for(x.rows(), [&](std::ptrdiff_t i) { y.row(i) = row_times(system, x, i); });
    return y;
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

std::vector<Matrix3d> to_coarse(const Interpolation& interpolation, const std::vector<Matrix3d>& fine) {
    std::vector<Matrix3d> coarse(interpolation.first.size() - 1, Matrix3d::Zero());
    parallel_for(static_cast<std::ptrdiff_t>(coarse.size()), [&](std::ptrdiff_t c) {
        const auto i = static_cast<std::size_t>(c);
        for (auto e = static_cast<std::size_t>(interpolation.first[i]);
             e < static_cast<std::size_t>(interpolation.first[i + 1]); ++e) {
            const auto from = static_cast<std::size_t>(interpolation.fine[e]);
            coarse[i] += interpolation.weights[from][interpolation.slot[e]] * fine[from];
        }
    });
    return coarse;
}

struct Multigrid::Data {
    VCycle cycle;
    BlockSystem finest;
    bool direct; // there is one grid, and the cycle solves it but for the rounding to floats

    Data(std::vector<BlockSystem> systems, const std::vector<Interpolation>& interpolations, std::size_t offset)
        : cycle(systems, interpolations, offset), finest(std::move(systems[0])), direct(systems.size() == 1) {}
};

Multigrid::Multigrid(std::vector<BlockSystem> systems, const std::vector<Interpolation>& interpolations,
                     std::size_t offset)
    : data_(std::make_unique<Data>(std::move(systems), interpolations, offset)) {}

Multigrid::~Multigrid() = default;
Multigrid::Multigrid(Multigrid&&) noexcept = default;

SolveSummary Multigrid::solve(const Points& right, Points& x, int max_iterations, double tolerance) const {
    constexpr double direct_tolerance = 1e-10;
    if (data_->direct) tolerance = std::min(tolerance, direct_tolerance);
    SolveSummary summary;
    const BlockSystem& system = data_->finest;
    const std::ptrdiff_t n = x.rows();
    Points r(n, 3), q(n, 3), z, p;
    parallel_for(n, [&](std::ptrdiff_t i) { r.row(i) = right.row(i) - row_times(system, x, i); });
    data_->cycle.apply(r, z);
    p = z;
    double rz = dot(r, z);
    const double start = rz;
    while (summary.iterations < max_iterations && rz > tolerance * tolerance * start && rz > 0) {
        parallel_for(n, [&](std::ptrdiff_t i) { q.row(i) = row_times(system, p, i); });
        const double alpha = rz / dot(p, q);
        parallel_for(n, [&](std::ptrdiff_t i) {
            x.row(i) += alpha * p.row(i);
            r.row(i) -= alpha * q.row(i);
        });
        data_->cycle.apply(r, z);
        const double next = dot(r, z), beta = next / rz;
        parallel_for(n, [&](std::ptrdiff_t i) { p.row(i) = z.row(i) + beta * p.row(i); });
        rz = next;
        ++summary.iterations;
    }
    summary.reduction = start > 0 ? std::sqrt(std::max(0.0, rz / start)) : 0;
    return summary;
}

} // namespace meshtween
