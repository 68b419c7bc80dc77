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
#include <cmath>

namespace meshtween {
namespace {

constexpr Eigen::Index least_samples = 500; // thin parts must be seen on the coarsest level already

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// What an open mesh is nearest to with its rim may lie beyond it: nothing is found for that.
ClosestPoint place_on_open(const ClosestPointIndex& index, const Shell& shell, const Point& from, const Point& normal,
                           double reach, int hint) {
    const ClosestPoint closest = index.closest(from, hint);
    const int t = closest.where.triangle;
    if (closest.squared_distance > reach * reach || index.normals().row(t).dot(normal) <= 0) return {};
    for (int k = 0; k < 3; ++k)
        if (shell.topology.on_boundary[idx(shell.triangles(t, k))]) return {};
    return closest;
}

} // namespace

void add_back_pulls(const Shell& shell, const Points& positions, const FitTarget& target, double weight, double reach,
                    RelaxMemory& memory, std::vector<Eigen::Matrix3d>& blocks, Points& right) {
    if (memory.positions)
        memory.positions->move(positions);
    else
        memory.positions = std::make_unique<ClosestPointIndex>(positions, shell.triangles, MeshIs::moving);
    const ClosestPointIndex& index = *memory.positions;
    const auto& rim = shell.topology.on_boundary;
    const bool open = std::find(rim.begin(), rim.end(), 1) != rim.end();
    const Eigen::Index all = target.positions.rows(),
                       step = std::max<Eigen::Index>(1, all / std::max<Eigen::Index>(least_samples, positions.rows()));
    std::vector<ClosestPoint> places(idx((all + step - 1) / step));
    memory.back_places.resize(places.size(), -1);
    parallel_for(
        static_cast<std::ptrdiff_t>(places.size()),
        [&](std::ptrdiff_t k) {
            const Point from = target.positions.row(k * step), normal = target.normals.row(k * step);
            int& last = memory.back_places[idx(k)];
            places[idx(k)] = open ? place_on_open(index, shell, from, normal, reach, last)
                                  : index.closest(from, Compatible{normal, 0}, reach, last);
            if (places[idx(k)].found()) last = places[idx(k)].where.triangle;
        },
        64);
    std::vector<Eigen::Matrix3d> drawn(blocks.size(), Eigen::Matrix3d::Zero());
    Points towards = Points::Zero(right.rows(), 3);
    for (std::size_t k = 0; k < places.size(); ++k) { // in order: several may reach one vertex
        const ClosestPoint& place = places[k];
        if (!place.found()) continue;
        const Eigen::Index i = static_cast<Eigen::Index>(k) * step;
        const Point normal = index.normals().row(place.where.triangle);
        const Point way = target.positions.row(i) - place.position;
        const Point direction = place.squared_distance > 1e-18 ? Point(way.normalized()) : normal;
        const double trust = std::max(0.0, normal.dot(target.normals.row(i)));
        const Eigen::Matrix3d pull =
            weight * target.area[idx(i)] * static_cast<double>(step) * trust * direction.transpose() * direction;
        for (int c = 0; c < 3; ++c) {
            const int vertex = shell.triangles(place.where.triangle, c);
            const double share = place.where.barycentric[c];
            drawn[idx(vertex)] += share * pull;
            towards.row(vertex) += share * (Point(positions.row(vertex)) + way) * pull;
        }
    }
    // No vertex is drawn harder than it clings itself: much that is uncovered must not tear at the few that are near.
    for (std::size_t v = 0; v < drawn.size(); ++v) {
        const double share = std::min(1.0, weight * shell.area[v] / std::max(drawn[v].trace(), 1e-300));
        blocks[v] += share * drawn[v];
        right.row(static_cast<Eigen::Index>(v)) += share * towards.row(static_cast<Eigen::Index>(v));
    }
}

} // namespace meshtween
