// Briggs, Henson, McCormick: A multigrid tutorial. SIAM 2000. The smoother is Jacobi's by blocks, damped.
#include "meshtween/solve/v_cycle.h"

#include "meshtween/core/parallel.h"

#include <Eigen/LU>

#include <algorithm>

namespace meshtween {
namespace {

using Eigen::Matrix3d;

constexpr double damping = 0.6; // under 2 / the largest eigenvalue of D^-1 A
constexpr int sweeps = 2;       // before and after each visit of the coarser grid
constexpr std::ptrdiff_t grain = 2048;

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// With `ridge` of its greatest entry added to the diagonal, so that roundings leave it positive definite.
Eigen::SparseMatrix<double> lower_triangle(const BlockSystem& system, double ridge) {
    std::vector<Eigen::Triplet<double>> entries;
    const Pattern& p = *system.pattern;
    double greatest = 0;
    for (std::size_t i = 0; i < system.blocks.size(); ++i)
        greatest = std::max(greatest, system.values[idx(p.diagonal[i])] + system.blocks[i].trace());
    for (std::size_t row = 0; row < system.blocks.size(); ++row) {
        const int i = static_cast<int>(row);
        const Matrix3d block = lumped_block(system, i);
        for (auto e = idx(p.first[row]); e < idx(p.first[row + 1]); ++e) {
            const int j = p.column[e];
            const double value = system.values[e];
            if (j < i)
                for (int k = 0; k < 3; ++k) entries.emplace_back(3 * i + k, 3 * j + k, value);
            else if (j == i)
                for (int k = 0; k < 3; ++k)
                    for (int l = 0; l <= k; ++l)
                        entries.emplace_back(3 * i + k, 3 * i + l,
                                             block(k, l) + (k == l ? value + ridge * greatest : 0));
        }
    }
    const auto n = 3 * static_cast<Eigen::Index>(system.blocks.size());
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

} // namespace

std::shared_ptr<const Supernodes> factor_pattern(std::shared_ptr<const Pattern> pattern) {
    BlockSystem system;
    system.values.assign(pattern->column.size(), 1);
    system.blocks.assign(idx(pattern->size()), Matrix3d::Ones());
    system.pattern = std::move(pattern);
    return factor_pattern(lower_triangle(system, 0));
}

std::array<FloatPoint, 3> float_columns(const Matrix3d& block) {
    std::array<FloatPoint, 3> result{};
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) result[idx(c)][r] = static_cast<float>(block(r, c));
    return result;
}

FloatGrid float_grid(const BlockSystem& system) {
    FloatGrid grid;
    grid.pattern = system.pattern;
    grid.values.assign(system.values.begin(), system.values.end());
    grid.blocks.resize(system.blocks.size());
    grid.smoother.resize(system.blocks.size());
    parallel_for(std::ssize(system.blocks), [&](std::ptrdiff_t i) {
        const double value = system.values[idx(system.pattern->diagonal[idx(i)])];
        const Matrix3d own = lumped_block(system, i);
        const Matrix3d whole = own + value * Matrix3d::Identity();
        grid.blocks[idx(i)] = float_columns(own);
        grid.smoother[idx(i)] =
            float_columns(whole.trace() > 0 ? Matrix3d(damping * whole.inverse()) : Matrix3d::Zero());
    });
    return grid;
}

VCycle::VCycle(const std::vector<BlockSystem>& systems, const std::vector<Interpolation>& interpolations,
               std::size_t offset, std::shared_ptr<const Supernodes> coarsest_factor)
    : up_(interpolations.data() + offset),
      coarsest_(lower_triangle(systems.back(), systems[0].couplings.empty() ? 1e-12 : 1e-7),
                std::move(coarsest_factor)),
      scratch_(systems.size()) {
    for (std::size_t k = 0; k < systems.size(); ++k) {
        grids_.push_back(float_grid(systems[k]));
        const std::size_t n = systems[k].blocks.size();
        scratch_[k] = {FloatPoints(n), FloatPoints(n), FloatPoints(n)};
    }
}

const FloatPoints& VCycle::apply(const FloatPoints& right) const {
    scratch_[0].right = right;
    cycle(0);
    return scratch_[0].now;
}

void VCycle::cycle(std::size_t level) const {
    Scratch& at = scratch_[level];
    const auto n = std::ssize(at.right);
    if (level + 1 == grids_.size()) {
        Eigen::VectorXd b(3 * n);
        for (std::ptrdiff_t i = 0; i < n; ++i)
            for (int k = 0; k < 3; ++k) b[3 * i + k] = at.right[idx(i)][k];
        const Eigen::VectorXd x = coarsest_.solve_vector(b);
        for (std::ptrdiff_t i = 0; i < n; ++i)
            for (int k = 0; k < 3; ++k) at.now[idx(i)][k] = static_cast<float>(x[3 * i + k]);
        return;
    }
    const FloatGrid& grid = grids_[level];
    const auto each = [&](const auto& body) {
        parallel_for(
            n, [&](std::ptrdiff_t i) { body(idx(i)); }, grain);
    };
    const auto smooth = [&] {
        each([&](std::size_t i) {
            at.next[i] = at.now[i] + times(grid.smoother[i], at.right[i] - row_times(grid, at.now, i));
        });
        at.now.swap(at.next);
    };
    each([&](std::size_t i) { at.now[i] = times(grid.smoother[i], at.right[i]); });
    for (int sweep = 1; sweep < sweeps; ++sweep) smooth();
    each([&](std::size_t i) { at.next[i] = at.right[i] - row_times(grid, at.now, i); });
    const Interpolation& up = up_[level];
    Scratch& coarser = scratch_[level + 1];
    parallel_for(
        std::ssize(coarser.right),
        [&](std::ptrdiff_t c) {
            FloatPoint sum{};
            for (auto e = idx(up.first[idx(c)]); e < idx(up.first[idx(c) + 1]); ++e) {
                const auto fine = idx(up.fine[e]);
                sum += static_cast<float>(up.weights[fine][up.slot[e]]) * at.next[fine];
            }
            coarser.right[idx(c)] = sum;
        },
        grain / 4);
    cycle(level + 1);
    each([&](std::size_t i) {
        for (std::size_t k = 0; k < 3; ++k)
            at.now[i] +=
                static_cast<float>(up.weights[i][static_cast<Eigen::Index>(k)]) * coarser.now[idx(up.points[i][k])];
    });
    for (int sweep = 0; sweep < sweeps; ++sweep) smooth();
}

} // namespace meshtween
