// The least-squares step under linear constraints, in a metric in which smooth steps are short: with the markers' rows
// of barycentric coordinates B and a smoothing W of the mesh, x + W B^T (B W B^T)^-1 r meets all markers that miss by
// r. W is a number of rounds of symmetric averaging along edges (Metropolis weights), positive semidefinite and nought
// beyond as many rings, so that only the surroundings of the markers are touched.
#include "meshtween/fit/meet_markers.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/project.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

constexpr double met = 1e-9;       // parts of the target's diagonal
constexpr int most_rings = 64;     // that a step is spread over
constexpr int setting_down = 3;    // rounds of a wide step and a projection
constexpr double reach = 0.02;     // parts of the target's size: vertices further off it are not set down
constexpr double compatible = 0.5; // cosine between a vertex's normal and the target's

// Averaging over the vertices within `rings` of the markers; everything is numbered within these.
class Spread {
public:
    Spread(const Topology& topology, const Triangles& triangles, std::span<const Marker> markers, int rings)
        : rings_(rings), local_(idx(topology.neighbours.size()), -1) {
        for (const Marker& m : markers)
            for (int k = 0; k < 3; ++k) add(triangles(m.source.triangle, k));
        for (std::size_t begin = 0, ring = 0; ring < idx(rings); ++ring) {
            const std::size_t end = vertices_.size();
            for (; begin < end; ++begin)
                for (const int j : topology.neighbours[vertices_[begin]]) add(j);
        }
        neighbours_.first.reserve(vertices_.size() + 1);
        for (const int v : vertices_) {
            for (const int j : topology.neighbours[v])
                if (local_[idx(j)] >= 0) {
                    neighbours_.items.push_back(local_[idx(j)]);
                    const auto degree = [&](int i) { return static_cast<double>(topology.neighbours[i].size()); };
                    weights_.push_back(0.5 / std::max(degree(v), degree(j)));
                }
            neighbours_.first.push_back(static_cast<int>(neighbours_.items.size()));
        }
        for (const Marker& m : markers) {
            Eigen::RowVector3i corners;
            for (int k = 0; k < 3; ++k) corners[k] = local_[idx(triangles(m.source.triangle, k))];
            corners_.push_back(corners);
            shares_.push_back(m.source.barycentric);
        }
    }

    const std::vector<int>& vertices() const { return vertices_; }

    // W B^T c: a step of the vertices above, a row each.
    Points step(const Points& c) const {
        Points x = Points::Zero(std::ssize(vertices_), 3);
        for (std::size_t k = 0; k < corners_.size(); ++k)
            for (int i = 0; i < 3; ++i) x.row(corners_[k][i]) += shares_[k][i] * c.row(static_cast<Eigen::Index>(k));
        for (int round = 0; round < rings_; ++round) {
            Points next(x.rows(), 3);
            parallel_for(x.rows(), [&](std::ptrdiff_t i) {
                Point sum = x.row(i);
                for (int e = neighbours_.first[idx(i)]; e < neighbours_.first[idx(i) + 1]; ++e)
                    sum += weights_[idx(e)] * (x.row(neighbours_.items[idx(e)]) - x.row(i));
                next.row(i) = sum;
            });
            x = std::move(next);
        }
        return x;
    }

    Points at_markers(const Points& x) const { // B x
        Points result(std::ssize(corners_), 3);
        for (std::size_t k = 0; k < corners_.size(); ++k) {
            Point sum(0, 0, 0);
            for (int i = 0; i < 3; ++i) sum += shares_[k][i] * x.row(corners_[k][i]);
            result.row(static_cast<Eigen::Index>(k)) = sum;
        }
        return result;
    }

private:
    void add(int v) {
        if (local_[idx(v)] >= 0) return;
        local_[idx(v)] = static_cast<int>(vertices_.size());
        vertices_.push_back(v);
    }

    int rings_;
    std::vector<int> local_, vertices_;
    Lists neighbours_;
    std::vector<double> weights_; // one an item of neighbours_
    std::vector<Eigen::RowVector3i> corners_;
    std::vector<Eigen::RowVector3d> shares_;
};

// c of (B W B^T + little) c = r, by conjugate gradients. The little keeps c bounded where markers contradict each
// other.
Points multipliers(const Spread& spread, const Points& r) {
    constexpr double share = 1e-7, enough = 1e-13;
    Points c = Points::Zero(r.rows(), 3), rest = r, direction = r;
    const double first = rest.squaredNorm();
    if (!(first > 0)) return c;
    const double little = share * r.cwiseProduct(spread.at_markers(spread.step(r))).sum() / first;
    double size = first;
    for (Eigen::Index i = 0; i < 2 * r.rows() + 30 && size > enough * enough * first; ++i) {
        const Points image = spread.at_markers(spread.step(direction)) + little * direction;
        const double curvature = direction.cwiseProduct(image).sum();
        if (!(curvature > 0)) break;
        const double along = size / curvature;
        c += along * direction;
        rest -= along * image;
        const double next = rest.squaredNorm();
        direction = (rest + next / size * direction).eval();
        size = next;
    }
    return c;
}

