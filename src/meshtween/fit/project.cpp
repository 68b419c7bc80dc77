// Projection to the closest compatible point (the dist() of Eq. 7): compatible in normal, and in side at boundaries
// (Turk and Levoy 1994, Zippered polygon meshes: points whose nearest is a boundary are not matched). Steps shrink by
// halves, for all triangles at once, until none turns over.
#include "meshtween/fit/project.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

using Eigen::Index;

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

// The corner of t from which the boundary edge a-b starts, in the triangle's own direction.
int starting_corner(const Triangles& triangles, int t, const Edge& edge) {
    for (int k = 0; k < 3; ++k)
        if (std::minmax(triangles(t, k), triangles(t, (k + 1) % 3)) == std::minmax(edge.vertices[0], edge.vertices[1]))
            return k;
    return 0;
}

// In triangle t's plane, square to its edge k, away from the third corner. Zero without area.
Point outward(const Points& positions, const Triangles& triangles, int t, int k) {
    const Point along = positions.row(triangles(t, (k + 1) % 3)) - positions.row(triangles(t, k));
    return along.cross(double_area_normal(positions, triangles, t)).normalized();
}

bool hits_rim(const TargetSurface& target, const SurfacePoint& where) {
    constexpr double nil = 1e-9;
    const int t = where.triangle;
    for (int k = 0; k < 3; ++k) {
        if (where.barycentric[(k + 2) % 3] > nil) continue; // not on the edge from k to k + 1
        if (target.rim_side[at(t)] >> k & 1) return true;
        for (const int corner : {k, (k + 1) % 3})
            if (where.barycentric[corner] > 1 - nil && target.on_rim[at(target.mesh.triangles(t, corner))]) return true;
    }
    return false;
}

// The direction away from the mesh at a boundary vertex: the sum over its boundary edges. Zero where it has none.
Points rim_directions(const Points& positions, const Triangles& triangles, const Topology& top) {
    Points sum = Points::Zero(positions.rows(), 3);
    for (const Edge& edge : top.edges) {
        if (edge.count != 1) continue;
        const Point out =
            outward(positions, triangles, edge.triangles[0], starting_corner(triangles, edge.triangles[0], edge));
        for (const int v : edge.vertices) sum.row(v) += out;
    }
    for (Index i = 0; i < sum.rows(); ++i) sum.row(i) = Point(sum.row(i)).normalized(); // zero stays zero
    return sum;
}

constexpr double least_cosine = 0.02; // of a triangle after a step, to the direction in which it should look
constexpr double least_area = 0.01;   // of what it had before the step

// The direction in which each triangle looks and must go on looking, unit; zero for triangles that are free.
Points directions_to_keep(const Points& positions, const Points& normals, const Triangles& triangles) {
    Points keep(triangles.rows(), 3);
    parallel_for(triangles.rows(), [&](Index t) {
        Point want = normals.row(triangles(t, 0)) + normals.row(triangles(t, 1)) + normals.row(triangles(t, 2));
        const Point now = double_area_normal(positions, triangles, t);
        if (want.isZero(1e-6)) want = now;
        keep.row(t).setZero();
        if (now.dot(want) > least_cosine * want.norm() * now.norm()) keep.row(t) = want.normalized();
    });
    return keep;
}

} // namespace

TargetSurface target_surface(const Points& positions, const Triangles& triangles) {
    TargetSurface target{{positions, triangles, {}, {}, {}},
                         diagonal(positions, triangles),
                         std::sqrt(surface_area(positions, triangles)),
                         ClosestPointIndex(positions, triangles),
                         {},
                         {},
                         {},
                         {},
                         {},
                         {}};
    const Topology top = topology(positions.rows(), triangles);
    target.on_rim = top.on_boundary;
    target.rim_side.assign(at(triangles.rows()), 0);
    const auto rim_count =
        std::count_if(top.edges.begin(), top.edges.end(), [](const Edge& e) { return e.count == 1; });
    target.rim_edges.resize(rim_count, 3);
    target.rim_outward.resize(rim_count, 3);
    Index row = 0;
    for (const Edge& edge : top.edges) {
        if (edge.count != 1) continue;
        const int t = edge.triangles[0], k = starting_corner(triangles, t, edge);
        target.rim_side[at(t)] = static_cast<char>(target.rim_side[at(t)] | 1 << k);
        target.rim_triangle.push_back(t);
        target.rim_edges.row(row) << edge.vertices[0], edge.vertices[1], edge.vertices[1];
        target.rim_outward.row(row++) = outward(positions, triangles, t, k);
    }
    if (target.rim_edges.rows() > 0) target.rim.emplace(positions, target.rim_edges);
    return target;
}

