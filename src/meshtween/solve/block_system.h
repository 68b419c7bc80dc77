// Symmetric systems over points: scalars between vertices, full 3 x 3 blocks on the diagonal and, where there are
// couplings, between neighbours.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/geometry/topology.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace meshtween {

// Where a symmetric n x n matrix has entries, row by row, columns ascending; every row has its diagonal.
struct Pattern {
    std::vector<int> first{0}, column;
    std::vector<int> diagonal; // n: where entry (i, i) stands in `column`
    std::ptrdiff_t size() const { return static_cast<std::ptrdiff_t>(first.size()) - 1; }
    std::size_t at(int row, int col) const; // the entry must exist
};

// Columns, a list a row with its diagonal among them, sorted and rid of doubles.
Pattern pattern(Lists rows);

// Values on a coarse set of points, and what they are on a finer one: fine_i = sum_k weight_ik coarse_(point_ik).
struct Interpolation {
    std::vector<std::array<int, 3>> points; // a row a fine point
    std::vector<Eigen::RowVector3d> weights;
    std::vector<int> first{0}, fine, slot; // of each coarse point: the fine points that it reaches
};

// In floats, for there are many; in the order in which v_cycle.h loads them.
struct SymmetricBlock {
    float xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
};
SymmetricBlock rounded(const Eigen::Matrix3d& block);
Point times(const SymmetricBlock& block, const Point& x);

// Full blocks beside the diagonal, block (i, j) the same as block (j, i) but for roundings.
struct Couplings {
    const Lists* neighbours = nullptr;  // of each point, ascending; must outlive this
    std::vector<SymmetricBlock> blocks; // one an item of the lists
    bool empty() const { return blocks.empty(); }
};

// Block (i, j) is values(i, j) times the identity, plus blocks[i] where i = j, plus what couples i and j.
struct BlockSystem {
    std::shared_ptr<const Pattern> pattern;
    std::vector<double> values;          // one an entry of the pattern
    std::vector<Eigen::Matrix3d> blocks; // n, symmetric
    Couplings couplings;                 // or none
};

Points apply(const BlockSystem& system, const Points& x); // n x 3: the matrix times x

// The lists of what each coarse point reaches are made from `points`, a row a fine point.
Interpolation interpolation(std::ptrdiff_t coarse_count, std::vector<std::array<int, 3>> points,
                            std::vector<Eigen::RowVector3d> weights);
// blocks[i] and all that couples i with others, as if they moved alike. Where couplings come of squares of weighted
// means (weights not negative), the system is never less with these blocks alone, to the rounding of floats.
Eigen::Matrix3d lumped_block(const BlockSystem& system, std::ptrdiff_t i);

// The blocks of a coarser system: each fine one, lumped, shared out by its weights (the transpose, lumped).
std::vector<Eigen::Matrix3d> to_coarse(const Interpolation& interpolation, const BlockSystem& fine);

struct Supernodes;

// Where the factor of systems with this pattern has entries: found once for many.
std::shared_ptr<const Supernodes> factor_pattern(std::shared_ptr<const Pattern> pattern);

// One system on several grids, finest first, prepared to be solved.
class Multigrid {
public:
    // interpolations[k] leads from grid k + 1 to grid k and must outlive this. Only the finest may have couplings. The
    // coarsest is factorised; `coarsest_factor` is factor_pattern's of its pattern, or none. Throws Error(computation)
    // where that one is not positive definite.
    Multigrid(std::vector<BlockSystem> systems, const std::vector<Interpolation>& interpolations, std::size_t offset,
              std::shared_ptr<const Supernodes> coarsest_factor = nullptr);
    ~Multigrid();
    Multigrid(Multigrid&&) noexcept;

    // Conjugate gradients in floats, from x on, until what a residual is left has fallen by `tolerance` or for about as
    // long as `cycles` V-cycles take; the preconditioner is a V-cycle or Jacobi's step, whichever comes further. How
    // many steps it took. The same bits for any number of threads.
    int solve(const Points& right, Points& x, int cycles, double tolerance) const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

} // namespace meshtween
