#include "meshtween/fit/exposure.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/disjoint_sets.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/search/rays.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace meshtween {
namespace {

constexpr int directions = 32;
constexpr Eigen::Index samples = 2000; // triangles
constexpr int surely_open = 6;         // directions: no more are asked
constexpr double lift = 1e-5;          // of the diagonal: where rays begin
constexpr double hidden = 1.5 / directions, half_hidden = 0.25, covered = 0.5;
constexpr double least_patch = 0.005, most = 0.9; // of the area

bool is_covered(const Exposure& e) {
    return e.back > covered;
}

bool is_hidden(const Exposure& e) {
    return e.open < hidden && !is_covered(e);
}

bool is_half_hidden(const Exposure& e) {
    return e.open < half_hidden && !is_covered(e);
}

std::size_t idx(auto i) {
    return static_cast<std::size_t>(i);
}

// Spread over the half sphere by the cosine, around z: a Fibonacci spiral on the disk, lifted (Malley).
std::array<Point, directions> spiral() {
    std::array<Point, directions> result;
    for (int i = 0; i < directions; ++i) {
        const double r = std::sqrt((i + 0.5) / directions), angle = 2 * std::numbers::pi * i / std::numbers::phi;
        result[idx(i)] = {r * std::cos(angle), r * std::sin(angle), std::sqrt(1 - r * r)};
    }
    return result;
}

Exposure seen_from(const Point& centre, const Point& normal, const std::array<Point, directions>& spread,
                   const RayIndex& rays, const Points& normals, double least) {
    const Point along = normal.unitOrthogonal(), across = normal.cross(along);
    int open = 0, back = 0, asked = 0;
    for (const Point& d : spread) {
        const Point direction = d[0] * along + d[1] * across + d[2] * normal;
        const RayHit hit = rays.first(centre, direction, least);
        ++asked;
        if (!hit.found())
            ++open;
        else
            back += normals.row(hit.triangle).dot(direction) > 0;
        if (open >= surely_open && back == 0) break;
    }
    const auto share = [&](int count) { return static_cast<float>(count) / static_cast<float>(asked); };
    return {share(open), share(back)};
}

// The mesh with each hole closed by a fan around its middle: what is seen through the neck of a bust is not outside.
struct Capped {
    Points positions;
    Triangles triangles;
};

Capped capped(const Points& positions, const Triangles& triangles) {
    const std::vector<std::vector<int>> holes = boundary_loops(triangles, topology(positions.rows(), triangles));
    std::size_t count = 0;
    for (const std::vector<int>& hole : holes) count += hole.size();
    Capped result{positions, triangles};
    result.positions.conservativeResize(positions.rows() + std::ssize(holes), 3);
    result.triangles.conservativeResize(triangles.rows() + static_cast<Eigen::Index>(count), 3);
    Eigen::Index row = triangles.rows();
    for (std::size_t h = 0; h < holes.size(); ++h) {
        const auto middle = positions.rows() + static_cast<Eigen::Index>(h);
        result.positions.row(middle) = positions(holes[h], Eigen::all).colwise().mean();
        for (std::size_t k = 0; k < holes[h].size(); ++k)
            result.triangles.row(row++) << holes[h][(k + 1) % holes[h].size()], holes[h][k], static_cast<int>(middle);
    }
    return result;
}

// Of every step-th triangle.
std::vector<Exposure> exposure_of_each(const Points& positions, const Triangles& triangles, Eigen::Index step,
                                       Holes holes) {
    const Capped closed = holes == Holes::closed ? capped(positions, triangles) : Capped{positions, triangles};
    const RayIndex rays(closed.positions, closed.triangles);
    const Points normals = triangle_normals(closed.positions, closed.triangles);
    const auto spread = spiral();
    const double least = lift * diagonal(positions, triangles);
    std::vector<Exposure> result(idx((triangles.rows() + step - 1) / step));
    parallel_for(
        std::ssize(result),
        [&](std::ptrdiff_t i) {
            const Eigen::Index t = i * step;
            if (normals.row(t).isZero(0)) return;
            const Point centre =
                (positions.row(triangles(t, 0)) + positions.row(triangles(t, 1)) + positions.row(triangles(t, 2))) / 3;
            result[idx(i)] = seen_from(centre, normals.row(t), spread, rays, normals, least);
        },
        64);
    return result;
}

// Patches of equal flags that are small take the flag of what is around them: once from small to large.
void even_out(const Points& positions, const Triangles& triangles, std::vector<char>& flags) {
    const Topology edges = topology(positions.rows(), triangles);
    DisjointSets patches(triangles.rows());
    for (const Edge& edge : edges.edges)
        if (edge.count == 2 && flags[idx(edge.triangles[0])] == flags[idx(edge.triangles[1])])
            patches.join(edge.triangles[0], edge.triangles[1]);
    std::vector<double> area(flags.size(), 0.0);
    double whole = 0;
    for (int t = 0; t < triangles.rows(); ++t) {
        const double own = triangle_area(positions, triangles, t);
        area[idx(patches.find(t))] += own, whole += own;
    }
    std::vector<char> has_other(flags.size(), 0); // a patch: something else is around it
    for (const Edge& edge : edges.edges)
        if (edge.count == 2 && flags[idx(edge.triangles[0])] != flags[idx(edge.triangles[1])])
            for (const int t : edge.triangles) has_other[idx(patches.find(t))] = 1;
    for (int t = 0; t < triangles.rows(); ++t) {
        const int patch = patches.find(t);
        if (area[idx(patch)] >= least_patch * whole) continue;
        if (has_other[idx(patch)] != 0)
            flags[idx(t)] = flags[idx(t)] == 0 ? 1 : 0;
        else
            flags[idx(t)] = 0; // a small part of its own
    }
}

// Flags spread to neighbours that may have them (hysteresis: Canny 1986).
void grow(const Points& positions, const Triangles& triangles, const std::vector<char>& may, std::vector<char>& flags) {
    const Lists around = topology(positions.rows(), triangles).vertex_triangles;
    std::vector<int> reached;
    for (int t = 0; t < triangles.rows(); ++t)
        if (flags[idx(t)] != 0) reached.push_back(t);
    while (!reached.empty()) {
        const int t = reached.back();
        reached.pop_back();
        for (int k = 0; k < 3; ++k)
            for (const int other : around[triangles(t, k)]) {
                if (flags[idx(other)] != 0 || may[idx(other)] == 0) continue;
                flags[idx(other)] = 1;
                reached.push_back(other);
            }
    }
}

// None where hardly anything would be left.
std::vector<char> with_rest(const Points& positions, const Triangles& triangles, std::vector<char> flags) {
    if (share_of_area(positions, triangles, flags) > most) std::fill(flags.begin(), flags.end(), 0);
    return flags;
}

std::vector<char> flags_of(const std::vector<Exposure>& exposure, const auto& is) {
    std::vector<char> flags;
    for (const Exposure& e : exposure) flags.push_back(is(e) ? 1 : 0);
    return flags;
}

} // namespace

