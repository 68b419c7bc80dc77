// The distance is summed over the surface by the rule with seven points a triangle that is exact for cubics: Strang,
// Fix, An analysis of the finite element method, 1973. Point to plane: Chen, Medioni, IVC 1992.
#include "meshtween/fit/lift.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/facing.h"
#include "meshtween/fit/renumber.h"
#include "meshtween/geometry/measure.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace meshtween {
namespace {

constexpr double at_corner = 1.0 / 20, at_middle = 2.0 / 15, at_centre = 9.0 / 20; // of a triangle's area
constexpr double reach = 0.25;       // of an edge: what lies further off is not missed by flatness alone
constexpr double least_cosine = 0.5; // between normals, the mesh's and the target's
constexpr double least_facing = 0.1; // between a triangle and the target after it, so that none comes to look away
constexpr double farthest = 0.1;     // of a vertex's shortest edge: how far it may move
constexpr double least_kept = 0.9;   // cosine between a triangle's normals before and after
constexpr int iterations = 12;

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// A point of the mesh, the mean of some vertices, and how far and in which direction it lies from the target.
struct Gap {
    Point normal{0, 0, 0}; // of the target; zero: nothing there
    double height = 0;     // from the mesh to the target, along it
    int place = -1;        // the target's triangle
};

Gap gap(const Point& at, const Point& normal, double length, const FitTarget& target) {
    const ClosestPoint there = target.index.closest(at, {normal, least_cosine}, reach * length);
    if (!there.found() || on_border(target, there.where)) return {};
    const Point facing = normal_at(target, there.where);
    return {facing, facing.dot(there.position - at), there.where.triangle};
}

// matrix moves = right for the moves of vertices along their normals; entries off the diagonal in the order of the
// neighbours.
struct System {
    const Lists& neighbours;
    Eigen::VectorXd diagonal, right;
    std::vector<double> off;

    System(const Lists& lists, Eigen::Index n)
        : neighbours(lists), diagonal(Eigen::VectorXd::Zero(n)), right(Eigen::VectorXd::Zero(n)),
          off(lists.items.size(), 0) {}

    void add(const Gap& gap, std::span<const int> vertices, const Points& normals, double weight) {
        const double share = 1 / static_cast<double>(vertices.size());
        const auto part = [&](int v) { return share * gap.normal.dot(normals.row(v)); };
        for (const int i : vertices) {
            right[i] += weight * part(i) * gap.height;
            diagonal[i] += weight * part(i) * part(i);
            const auto list = neighbours[i];
            for (const int j : vertices)
                if (j != i)
                    off[idx(neighbours.first[idx(i)] + (std::lower_bound(list.begin(), list.end(), j) -
                                                        list.begin()))] += weight * part(i) * part(j);
        }
    }

    Eigen::VectorXd times(const Eigen::VectorXd& x) const {
        Eigen::VectorXd result(x.size());
        parallel_for(x.size(), [&](std::ptrdiff_t i) {
            double sum = diagonal[i] * x[i];
            for (int e = neighbours.first[idx(i)]; e < neighbours.first[idx(i) + 1]; ++e)
                sum += off[idx(e)] * x[neighbours.items[idx(e)]];
            result[i] = sum;
        });
        return result;
    }
};

// Conjugate gradients; the matrix is as well conditioned as a mass matrix.
Eigen::VectorXd solve(const System& system) {
    const auto n = system.right.size();
    const Eigen::VectorXd inverse = system.diagonal.unaryExpr([](double d) { return d > 0 ? 1 / d : 0; });
    const auto dot = [&](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
        return parallel_sum(n, 0.0, [&](std::ptrdiff_t i) { return a[i] * b[i]; });
    };
    Eigen::VectorXd x = Eigen::VectorXd::Zero(n), r = system.right, z = inverse.cwiseProduct(r), p = z;
    double rz = dot(r, z);
    for (int k = 0; k < iterations && rz > 0; ++k) {
        const Eigen::VectorXd q = system.times(p);
        const double step = rz / dot(p, q);
        x += step * p;
        r -= step * q;
        z = inverse.cwiseProduct(r);
        const double next = dot(r, z);
        p = z + next / rz * p;
        rz = next;
    }
    return x;
}

// The mesh beside the target, at the centre of each triangle and the middle of each edge.
struct Gaps {
    std::vector<Gap> centres, middles;
};

Gaps gaps(const Points& x, const Points& normals, const Triangles& triangles, const Topology& topology,
          const FitTarget& target) {
    Gaps result{std::vector<Gap>(idx(triangles.rows())), std::vector<Gap>(topology.edges.size())};
    parallel_for(
        triangles.rows(),
        [&](std::ptrdiff_t t) {
            const Point a = x.row(triangles(t, 0)), b = x.row(triangles(t, 1)), c = x.row(triangles(t, 2));
            const Point area = (b - a).cross(c - a);
            const double length = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
            if (area.norm() > 0) result.centres[idx(t)] = gap((a + b + c) / 3, area.normalized(), length, target);
        },
        64);
    parallel_for(
        std::ssize(topology.edges),
        [&](std::ptrdiff_t e) {
            const auto [i, j] = topology.edges[idx(e)].vertices;
            const Point normal = (normals.row(i) + normals.row(j)).normalized();
            result.middles[idx(e)] = gap((x.row(i) + x.row(j)) / 2, normal, (x.row(i) - x.row(j)).norm(), target);
        },
        64);
    return result;
}

System system_of(const Points& x, const Points& normals, const Triangles& triangles, const Topology& topology,
                 const Gaps& gaps) {
    System system(topology.neighbours, x.rows());
    std::vector<double> areas(idx(triangles.rows()));
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
        const double area = areas[idx(t)] = double_area_normal(x, triangles, t).norm();
        const std::array<int, 3> corners{triangles(t, 0), triangles(t, 1), triangles(t, 2)};
        system.add(gaps.centres[idx(t)], corners, normals, at_centre * area);
        for (const int i : corners) system.diagonal[i] += at_corner * area; // they lie where they should
    }
    for (std::size_t e = 0; e < gaps.middles.size(); ++e)
        for (const int t : topology.edges[e].triangles)
            if (t >= 0) system.add(gaps.middles[e], topology.edges[e].vertices, normals, at_middle * areas[idx(t)]);
    return system;
}

