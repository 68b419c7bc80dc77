// What is wanting at a triangle that looks into the target is a length, the detour to where it would look along it. It
// falls little by little, so that vertices which turn no triangle alone do so together.
#include "meshtween/fit/nudge.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/facing.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/search/self_intersections.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace meshtween {
namespace {

constexpr std::array steps{0.1, 0.2, 0.4}; // of a vertex's shortest edge
constexpr int directions = 8;              // along the target
// Above and below the target, in mean edges around a vertex, where it may leave it: a flat triangle whose corners lie
// on both sides of a valley or a thin sheet comes off the wrong wall so.
constexpr std::array heights{0.0, 0.1, -0.1, 0.2, -0.2};
constexpr double least_area = 0.1; // of the smallest triangle's before
// What a triangle that looks into the target costs beside its detour (in edges), as such and by how much it does; and
// what the squared distances of all triangles and of the vertex itself cost.
constexpr double as_such = 0.1, by_cosine = 0.2, by_distance = 0.1;
constexpr int most_rounds = 10, patient_rounds = 3; // in all; that turn no further triangle

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// What does not move.
struct Ground {
    const Shell& shell;
    const FitTarget& target;
    std::span<const Pin> pins;
    std::vector<std::vector<int>> pins_at; // a vertex: those in the triangles around it
    double unit = 0;                       // a typical edge
    bool leave = false;                    // vertices may leave the target
};

Ground ground_of(const Shell& shell, const FitTarget& target, std::span<const Pin> pins, const Points& positions,
                 const std::vector<int>& flips, bool leave) {
    Ground ground{shell, target, pins, std::vector<std::vector<int>>(idx(positions.rows())), 0, leave};
    for (std::size_t k = 0; k < pins.size(); ++k)
        for (int c = 0; c < 3; ++c)
            ground.pins_at[idx(shell.triangles(pins[k].where.triangle, c))].push_back(static_cast<int>(k));
    for (const int t : flips) ground.unit += std::sqrt(double_area_normal(positions, shell.triangles, t).norm());
    ground.unit /= static_cast<double>(flips.size());
    return ground;
}

// The mesh around a vertex.
struct Around {
    double cost = 0;
    double markers = 0; // their squared distances from their places
    double least_area = std::numeric_limits<double>::infinity();
};

// Of a vertex at that squared distance from the target; not past `most`, of the cost.
Around around(const Ground& ground, const Points& x, Eigen::Index vertex, double squared_distance,
              double most = std::numeric_limits<double>::infinity()) {
    const Triangles& triangles = ground.shell.triangles;
    const double per_square = by_distance / (ground.unit * ground.unit);
    Around result;
    result.cost = per_square * squared_distance;
    for (const int k : ground.pins_at[idx(vertex)]) {
        const Pin& pin = ground.pins[idx(k)];
        result.markers += (position(x, triangles, pin.where) - pin.target).squaredNorm();
    }
    int last = -1; // where the last answer lay is near the next
    for (const int t : ground.shell.topology.vertex_triangles[vertex]) {
        const Point centre = (x.row(triangles(t, 0)) + x.row(triangles(t, 1)) + x.row(triangles(t, 2))) / 3;
        const Point area = double_area_normal(x, triangles, t);
        const Facing there = facing(centre, area, ground.target, last);
        last = there.place;
        if (there.into()) result.cost += as_such + there.detour / ground.unit - by_cosine * there.cosine;
        result.cost += per_square * there.squared_distance;
        if (result.cost > most) break;
        result.least_area = std::min(result.least_area, area.norm());
    }
    return result;
}

// Moves the vertex where it does best, of some places around its own.
void to_best_place(const Ground& ground, Points& x, Eigen::Index vertex) {
    const auto neighbours = ground.shell.topology.neighbours[vertex];
    const Point start = x.row(vertex);
    double shortest = std::numeric_limits<double>::infinity(), mean = 0;
    for (const int j : neighbours) {
        const double length = (x.row(j) - start).norm();
        shortest = std::min(shortest, length);
        mean += length / static_cast<double>(neighbours.size());
    }
    const ClosestPoint here = ground.target.index.closest(start);
    const Around before = around(ground, x, vertex, here.squared_distance);
    double best = before.cost;
    Point place = start;
    const auto try_over = [&](const ClosestPoint& there) {
        const Point up = mean * normal_at(ground.target, there.where);
        for (const double height : std::span(heights).first(ground.leave ? heights.size() : 1)) {
            x.row(vertex) = there.position + height * up;
            const Around now = around(ground, x, vertex, height * height * mean * mean, best);
            if (!(now.cost < best) || now.least_area < least_area * before.least_area || now.markers > before.markers)
                continue;
            best = now.cost;
            place = x.row(vertex);
        }
    };
    try_over(here);
    const Point normal = normal_at(ground.target, here.where);
    const Point u = normal.unitOrthogonal(), v = normal.cross(u);
    for (const double step : steps)
        for (int k = 0; k < directions; ++k) {
            const double angle = 2 * EIGEN_PI * k / directions;
            const Point way = std::cos(angle) * u + std::sin(angle) * v;
            try_over(ground.target.index.closest(Point(start + step * shortest * way), here.where.triangle));
        }
    x.row(vertex) = place;
}

// The vertices of the flips and their neighbours, in connected parts. The border stays.
std::vector<std::vector<int>> parts_around(const Shell& shell, const std::vector<int>& flips) {
    const Lists& neighbours = shell.topology.neighbours;
    std::vector<char> near(idx(shell.rest.rows()), 0);
    for (const int t : flips)
        for (int k = 0; k < 3; ++k) {
            near[idx(shell.triangles(t, k))] = 1;
            for (const int j : neighbours[shell.triangles(t, k)]) near[idx(j)] = 1;
        }
    for (std::size_t i = 0; i < near.size(); ++i)
        if (shell.topology.on_boundary[i]) near[i] = 0;
    std::vector<std::vector<int>> parts;
    for (Eigen::Index i = 0; i < shell.rest.rows(); ++i) {
        if (!near[idx(i)]) continue;
        std::vector<int> part{static_cast<int>(i)};
        near[idx(i)] = 0;
        for (std::size_t k = 0; k < part.size(); ++k)
            for (const int j : neighbours[part[k]])
                if (near[idx(j)]) near[idx(j)] = 0, part.push_back(j);
        parts.push_back(std::move(part));
    }
    return parts;
}

// Where a part has come to cut more than it did, the vertices of what is cut by it go back.
void take_back_cuts(const Shell& shell, const std::vector<std::vector<int>>& parts, const Points& x, Points& now) {
    const Triangles& triangles = shell.triangles;
    std::vector<int> part(idx(x.rows()), -1);
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (const int i : parts[k]) part[idx(i)] = static_cast<int>(k);
    const std::vector<char> asked = touched(shell, x, now);
    const auto counted = [&](const std::vector<std::array<int, 2>>& cuts) {
        std::vector<long> count(parts.size(), 0);
        for (const auto& pair : cuts)
            for (const int t : pair)
                for (int k = 0; k < 3; ++k)
                    if (const int own = part[idx(triangles(t, k))]; own >= 0) ++count[idx(own)];
        return count;
    };
    const auto before = self_intersections(x, triangles, asked);
    const std::vector<long> count_before = counted(before);
    for (bool back = true; back;) {
        back = false;
        const auto after = self_intersections(now, triangles, asked);
        const std::vector<long> count = counted(after);
        for (const auto& pair : after) {
            if (std::binary_search(before.begin(), before.end(), pair)) continue;
            for (const int t : pair)
                for (int k = 0; k < 3; ++k) {
                    const int i = triangles(t, k), own = part[idx(i)];
                    if (own < 0 || count[idx(own)] <= count_before[idx(own)] || now.row(i) == x.row(i)) continue;
                    now.row(i) = x.row(i);
                    back = true;
                }
        }
    }
}

} // namespace

