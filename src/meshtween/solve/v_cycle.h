// One multigrid V-cycle in floats: good enough to precondition a solver in doubles, at half the memory.
#pragma once

#include "meshtween/solve/block_system.h"
#include "meshtween/solve/cholesky.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <vector>

namespace meshtween {

using FloatPoint = float __attribute__((vector_size(16))); // x, y, z, 0

// A BlockSystem rounded to floats, its couplings lumped, with what a smoother needs.
struct FloatGrid {
    std::shared_ptr<const Pattern> pattern;
    std::vector<float> values;
    std::vector<std::array<FloatPoint, 3>> blocks;   // columns of the block on the diagonal, without its value
    std::vector<std::array<FloatPoint, 3>> smoother; // columns of the whole diagonal block's inverse, damped
};
FloatGrid float_grid(const BlockSystem& system);
std::array<FloatPoint, 3> float_columns(const Eigen::Matrix3d& block);

using FloatPoints = std::vector<FloatPoint>;

class VCycle {
public:
    // As for Multigrid.
    VCycle(const std::vector<BlockSystem>& systems, const std::vector<Interpolation>& interpolations,
           std::size_t offset, std::shared_ptr<const Supernodes> coarsest_factor);

    bool direct() const { return grids_.size() == 1; } // of one grid: a cycle solves it but for the rounding
    const FloatGrid& finest() const { return grids_[0]; }

    // About the solution for `right`: the same linear and symmetric operator each time. Good until the next call, and
    // not for two threads at once.
    const FloatPoints& apply(const FloatPoints& right) const;

private:
    struct Scratch {
        FloatPoints right, now, next;
    };
    void cycle(std::size_t grid) const; // from scratch_[grid].right to scratch_[grid].now

    std::vector<FloatGrid> grids_;
    const Interpolation* up_; // up_[k] leads from grid k + 1 to grid k
    SparseCholesky coarsest_;
    mutable std::vector<Scratch> scratch_;
};

// A block on the diagonal, or its inverse, times a point; and a row of the system times points.
inline FloatPoint times(const std::array<FloatPoint, 3>& columns, const FloatPoint& x) {
    return columns[0] * x[0] + columns[1] * x[1] + columns[2] * x[2];
}
inline FloatPoint times(const SymmetricBlock& block, const FloatPoint& x) {
    static_assert(sizeof block == 24 && offsetof(SymmetricBlock, zz) == 8);
    FloatPoint diagonal, beside; // xx yy zz -, - xy yz zx; what is not meant meets the nought in x
    std::memcpy(&diagonal, &block.xx, sizeof diagonal);
    std::memcpy(&beside, &block.zz, sizeof beside);
    return diagonal * x +
           __builtin_shufflevector(beside, beside, 1, 2, 3, 3) * __builtin_shufflevector(x, x, 1, 2, 0, 3) +
           __builtin_shufflevector(beside, beside, 3, 1, 2, 3) * __builtin_shufflevector(x, x, 2, 0, 1, 3);
}
inline FloatPoint row_times(const FloatGrid& grid, const FloatPoints& x, std::size_t i) {
    FloatPoint sum = times(grid.blocks[i], x[i]);
    const auto end = static_cast<std::size_t>(grid.pattern->first[i + 1]);
    for (auto e = static_cast<std::size_t>(grid.pattern->first[i]); e < end; ++e)
        sum += grid.values[e] * x[static_cast<std::size_t>(grid.pattern->column[e])];
    return sum;
}

} // namespace meshtween