// A triangle that has nothing to lie on, or that would turn: slivers do at a touch.
bool is_spoilt(const Gap& centre, const Point& before, const Point& now) {
    return now != before && (now.dot(before) < least_kept * now.norm() * before.norm() ||
                             now.dot(centre.normal) < least_facing * now.norm());
}

// Triangles that look into the target, of which a corner is elsewhere than before and which did not before.
std::vector<int> turned(const Points& before, const Points& now, const Triangles& triangles, const FitTarget& target,
                        FacingWatch& watch) {
    std::vector<int> result;
    for (const int t : watch.into(now)) {
        bool moved = false;
        for (int k = 0; k < 3; ++k) moved = moved || now.row(triangles(t, k)) != before.row(triangles(t, k));
        if (moved && facing_into(before, triangles.row(t), target).empty()) result.push_back(t);
    }
    return result;
}

} // namespace

Points lifted(const Points& positions, const Triangles& triangles, const Topology& topology, const FitTarget& target) {
    const Points normals = vertex_normals(positions, triangles);
    const Gaps beside = gaps(positions, normals, triangles, topology, target);
    Eigen::VectorXd moves = solve(system_of(positions, normals, triangles, topology, beside));
    parallel_for(moves.size(), [&](std::ptrdiff_t i) {
        double shortest = std::numeric_limits<double>::infinity();
        for (const int j : topology.neighbours[i])
            shortest = std::min(shortest, (positions.row(i) - positions.row(j)).norm());
        moves[i] = std::clamp(moves[i], -farthest * shortest, farthest * shortest);
    });
    Points result = positions + moves.asDiagonal() * normals;
    std::vector<int> places;
    for (const Gap& centre : beside.centres) places.push_back(centre.place);
    FacingWatch watch(triangles, target, EdgeSides::both, std::move(places));
    const auto spoilt = [&] {
        std::vector<int> list;
        for (Eigen::Index t = 0; t < triangles.rows(); ++t)
            if (is_spoilt(beside.centres[idx(t)], double_area_normal(positions, triangles, t),
                          double_area_normal(result, triangles, t)))
                list.push_back(static_cast<int>(t));
        return list.empty() ? turned(positions, result, triangles, target, watch) : list;
    };
    for (std::vector<int> ill = spoilt(); !ill.empty(); ill = spoilt())
        for (const int t : ill)
            for (int k = 0; k < 3; ++k) result.row(triangles(t, k)) = positions.row(triangles(t, k));
    return result;
}

Points lifted(const Mesh& fitted_mesh, const Mesh& target_mesh) {
    // Sums run in the order of places, so that how files number their vertices changes nothing.
    const Renumbered fitted = renumbered(fitted_mesh.positions, fitted_mesh.triangles),
                     target = renumbered(target_mesh.positions, target_mesh.triangles);
    const Point centre = target.positions.colwise().mean();
    const double size = diagonal(target.positions, target.triangles);
    const Points x = (fitted.positions.rowwise() - centre) / size;
    const FitTarget surface = fit_target((target.positions.rowwise() - centre) / size, target.triangles);
    const Points y = lifted(x, fitted.triangles, topology(x.rows(), fitted.triangles), surface);
    return as_before(fitted.vertex, (y * size).rowwise() + centre);
}

} // namespace meshtween
