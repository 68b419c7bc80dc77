// One multigrid V-cycle in floats: good enough to precondition a solver in doubles, at half the memory.
#pragma once

#include "meshtween/solve/block_system.h"

#include <Eigen/SparseCholesky>

#include <array>
#include <memory>
#include <vector>

namespace meshtween {

using FloatPoint = float __attribute__((vector_size(16))); // x, y, z, 0

// A BlockSystem rounded to floats, with what a smoother needs.
struct FloatGrid {
    std::shared_ptr<const Pattern> pattern;
    std::vector<float> values;
    std::vector<std::array<FloatPoint, 3>> blocks;   // columns of the block on the diagonal, without its value
    std::vector<std::array<FloatPoint, 3>> smoother; // columns of the whole diagonal block's inverse, damped
};
FloatGrid float_grid(const BlockSystem& system);

class VCycle {
public:
    // As for Multigrid, of two systems at least.
    VCycle(const std::vector<BlockSystem>& systems, const std::vector<Interpolation>& interpolations,
           std::size_t offset);

    // z: about the solution for `right`, the same linear and symmetric operator each time. n x 3. Not from two threads
    // at once.
    void apply(const Points& right, Points& z) const;

private:
    using Vector = std::vector<FloatPoint>;
    struct Scratch {
        Vector right, now, next;
    };
    void cycle(std::size_t grid) const; // from scratch_[grid].right to scratch_[grid].now

    std::vector<FloatGrid> grids_; // without the coarsest
    const Interpolation* up_;      // up_[k] leads from grid k + 1 to grid k
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> coarsest_;
    mutable std::vector<Scratch> scratch_;
};

} // namespace meshtween
