#include "meshtween/fit/sample_pulls.h"

#include "meshtween/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// The pulls as fine points of the vertices, which so know the pulls that reach them.
Interpolation as_points(const std::vector<SamplePull>& pulls, const Triangles& triangles, std::ptrdiff_t vertices) {
    std::vector<std::array<int, 3>> corners(pulls.size());
    std::vector<Eigen::RowVector3d> weights(pulls.size());
    for (std::size_t k = 0; k < pulls.size(); ++k) {
        const auto f = triangles.row(pulls[k].where.triangle);
        corners[k] = {f[0], f[1], f[2]};
        weights[k] = pulls[k].where.barycentric;
    }
    return interpolation(vertices, std::move(corners), std::move(weights));
}

} // namespace

std::vector<double> bearable(const std::vector<SamplePull>& pulls, const Triangles& triangles,
                             const std::vector<double>& area, double most) {
    std::vector<double> drawn(area.size(), 0);
    for (const SamplePull& p : pulls)
        for (int k = 0; k < 3; ++k) drawn[idx(triangles(p.where.triangle, k))] += p.where.barycentric[k] * p.strength;
    for (std::size_t v = 0; v < drawn.size(); ++v)
        drawn[v] = std::min(1.0, most * area[v] / std::max(drawn[v], 1e-300));
    return drawn;
}

void add_lumped(const std::vector<SamplePull>& pulls, const std::vector<double>& shares, const Points& positions,
                const Triangles& triangles, BlockSystem& system, Points& right) {
    const Interpolation reached = as_points(pulls, triangles, positions.rows());
    parallel_for(positions.rows(), [&](std::ptrdiff_t v) {
        for (auto e = idx(reached.first[idx(v)]); e < idx(reached.first[idx(v) + 1]); ++e) {
            const SamplePull& p = pulls[idx(reached.fine[e])];
            const double weight = shares[idx(v)] * p.where.barycentric[reached.slot[e]] * p.strength;
            system.blocks[idx(v)] += weight * p.direction.transpose() * p.direction;
            right.row(v) += weight * p.direction.dot(Point(positions.row(v)) + p.way) * p.direction;
        }
    });
}

void add_together(const std::vector<SamplePull>& pulls, const std::vector<double>& shares, const Points& positions,
                  const Triangles& triangles, BlockSystem& system, Points& right) {
    system.samples.at = as_points(pulls, triangles, positions.rows());
    system.samples.directions.resize(pulls.size());
    std::vector<double> goals(pulls.size()); // along the direction
    parallel_for(std::ssize(pulls), [&](std::ptrdiff_t k) {
        const SamplePull& p = pulls[idx(k)];
        double share = 1;
        for (int c = 0; c < 3; ++c)
            if (p.where.barycentric[c] > 0) share = std::min(share, shares[idx(triangles(p.where.triangle, c))]);
        system.samples.directions[idx(k)] = std::sqrt(share * p.strength) * p.direction;
        goals[idx(k)] = system.samples.directions[idx(k)].dot(position(positions, triangles, p.where) + p.way);
    });
    const Interpolation& reached = system.samples.at;
    parallel_for(positions.rows(), [&](std::ptrdiff_t v) {
        for (auto e = idx(reached.first[idx(v)]); e < idx(reached.first[idx(v) + 1]); ++e) {
            const std::size_t k = idx(reached.fine[e]);
            right.row(v) += pulls[k].where.barycentric[reached.slot[e]] * goals[k] * system.samples.directions[k];
        }
    });
}

} // namespace meshtween
