#include "meshtween/fit/refined_fit.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/fit/lift.h"
#include "meshtween/fit/meet_markers.h"
#include "meshtween/fit/refine.h"
#include "meshtween/fit/refined_file.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/subdivide.h"
#include "meshtween/io/seams.h"
#include "meshtween/search/closest_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

constexpr double far = 50;           // tolerances: what is further off is a part that the template lacks
constexpr double least_cosine = 0.5; // between the surfaces' normals

Points edge_middles(const Mesh& mesh, const Topology& topology) {
    Points middles(std::ssize(topology.edges), 3);
    for (std::size_t e = 0; e < topology.edges.size(); ++e) {
        const auto& ends = topology.edges[e].vertices;
        middles.row(static_cast<Eigen::Index>(e)) = (mesh.positions.row(ends[0]) + mesh.positions.row(ends[1])) / 2;
    }
    return middles;
}

// A flag a vertex: on the target, within the tolerance.
std::vector<char> settled_vertices(const Mesh& mesh, const ClosestPointIndex& target, double tolerance) {
    std::vector<char> on(idx(mesh.positions.rows()));
    const std::vector<ClosestPoint> closest = target.closest(mesh.positions);
    for (std::size_t i = 0; i < on.size(); ++i) on[i] = closest[i].squared_distance <= tolerance * tolerance ? 1 : 0;
    return on;
}

void flag_by_middles(const Mesh& fitted, const Topology& topology, const FitTarget& target, const std::vector<char>& on,
                     double tolerance, std::vector<char>& flags) {
    const Points middles = edge_middles(fitted, topology), normals = vertex_normals(fitted.positions, fitted.triangles);
    parallel_for(
        std::ssize(topology.edges),
        [&](std::ptrdiff_t e) {
            const auto& ends = topology.edges[idx(e)].vertices;
            if (on[idx(ends[0])] == 0 || on[idx(ends[1])] == 0) return;
            const Point normal = (normals.row(ends[0]) + normals.row(ends[1])).normalized();
            const ClosestPoint closest =
                target.index.closest(Point(middles.row(e)), {normal, least_cosine}, far * tolerance);
            if (!closest.found() || on_border(target, closest.where)) return;
            flags[idx(e)] = closest.squared_distance > tolerance * tolerance ? 1 : 0;
        },
        256);
}

// Triangles over which the target's own vertices rise.
void flag_by_target(const Mesh& fitted, const Topology& topology, const Mesh& target, const std::vector<char>& on,
                    double tolerance, std::vector<char>& flags) {
    const FitTarget own = fit_target(fitted.positions, fitted.triangles);
    const Points normals = vertex_normals(target.positions, target.triangles);
    std::vector<char> triangles(idx(fitted.triangles.rows()), 0);
    std::vector<int> under(idx(target.positions.rows()), -1);
    parallel_for(
        target.positions.rows(),
        [&](std::ptrdiff_t i) {
            const ClosestPoint c =
                own.index.closest(Point(target.positions.row(i)), {normals.row(i), least_cosine}, far * tolerance);
            if (!c.found() || c.squared_distance <= tolerance * tolerance || on_border(own, c.where)) return;
            for (int k = 0; k < 3; ++k)
                if (on[idx(fitted.triangles(c.where.triangle, k))] == 0) return;
            under[idx(i)] = c.where.triangle;
        },
        256);
    for (const int t : under)
        if (t >= 0) triangles[idx(t)] = 1;
    for (std::size_t e = 0; e < flags.size(); ++e)
        for (const int t : topology.edges[e].triangles)
            if (t >= 0 && triangles[idx(t)] != 0) flags[e] = 1;
}

std::vector<Marker> moved_to(const Mesh& finer, const Mesh& source, std::span<const Marker> markers) {
    std::vector<Marker> moved(markers.begin(), markers.end());
    if (moved.empty()) return moved;
    const ClosestPointIndex index(finer);
    for (Marker& m : moved) m.source = index.closest(position(source.positions, source.triangles, m.source)).where;
    return moved;
}

// A mesh as its file numbers it and as one surface, with the same triangles and corners.
struct Layers {
    Mesh whole;
    Mesh cut;                // the file's; empty where nothing was welded
    std::vector<int> vertex; // the welded vertex of each of the file's; empty likewise

    Mesh& file() { return vertex.empty() ? whole : cut; }
    const Mesh& file() const { return vertex.empty() ? whole : cut; }
    Points expanded(const Points& x) const { return vertex.empty() ? x : x(vertex, Eigen::all); }
    std::vector<int> expanded(const std::vector<int>& vertices) const {
        if (vertex.empty()) return vertices;
        std::vector<int> result;
        for (std::size_t i = 0; i < vertex.size(); ++i)
            if (std::binary_search(vertices.begin(), vertices.end(), vertex[i])) result.push_back(static_cast<int>(i));
        return result;
    }
};

