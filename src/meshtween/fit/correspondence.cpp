#include "meshtween/fit/correspondence.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/counterpart.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/io/output.h"
#include "meshtween/io/seams.h"
#include "meshtween/io/text_out.h"
#include "meshtween/search/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

constexpr double near_enough = 0.005; // of the diagonal: distances well under this cost no trust
constexpr double slack = 0.001;       // of the diagonal: a vertex no further off lies on the target

// From the closest of all for each vertex of the mesh.
std::vector<ClosestPoint> closest_alike(const Mesh& mesh, const Weld& seams, const ClosestPointIndex& surface,
                                        double diagonal, std::vector<ClosestPoint> closest) {
    constexpr double further = 1.5; // of the distance to the closest point
    const Points normals = vertex_normals(mesh.positions, mesh.triangles, seams);
    parallel_for(
        mesh.positions.rows(),
        [&](std::ptrdiff_t i) {
            ClosestPoint& best = closest[idx(i)];
            if (surface.normals().row(best.where.triangle).dot(normals.row(i)) >= 0) return;
            const double reach = further * std::sqrt(best.squared_distance) + slack * diagonal;
            const ClosestPoint alike =
                surface.closest(Point(mesh.positions.row(i)), {normals.row(i), 0.0}, reach, best.where.triangle);
            if (alike.found()) best = alike;
        },
        256);
    return closest;
}

// Each corner the first of the vertices that are one.
Triangles by_first(const Mesh& mesh, const Weld& seams) {
    return seams.any() ? seams.by_first() : mesh.triangles;
}

Points vertices_and_centres(const Mesh& mesh) {
    Points all(mesh.positions.rows() + mesh.triangles.rows(), 3);
    all.topRows(mesh.positions.rows()) = mesh.positions;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        all.row(mesh.positions.rows() + t) =
            position(mesh.positions, mesh.triangles, {static_cast<int>(t), Point::Constant(1.0 / 3)});
    return all;
}

// What lies beyond the fitted mesh's own border is no part of it and does not count.
void find_uncovered(const Comparison& both, const Triangles& triangles, const std::vector<char>& on_boundary,
                    Correspondence& map) {
    const Mesh& fitted = both.fitted;
    map.uncovered.assign(idx(fitted.positions.rows()), 0.0);
    map.uncovered_at = fitted.positions;
    const Points places = vertices_and_centres(both.target);
    const std::vector<ClosestPoint> back = both.on_fitted.closest(places);
    for (std::size_t i = 0; i < back.size(); ++i) {
        const SurfacePoint& where = back[i].where;
        if (at_border(where, triangles, on_boundary)) continue;
        int corner = 0;
        where.barycentric.maxCoeff(&corner);
        const int v = triangles(where.triangle, corner);
        const double far = std::sqrt(back[i].squared_distance) / both.diagonal;
        if (far <= map.uncovered[idx(v)]) continue;
        map.uncovered[idx(v)] = far;
        map.uncovered_at.row(v) = places.row(static_cast<Eigen::Index>(i));
    }
    const Weld& seams = both.fitted_seams;
    seams.share(map.uncovered);
    if (seams.any()) map.uncovered_at = seams.expanded(seams.reduced(map.uncovered_at));
}

double falling(double distance) {
    return std::exp(-(distance / near_enough) * (distance / near_enough));
}

} // namespace

std::vector<SurfacePoint> places_on(const Mesh& mesh, const Mesh& surface) {
    const ClosestPointIndex index(surface);
    std::vector<SurfacePoint> places;
    for (const ClosestPoint& c :
         closest_alike(mesh, seams(mesh), index, diagonal(surface), index.closest(mesh.positions)))
        places.push_back(c.where);
    return places;
}

Correspondence correspondence(const Comparison& both) {
    const Mesh &fitted = both.fitted, &target = both.target;
    const ClosestPointIndex& surface = both.on_target;
    const Points normals = vertex_normals(fitted.positions, fitted.triangles, both.fitted_seams);
    const Triangles triangles = by_first(fitted, both.fitted_seams),
                    target_triangles = by_first(target, both.target_seams);
    const Topology own = topology(fitted.positions.rows(), triangles);
    const Topology other = topology(target.positions.rows(), target_triangles);
    const bool open = std::ranges::find(other.on_boundary, 1) != other.on_boundary.end();
    Correspondence map;
    find_uncovered(both, triangles, own.on_boundary, map);
    const std::vector<ClosestPoint> closest =
        closest_alike(fitted, both.fitted_seams, surface, both.diagonal, both.vertices);
    std::vector<double> counterpart;
    if (open)
        counterpart =
            counterparts(fitted.positions, own.neighbours, closest, {target_triangles, other.on_boundary, surface},
                         both.on_fitted, std::numeric_limits<double>::infinity());
    std::vector<char> on_boundary = own.on_boundary;
    both.fitted_seams.share(on_boundary);
    if (open) both.fitted_seams.share(counterpart);
    for (std::size_t i = 0; i < closest.size(); ++i) {
        const SurfacePoint& place = closest[i].where;
        map.places.push_back(place);
        map.distance.push_back(std::sqrt(closest[i].squared_distance) / both.diagonal);
        map.agreement.push_back(normals.row(static_cast<Eigen::Index>(i)).dot(surface.normals().row(place.triangle)));
        const bool ends = at_border(place, target_triangles, other.on_boundary);
        map.border.push_back((ends && on_boundary[i] == 0) ||
                             (open && map.distance.back() > slack && counterpart[i] < 0.5));
        map.trust.push_back(map.border[i] != 0 ? 0
                                               : std::max(0.0, map.agreement[i]) * falling(map.distance[i]) *
                                                     falling(map.uncovered[i]));
    }
    return map;
}

void set_aside(Correspondence& map, const std::vector<int>& vertices) {
    for (const int v : vertices) {
        map.border[idx(v)] = 2;
        map.trust[idx(v)] = 0;
    }
}

void write_map(const Correspondence& map, const std::filesystem::path& path) {
    write_whole(path, [&](std::ostream& stream) {
        TextOut out(stream);
        out.put("vertex,triangle,a,b,c,distance\n");
        for (std::size_t i = 0; i < map.places.size(); ++i) {
            const SurfacePoint& p = map.places[i];
            out.put("{},{},{},{},{},{:.6g}\n", i, p.triangle, p.barycentric[0], p.barycentric[1], p.barycentric[2],
                    map.distance[i]);
        }
    });
}

void write_weights(const Correspondence& map, const std::filesystem::path& path) {
    write_whole(path, [&](std::ostream& stream) {
        TextOut out(stream);
        out.put("vertex,trust,distance,agreement,border,uncovered\n");
        for (std::size_t i = 0; i < map.places.size(); ++i)
            out.put("{},{:.6g},{:.6g},{:.6g},{},{:.6g}\n", i, map.trust[i], map.distance[i], map.agreement[i],
                    int(map.border[i]), map.uncovered[i]);
    });
}

Colors trust_colors(const Correspondence& map) {
    Colors colors(std::ssize(map.trust), 4);
    for (std::size_t i = 0; i < map.trust.size(); ++i) {
        const auto t = static_cast<float>(map.trust[i]);
        colors.row(static_cast<Eigen::Index>(i)) << std::min(1.0F, 2 - 2 * t), std::min(1.0F, 2 * t), 0.1F, 1;
    }
    return colors;
}

} // namespace meshtween
