#include "meshtween/fit/sample_pulls.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/gather.h"
#include "meshtween/geometry/measure.h"

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

using Eigen::Matrix3d;

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// What the pulls ask of one vertex.
struct Asked {
    Matrix3d own;
    std::vector<Matrix3d> beside; // one a neighbour
    Point right;
};

class PullSum {
public:
    PullSum(const std::vector<SamplePull>& pulls, const std::vector<double>& shares, double near, const Shell& shell,
            const Points& positions)
        : pulls_(pulls), shares_(shares), near_(near), shell_(shell), positions_(positions),
          of_triangle_(gather(shell.triangles.rows(), [&](const auto& put) {
              for (std::size_t k = 0; k < pulls.size(); ++k)
                  if (pulls[k].where.triangle >= 0) put(pulls[k].where.triangle, static_cast<int>(k));
          })) {}

    void at(std::ptrdiff_t v, Asked& asked) const {
        asked.own.setZero();
        asked.beside.assign(shell_.topology.neighbours[v].size(), Matrix3d::Zero());
        asked.right.setZero();
        int last = -1;
        for (const int t : shell_.topology.vertex_triangles[v]) {
            if (t == last) continue; // a triangle that has the vertex twice
            last = t;
            for (const int k : of_triangle_[t]) add(pulls_[idx(k)], v, asked);
        }
    }

private:
    void add(const SamplePull& p, std::ptrdiff_t v, Asked& asked) const {
        const auto corners = shell_.triangles.row(p.where.triangle);
        double part = 0, least = 1;
        for (int c = 0; c < 3; ++c) {
            if (corners[c] == v) part += p.where.barycentric[c];
            if (p.where.barycentric[c] > 0) least = std::min(least, shares_[idx(corners[c])]);
        }
        const bool is_near =
            p.way.squaredNorm() < near_ * near_ * triangle_area(positions_, shell_.triangles, p.where.triangle);
        const double weight = part * p.strength * (is_near ? least : shares_[idx(v)]);
        const Matrix3d block = weight * p.direction.transpose() * p.direction;
        asked.right += weight * p.direction.dot(p.way) * p.direction;
        if (!is_near) {
            asked.own += block;
            return;
        }
        const auto neighbours = shell_.topology.neighbours[v];
        for (int c = 0; c < 3; ++c) {
            const auto slot = std::lower_bound(neighbours.begin(), neighbours.end(), corners[c]) - neighbours.begin();
            (corners[c] == v ? asked.own : asked.beside[idx(slot)]) += p.where.barycentric[c] * block;
        }
    }

    const std::vector<SamplePull>& pulls_;
    const std::vector<double>& shares_;
    double near_;
    const Shell& shell_;
    const Points& positions_;
    Lists of_triangle_;
};

} // namespace

std::vector<double> bearable(const std::vector<SamplePull>& pulls, const Triangles& triangles,
                             const std::vector<double>& area, double most) {
    std::vector<double> drawn(area.size(), 0);
    for (const SamplePull& p : pulls)
        for (int k = 0; p.where.triangle >= 0 && k < 3; ++k)
            drawn[idx(triangles(p.where.triangle, k))] += p.where.barycentric[k] * p.strength;
    for (std::size_t v = 0; v < drawn.size(); ++v)
        drawn[v] = std::min(1.0, most * area[v] / std::max(drawn[v], 1e-300));
    return drawn;
}

void add_pulls(const std::vector<SamplePull>& pulls, const std::vector<double>& shares, double near, const Shell& shell,
               const Points& positions, BlockSystem& system, Points& right) {
    const PullSum sum(pulls, shares, near, shell, positions);
    const Lists& neighbours = shell.topology.neighbours;
    if (near > 0) system.couplings = {&neighbours, std::vector<SymmetricBlock>(neighbours.items.size())};
    parallel_ranges(positions.rows(), 1024, [&](std::ptrdiff_t begin, std::ptrdiff_t end) {
        Asked asked;
        for (std::ptrdiff_t v = begin; v < end; ++v) {
            sum.at(v, asked);
            system.blocks[idx(v)] += asked.own;
            right.row(v) += asked.right + positions.row(v) * asked.own;
            for (std::size_t k = 0; near > 0 && k < asked.beside.size(); ++k) {
                const std::size_t e = idx(neighbours.first[idx(v)]) + k;
                const SymmetricBlock& block = system.couplings.blocks[e] = rounded(asked.beside[k]);
                right.row(v) += times(block, Point(positions.row(neighbours.items[e])));
            }
        }
    });
}

} // namespace meshtween