std::vector<Exposure> exposure(const Points& positions, const Triangles& triangles, Holes holes) {
    return exposure_of_each(positions, triangles, 1, holes);
}

InnerShares inner_shares(const Points& positions, const Triangles& triangles) {
    const Eigen::Index step = std::max<Eigen::Index>(1, triangles.rows() / samples);
    const std::vector<Exposure> some = exposure_of_each(positions, triangles, step, Holes::closed);
    InnerShares shares;
    double whole = 0;
    for (std::size_t i = 0; i < some.size(); ++i) {
        const double area = triangle_area(positions, triangles, static_cast<Eigen::Index>(i) * step);
        whole += area;
        shares.hidden += is_hidden(some[i]) ? area : 0;
        shares.covered += is_covered(some[i]) ? area : 0;
    }
    if (whole > 0) shares.hidden /= whole, shares.covered /= whole;
    return shares;
}

std::vector<char> hidden_faces(const Points& positions, const Triangles& triangles,
                               const std::vector<Exposure>& exposure) {
    std::vector<char> flags = flags_of(exposure, is_hidden);
    even_out(positions, triangles, flags);
    grow(positions, triangles, flags_of(exposure, is_half_hidden), flags);
    even_out(positions, triangles, flags);
    return with_rest(positions, triangles, std::move(flags));
}

std::vector<char> covered_faces(const Points& positions, const Triangles& triangles,
                                const std::vector<Exposure>& exposure) {
    std::vector<char> flags = flags_of(exposure, is_covered);
    even_out(positions, triangles, flags);
    return with_rest(positions, triangles, std::move(flags));
}

double share_of_area(const Points& positions, const Triangles& triangles, const std::vector<char>& flags) {
    double own = 0, whole = 0;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
        const double area = triangle_area(positions, triangles, t);
        whole += area;
        if (flags[idx(t)] != 0) own += area;
    }
    return whole > 0 ? own / whole : 0;
}

} // namespace meshtween
