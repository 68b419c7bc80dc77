// A mesh may lie on a surface and yet leave parts of it uncovered: a tail, an ear. Only the target can tell, by asking
// for the mesh.
//
// White, Ortega-Castrillon, Matthews, Zaidi, Ekrami, Snyders, Fan, Penington, Van Dongen, Shriver, Claes: MeshMonk:
// Open-source large-scale intensive 3D phenotyping. Scientific Reports 2019 (correspondences both ways).
#include "meshtween/fit/back_pulls.h"

#include "meshtween/core/parallel.h"
#include "meshtween/search/closest_point.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace meshtween {
namespace {

constexpr Eigen::Index most_samples = 2;    // a triangle of the mesh
constexpr Eigen::Index least_samples = 500; // thin parts must be seen on the coarsest level already

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// What an open mesh is nearest to with its rim may lie beyond it: nothing is found for that.
ClosestPoint place_on_open(const ClosestPointIndex& index, const Shell& shell, const Point& from, const Point& normal,
                           double reach, int hint) {
    ClosestPoint closest = index.closest(from, hint);
    const int t = closest.where.triangle;
    if (closest.squared_distance > reach * reach || index.normals().row(t).dot(normal) <= 0) return {};
    for (int k = 0; k < 3; ++k)
        if (shell.topology.on_boundary[idx(shell.triangles(t, k))]) return {};
    return closest;
}

// One of `count`, as if by chance: the same one of any such group would prefer a side, for a fine mesh repeats itself.
//
// Steele, Lea, Flood: Fast splittable pseudorandom number generators. OOPSLA 2014 (SplitMix).
Eigen::Index chosen(std::ptrdiff_t group, int round, Eigen::Index count) {
    auto z = static_cast<std::uint64_t>(group) + (static_cast<std::uint64_t>(round) << 32) + 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return static_cast<Eigen::Index>((z ^ z >> 31) % static_cast<std::uint64_t>(count));
}

double mean_edge(const Shell& shell, const Points& positions) {
    const double sum = parallel_sum(std::ssize(shell.topology.edges), 0.0, [&](std::ptrdiff_t e) {
        const auto [i, j] = shell.topology.edges[idx(e)].vertices;
        return (positions.row(i) - positions.row(j)).norm();
    });
    return sum / static_cast<double>(std::max<std::size_t>(1, shell.topology.edges.size()));
}

} // namespace

std::vector<SamplePull> back_pulls(const Shell& shell, const Points& positions, const FitTarget& target, double weight,
                                   double reach, int round, RelaxMemory& memory) {
    const ClosestPointIndex& index = *memory.mesh;
    const auto& rim = shell.topology.on_boundary;
    const bool open = std::find(rim.begin(), rim.end(), 1) != rim.end();
    const Eigen::Index all = target.positions.rows(),
                       step = std::max<Eigen::Index>(
                           1, all / std::max(least_samples, most_samples * shell.triangles.rows()));
    const double edge = mean_edge(shell, positions);
    std::vector<SamplePull> pulls(idx((all + step - 1) / step));
    memory.back_places.resize(pulls.size(), -1);
    parallel_for(
        std::ssize(pulls),
        [&](std::ptrdiff_t k) {
            const Eigen::Index group = std::min(step, all - k * step), i = k * step + chosen(k, round, group);
            const Point from = target.positions.row(i), normal = target.normals.row(i);
            int& last = memory.back_places[idx(k)];
            const ClosestPoint place = open ? place_on_open(index, shell, from, normal, reach, last)
                                            : index.closest(from, Compatible{normal, 0}, reach, last);
            if (!place.found()) return;
            last = place.where.triangle;
            double area = 0;
            for (Eigen::Index j = 0; j < group; ++j) area += target.area[idx(k * step + j)];
            const Point facing = index.normals().row(last), way = from - place.position;
            const double strength = 1 + (weight - 1) * std::min(1.0, place.squared_distance / (edge * edge));
            pulls[idx(k)] = {place.where, way, place.squared_distance > 1e-18 ? Point(way.normalized()) : facing,
                             strength * area * std::max(0.0, facing.dot(normal))};
        },
        64);
    return pulls;
}

} // namespace meshtween