Nudged nudge(TangleSearch& search, const Points& positions, const Tangles& before, std::span<const Pin> pins,
             bool leave, const std::vector<int>& places) {
    const Shell& shell = search.shell;
    FacingWatch watch(shell.triangles, search.target, EdgeSides::both, at_first_corners(shell.triangles, places));
    std::vector<int> flips = watch.into(positions);
    if (flips.empty()) return {positions, before};
    const Ground ground = ground_of(shell, search.target, pins, positions, flips, leave);
    Points best = positions, x = positions;
    std::size_t fewest = flips.size();
    for (int round = 0, idle = 0; round < most_rounds && idle < patient_rounds && !flips.empty(); ++round, ++idle) {
        Points now = x;
        const std::vector<std::vector<int>> parts = parts_around(shell, flips);
        parallel_for(
            std::ssize(parts),
            [&](std::ptrdiff_t k) {
                for (const int vertex : parts[idx(k)]) to_best_place(ground, now, vertex);
            },
            1);
        take_back_cuts(shell, parts, x, now);
        x = std::move(now);
        flips = watch.into(x);
        if (flips.size() >= fewest) continue;
        fewest = flips.size();
        idle = -1;
        best = x;
    }
    return {best, tangles(search, best, before, touched(shell, positions, best))};
}

} // namespace meshtween