Points missing(const Points& x, const Triangles& triangles, std::span<const Marker> markers) {
    Points r(std::ssize(markers), 3);
    for (std::size_t k = 0; k < markers.size(); ++k)
        r.row(static_cast<Eigen::Index>(k)) = markers[k].target - position(x, triangles, markers[k].source);
    return r;
}

Points stepped(const Points& x, const Triangles& triangles, std::span<const Marker> markers, const Spread& spread,
               double enough) {
    Points result = x;
    constexpr int passes = 6; // each takes away most of what the last one left
    for (int pass = 0; pass < passes; ++pass) {
        const Points r = missing(result, triangles, markers);
        if (r.norm() < enough) break;
        const Points step = spread.step(multipliers(spread, r));
        for (std::size_t i = 0; i < spread.vertices().size(); ++i)
            result.row(spread.vertices()[i]) += step.row(static_cast<Eigen::Index>(i));
    }
    return result;
}

// Triangles that look into the target, of those with a vertex in `touched`.
long turned_over(const Points& x, const Triangles& triangles, const Topology& topology, const std::vector<int>& touched,
                 const TargetSurface& target) {
    std::vector<int> around;
    for (const int v : touched)
        for (const int t : topology.vertex_triangles[v]) around.push_back(t);
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    return parallel_sum(std::ssize(around), 0L, [&](std::ptrdiff_t i) {
        const int t = around[idx(i)];
        const Point centre = (x.row(triangles(t, 0)) + x.row(triangles(t, 1)) + x.row(triangles(t, 2))) / 3;
        const int there = target.index.closest(centre).where.triangle;
        return double_area_normal(x, triangles, t).dot(target.index.normals().row(there)) < 0 ? 1L : 0L;
    });
}

// Far enough that a step of this length strains no edge by more than a quarter.
int rings_for(double length, double edge) {
    return edge > 0 ? static_cast<int>(std::clamp(std::ceil(4 * length / edge), 4.0, double(most_rings))) : 4;
}

} // namespace

MetMarkers meet_markers(const Mesh& fitted, const Mesh& target_mesh, std::span<const Marker> markers) {
    MetMarkers result{fitted.positions, {}};
    const Triangles& triangles = fitted.triangles;
    if (markers.empty() || missing(fitted.positions, triangles, markers).norm() < met * diagonal(target_mesh))
        return result;
    const Surroundings around = surroundings(fitted.positions.rows(), triangles);
    const TargetSurface target = target_surface(target_mesh.positions, target_mesh.triangles);
    const auto off = [&](const Points& x) { return missing(x, triangles, markers).rowwise().norm().eval(); };
    const double enough = 1e-4 * met * target.diagonal;
    Points& x = result.positions;
    const std::vector<char> attached = attached_boundary(x, triangles, around, target, reach);
    for (int round = 0; round < setting_down && off(x).maxCoeff() > met * target.diagonal; ++round) {
        const int rings = rings_for(off(x).maxCoeff(), mean_edge_length(x, around.topology));
        const Points moved = stepped(x, triangles, markers, Spread(around.topology, triangles, markers, rings), enough);
        const Goals goals = closest_compatible(moved, triangles, around, target, attached, {compatible, reach});
        x = guarded_step(moved, goals.positions, goals.normals, triangles).positions;
    }
    const Spread widest(around.topology, triangles, markers, 8);
    long fewest = -1;
    Points best = x;
    for (const int rings : {8, 4, 2, 0}) {
        const Points moved = stepped(x, triangles, markers, Spread(around.topology, triangles, markers, rings), enough);
        const long count = turned_over(moved, triangles, around.topology, widest.vertices(), target);
        if (fewest < 0 || count < fewest) fewest = count, best = moved;
    }
    x = std::move(best);
    const Eigen::VectorXd left = off(x);
    for (std::size_t k = 0; k < markers.size(); ++k)
        if (left[static_cast<Eigen::Index>(k)] > met * target.diagonal) result.missed.push_back(k);
    return result;
}

void meet_markers(FitResult& fit, const Mesh& source, const Mesh& target, std::span<const Marker> markers) {
    MetMarkers met = meet_markers({fit.positions, source.triangles, {}, {}, {}}, target, markers);
    fit.positions = std::move(met.positions);
    for (const std::size_t k : met.missed)
        fit.notes.push_back(fmt::format("marker '{}' cannot be met exactly beside its neighbours: the source is too "
                                        "coarse there, refine it or take a marker away",
                                        markers[k].name));
}

} // namespace meshtween