Goals closest_compatible(const Points& positions, const Triangles& triangles, const Surroundings& around,
                         const TargetSurface& target, const std::vector<char>& attached, const GoalOptions& options,
                         const std::vector<int>& hints) {
    const Points own_normals = vertex_normals(positions, triangles);
    const double reach = options.reach * target.size;
    Goals goals{positions, Points::Zero(positions.rows(), 3), std::vector<int>(at(positions.rows()), -1)};
    parallel_for(
        positions.rows(),
        [&](Index i) {
            if (around.topology.vertex_triangles[i].empty()) return;
            if (attached[at(i)]) {
                const ClosestPoint edge = target.rim->closest(positions.row(i), Compatible{}, reach);
                if (!edge.found()) return;
                goals.positions.row(i) = edge.position;
                goals.triangles[at(i)] = target.rim_triangle[at(edge.where.triangle)];
            } else {
                const Compatible compatible{own_normals.row(i), options.least_cosine};
                const ClosestPoint hit =
                    target.index.closest(positions.row(i), compatible, reach, hints.empty() ? -1 : hints[at(i)]);
                if (!hit.found() || (target.rim && hits_rim(target, hit.where))) return;
                goals.positions.row(i) = hit.position;
                goals.triangles[at(i)] = hit.where.triangle;
            }
            goals.normals.row(i) = target.index.normals().row(goals.triangles[at(i)]);
        },
        256);
    return goals;
}

std::vector<char> attached_boundary(const Points& positions, const Triangles& triangles, const Surroundings& around,
                                    const TargetSurface& target, double near) {
    std::vector<char> attached(at(positions.rows()), 0);
    if (!target.rim) return attached;
    const Points directions = rim_directions(positions, triangles, around.topology);
    for (const std::vector<int>& loop : boundary_loops(triangles, around.topology)) {
        const auto belongs = [&](int v) {
            const ClosestPoint edge = target.rim->closest(positions.row(v), Compatible{}, near * target.size);
            return edge.found() && target.rim_outward.row(edge.where.triangle).dot(directions.row(v)) > 0;
        };
        if (2 * std::count_if(loop.begin(), loop.end(), belongs) < static_cast<std::ptrdiff_t>(loop.size())) continue;
        for (const int v : loop) attached[at(v)] = 1;
    }
    return attached;
}

GuardedStep guarded_step(const Points& from, const Points& to, const Points& normals, const Triangles& triangles) {
    constexpr double shortest = 1.0 / 16; // of a step; after that a vertex stays
    const Points keep = directions_to_keep(from, normals, triangles);
    std::vector<double> part(at(from.rows()), 1);
    std::vector<char> bad(at(triangles.rows())), touched(at(from.rows()));
    GuardedStep step{to, 0};
    for (bool any = true; any;) {
        parallel_for(triangles.rows(), [&](Index t) {
            const Point before = double_area_normal(from, triangles, t);
            const Point after = double_area_normal(step.positions, triangles, t);
            const bool turned = !keep.row(t).isZero(0) && !(after.dot(keep.row(t)) > least_cosine * after.norm());
            bad[at(t)] = turned || after.norm() < least_area * before.norm();
        });
        std::fill(touched.begin(), touched.end(), 0);
        for (Index t = 0; t < triangles.rows(); ++t)
            if (bad[at(t)])
                for (int k = 0; k < 3; ++k) touched[at(triangles(t, k))] = 1;
        any = false;
        for (Index i = 0; i < from.rows(); ++i) {
            double& p = part[at(i)];
            if (!touched[at(i)] || p == 0) continue;
            any = true;
            p = p > shortest ? p / 2 : 0;
            step.positions.row(i) = from.row(i) + p * (to.row(i) - from.row(i));
        }
    }
    for (Index i = 0; i < from.rows(); ++i) step.shortened += part[at(i)] < 1 && from.row(i) != to.row(i);
    return step;
}

} // namespace meshtween