Layers layered(const Mesh& source, bool weld) {
    Weld found = weld ? seams(source) : Weld();
    if (!found.any()) return {source, {}, {}};
    return {welded(source, found), source, std::move(found.vertex)};
}

Layers finer(const Layers& layers, const Topology& edges, const std::vector<char>& coarse) {
    Layers result{subdivide(layers.whole, edges, coarse), {}, {}};
    if (layers.vertex.empty()) return result;
    result.cut = subdivide(layers.cut, layers.whole, edges, coarse);
    result.vertex = layers.vertex;
    result.vertex.resize(idx(result.cut.positions.rows()), 0);
    for (Eigen::Index t = 0; t < result.cut.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) result.vertex[idx(result.cut.triangles(t, k))] = result.whole.triangles(t, k);
    return result;
}

} // namespace

std::vector<char> too_coarse(const Mesh& fitted, const Topology& topology, const Mesh& target, double tolerance) {
    const double length = tolerance * diagonal(target);
    std::vector<char> flags(topology.edges.size(), 0);
    const FitTarget surface = fit_target(target.positions, target.triangles);
    const std::vector<char> on = settled_vertices(fitted, surface.index, length);
    flag_by_middles(fitted, topology, surface, on, length, flags);
    flag_by_target(fitted, topology, target, on, length, flags);
    return flags;
}

RefinedFit refined_fit(const Mesh& source, const Mesh& target, std::span<const Marker> markers,
                       const FitOptions& options, const RefineOptions& refine, const Progress& progress) {
    if (!(refine.tolerance > 0) || refine.rounds < 0)
        throw Error(ErrorKind::argument,
                    fmt::format("refining to {} in {} rounds: give a tolerance above 0 and 0 rounds "
                                "or more",
                                refine.tolerance, refine.rounds));
    FitOptions bare = options; // what is too coarse shows where vertices lie on the target
    bare.on_surface = true, bare.markers_exact = false, bare.weld = false;
    const WholeMesh to(target, options.weld);
    Layers layers = layered(source, options.weld);
    std::vector<int> uncut(idx(source.triangles.rows())); // the source's triangle of each
    std::iota(uncut.begin(), uncut.end(), 0);
    if (options.watch) bare.watch = [&](const Points& x) { options.watch(layers.expanded(x)); };
    RefinedFit result;
    const auto share = [&](int round) { return std::pow(2.0, round - refine.rounds); }; // later ones take longer
    result.fit = fit(layers.whole, to.mesh(), markers, bare, part_of(progress, 0, share(0)));
    for (int round = 0; result.fit.end != FitEnd::cancelled; ++round) {
        Mesh fitted = layers.whole;
        fitted.positions = result.fit.positions;
        const Topology edges = topology(fitted.positions.rows(), fitted.triangles);
        const std::vector<char> coarse = too_coarse(fitted, edges, to.mesh(), refine.tolerance);
        result.left = std::count(coarse.begin(), coarse.end(), 1);
        if (result.left == 0 || round == refine.rounds) break;
        if (fitted.positions.rows() + result.left > refine.most_vertices) {
            result.fit.notes.push_back(fmt::format("refining stopped at {} vertices: another round would end above {}",
                                                   fitted.positions.rows(), refine.most_vertices));
            break;
        }
        const Layers before = std::exchange(layers, finer(layers, edges, coarse));
        FitResult next = fit(layers.whole, to.mesh(), moved_to(layers.whole, source, markers), bare,
                             part_of(progress, share(round), share(round + 1)));
        if (next.end == FitEnd::cancelled) {
            layers = before;
            result.fit.end = FitEnd::cancelled;
            break;
        }
        const std::vector<int> parents = uncut_triangles(before.whole.triangles, edges, coarse);
        std::vector<int> older = std::exchange(uncut, {});
        for (const int t : parents) uncut.push_back(older[idx(t)]);
        result.added.push_back(static_cast<long>(layers.file().positions.rows() - before.file().positions.rows()));
        result.fit = std::move(next);
    }
    if (result.fit.end != FitEnd::cancelled && options.method == FitMethod::surface && !options.on_surface)
        result.fit.positions = lifted({result.fit.positions, layers.whole.triangles, {}, {}, {}}, to.mesh());
    if (result.fit.end != FitEnd::cancelled && options.markers_exact)
        meet_markers(result.fit, layers.whole, to.mesh(), moved_to(layers.whole, source, markers));
    result.fit.positions = layers.expanded(result.fit.positions);
    result.fit.refused = layers.expanded(result.fit.refused);
    result.fit.carried = layers.expanded(result.fit.carried);
    result.source = std::move(layers.file());
    if (!result.added.empty()) result.source.file = refined_file(source, result.source, uncut);
    return result;
}

} // namespace meshtween
