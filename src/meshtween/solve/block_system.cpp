// Conjugate gradients with a geometric multigrid V-cycle (v_cycle).
//
// Tatebe: The multigrid preconditioned conjugate gradient method. 1993.
#include "meshtween/solve/block_system.h"

#include "meshtween/core/parallel.h"
#include "meshtween/solve/v_cycle.h"

#include <algorithm>
#include <numeric>

namespace meshtween {
namespace {

using Eigen::Matrix3d;

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

// visit(neighbour, block) for all that is coupled with a point.
template <typename Visit>
void each_coupling(const Couplings& couplings, std::ptrdiff_t i, const Visit& visit) {
    if (couplings.empty()) return;
    const Lists& lists = *couplings.neighbours;
    const auto end = static_cast<std::size_t>(lists.first[static_cast<std::size_t>(i) + 1]);
    for (auto e = static_cast<std::size_t>(lists.first[static_cast<std::size_t>(i)]); e < end; ++e)
        visit(lists.items[e], couplings.blocks[e]);
}

} // namespace

std::size_t Pattern::at(int row, int col) const {
    const auto begin = column.begin() + first[static_cast<std::size_t>(row)];
    const auto end = column.begin() + first[static_cast<std::size_t>(row) + 1];
    return static_cast<std::size_t>(std::lower_bound(begin, end, col) - column.begin());
}

Pattern pattern(Lists rows) {
    const std::ptrdiff_t n = rows.size();
    Pattern result;
    result.first.assign(static_cast<std::size_t>(n) + 1, 0);
    const auto row = [&](std::ptrdiff_t i) { return rows.items.begin() + rows.first[static_cast<std::size_t>(i)]; };
    parallel_for(n, [&](std::ptrdiff_t i) {
        std::sort(row(i), row(i + 1));
        result.first[static_cast<std::size_t>(i) + 1] = static_cast<int>(std::unique(row(i), row(i + 1)) - row(i));
    });
    std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
    result.column.resize(static_cast<std::size_t>(result.first.back()));
    result.diagonal.resize(static_cast<std::size_t>(n));
    parallel_for(n, [&](std::ptrdiff_t i) {
        const int begin = result.first[static_cast<std::size_t>(i)],
                  end = result.first[static_cast<std::size_t>(i) + 1];
        std::copy_n(row(i), end - begin, result.column.begin() + begin);
        result.diagonal[static_cast<std::size_t>(i)] =
            static_cast<int>(result.at(static_cast<int>(i), static_cast<int>(i)));
    });
    return result;
}

SymmetricBlock rounded(const Matrix3d& block) {
    const auto at = [&](int row, int column) { return static_cast<float>(block(row, column)); };
    return {at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(1, 2), at(0, 2)};
}

Point times(const SymmetricBlock& b, const Point& x) {
    return {b.xx * x[0] + b.xy * x[1] + b.zx * x[2], b.xy * x[0] + b.yy * x[1] + b.yz * x[2],
            b.zx * x[0] + b.yz * x[1] + b.zz * x[2]};
}

Points apply(const BlockSystem& system, const Points& x) {
    Points y(x.rows(), 3);
    parallel_for(x.rows(), [&](std::ptrdiff_t i) {
        Point row = row_times(system, x, i);
        each_coupling(system.couplings, i,
                      [&](int j, const SymmetricBlock& block) { row += times(block, Point(x.row(j))); });
        y.row(i) = row;
    });
    return y;
}

Matrix3d lumped_block(const BlockSystem& system, std::ptrdiff_t i) {
    Matrix3d sum = system.blocks[static_cast<std::size_t>(i)];
    each_coupling(system.couplings, i, [&](int, const SymmetricBlock& b) {
        const Eigen::Matrix3f block{{b.xx, b.xy, b.zx}, {b.xy, b.yy, b.yz}, {b.zx, b.yz, b.zz}};
        sum += block.cast<double>();
    });
    return sum;
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

std::vector<Matrix3d> to_coarse(const Interpolation& interpolation, const BlockSystem& fine) {
    std::vector<Matrix3d> coarse(interpolation.first.size() - 1, Matrix3d::Zero());
    parallel_for(static_cast<std::ptrdiff_t>(coarse.size()), [&](std::ptrdiff_t c) {
        const auto i = static_cast<std::size_t>(c);
        for (auto e = static_cast<std::size_t>(interpolation.first[i]);
             e < static_cast<std::size_t>(interpolation.first[i + 1]); ++e) {
            const int from = interpolation.fine[e];
            coarse[i] +=
                interpolation.weights[static_cast<std::size_t>(from)][interpolation.slot[e]] * lumped_block(fine, from);
        }
    });
    return coarse;
}

struct Multigrid::Data {
    VCycle cycle;
    BlockSystem finest;
    Data(std::vector<BlockSystem> systems, const std::vector<Interpolation>& interpolations, std::size_t offset,
         std::shared_ptr<const Supernodes> coarsest_factor)
        : cycle(systems, interpolations, offset, std::move(coarsest_factor)), finest(std::move(systems[0])) {}
};

namespace {

constexpr int sweeps_a_cycle = 6; // of Jacobi, in time

// Conjugate gradients in floats, from x = 0 on; with another preconditioner they start anew from where they are.
class Gradients {
public:
    Gradients(const VCycle& cycle, const Couplings& couplings, FloatPoints right)
        : cycle_(cycle), grid_(cycle.finest()), couplings_(couplings), r_(std::move(right)), x_(r_.size()),
          z_(r_.size()), p_(r_.size()), q_(r_.size()) {}
    const FloatPoints& x() const { return x_; }

    struct Run {
        int iterations = 0;
        double gain = 0; // by which x came closer to the solution, in the squared norm that the system makes
    };
    // Until the residual's squared norm (preconditioned) is under `tolerance` of what it is now.
    Run run(bool with_cycle, int iterations, double tolerance) {
        Run done;
        double rz = precondition(with_cycle);
        const double enough = tolerance * rz;
        p_ = z_;
        while (done.iterations < iterations && rz > enough && rz > 0) {
            const double pq = sum([&](std::size_t i) {
                q_[i] = times_p(i);
                return product(p_[i], q_[i]);
            });
            if (!(pq > 0)) break;
            const double alpha = rz / pq;
            const auto step = static_cast<float>(alpha);
            done.gain += alpha * rz;
            ++done.iterations;
            each([&](std::size_t i) {
                x_[i] += step * p_[i];
                r_[i] -= step * q_[i];
            });
            const double next = precondition(with_cycle);
            const auto beta = static_cast<float>(next / rz);
            each([&](std::size_t i) { p_[i] = z_[i] + beta * p_[i]; });
            rz = next;
        }
        return done;
    }

private:
    static double product(const FloatPoint& a, const FloatPoint& b) {
        const FloatPoint c = a * b;
        return double{c[0]} + c[1] + c[2];
    }
    template <typename Term>
    double sum(const Term& term) const {
        return parallel_sum(std::ssize(r_), 0.0, [&](std::ptrdiff_t i) { return term(static_cast<std::size_t>(i)); });
    }
    template <typename Body>
    void each(const Body& body) const {
        parallel_for(
            std::ssize(r_), [&](std::ptrdiff_t i) { body(static_cast<std::size_t>(i)); }, 4096);
    }
    double precondition(bool with_cycle) {
        if (with_cycle) {
            z_ = cycle_.apply(r_);
            return sum([&](std::size_t i) { return product(r_[i], z_[i]); });
        }
        return sum([&](std::size_t i) {
            z_[i] = times(grid_.smoother[i], r_[i]);
            return product(r_[i], z_[i]);
        });
    }

    // Row i of the system times p. The grid holds what couples points as if they moved alike: here is what they do not.
    FloatPoint times_p(std::size_t i) const {
        FloatPoint result = row_times(grid_, p_, i);
        each_coupling(couplings_, static_cast<std::ptrdiff_t>(i), [&](int j, const SymmetricBlock& block) {
            result += times(block, p_[static_cast<std::size_t>(j)] - p_[i]);
        });
        return result;
    }

    const VCycle& cycle_;
    const FloatGrid& grid_;
    const Couplings& couplings_;
    FloatPoints r_, x_, z_, p_, q_;
};

// The cycle is worth its time where coarser grids tell what the finest one does; between long thin triangles, or where
// the coarser mesh bends otherwise, Jacobi's steps alone come further. A trial of both says which.
int run(Gradients& gradients, int cycles, double tolerance) {
    constexpr int trial = 2;
    int steps = gradients.run(false, trial * sweeps_a_cycle, tolerance).iterations; // what is local, in any case
    const Gradients::Run cycle = gradients.run(true, trial, tolerance),
                         jacobi = gradients.run(false, trial * sweeps_a_cycle, tolerance);
    steps += cycle.iterations + jacobi.iterations;
    const bool with_cycle = cycle.gain > jacobi.gain;
    const int left = std::max(0, cycles - 3 * trial);
    return steps + gradients.run(with_cycle, with_cycle ? left : left * sweeps_a_cycle, tolerance).iterations;
}

} // namespace

Multigrid::Multigrid(std::vector<BlockSystem> systems, const std::vector<Interpolation>& interpolations,
                     std::size_t offset, std::shared_ptr<const Supernodes> coarsest_factor)
    : data_(std::make_unique<Data>(std::move(systems), interpolations, offset, std::move(coarsest_factor))) {}

Multigrid::~Multigrid() = default;
Multigrid::Multigrid(Multigrid&&) noexcept = default;

int Multigrid::solve(const Points& right, Points& x, int cycles, double tolerance) const {
    const VCycle& cycle = data_->cycle;
    int iterations = 0;
    constexpr int refinements = 3; // a cycle of one grid leaves 1e-7 each time
    const bool direct = cycle.direct() && data_->finest.couplings.empty();
    for (int k = 0; k < (direct ? refinements : 1); ++k) {
        const Points left = right - apply(data_->finest, x);
        FloatPoints residual(static_cast<std::size_t>(x.rows()));
        parallel_for(x.rows(), [&](std::ptrdiff_t i) {
            for (int c = 0; c < 3; ++c) residual[static_cast<std::size_t>(i)][c] = static_cast<float>(left(i, c));
        });
        Gradients gradients(cycle, data_->finest.couplings, std::move(residual));
        if (cycle.direct())
            iterations += gradients.run(true, direct ? 1 : cycles, direct ? 0 : tolerance * tolerance).iterations;
        else
            iterations += run(gradients, cycles, tolerance * tolerance);
        parallel_for(x.rows(), [&](std::ptrdiff_t i) {
            for (int c = 0; c < 3; ++c) x(i, c) += double{gradients.x()[static_cast<std::size_t>(i)][c]};
        });
    }
    return iterations;
}

} // namespace meshtween
