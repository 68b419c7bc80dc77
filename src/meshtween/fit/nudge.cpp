// What is wanting is a length: at a triangle that looks into the target the detour to where it would look along it, at
// a cut how far two triangles reach through each other. It falls little by little, so that vertices which mend nothing
// alone do so together.
#include "meshtween/fit/nudge.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/cut_length.h"
#include "meshtween/fit/facing.h"
#include "meshtween/fit/region.h"
#include "meshtween/geometry/measure.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace meshtween {
namespace {

// What a vertex tries in turn: small steps, as long as they mend anything; after a round in vain wide ones.
constexpr std::array small_steps{0.1, 0.2, 0.4}; // of its shortest edge
constexpr std::array wide_steps{0.2, 0.4, 0.8};  // of its mean edge
constexpr double to_neighbour = 0.7;             // of the way there, on wide rounds
constexpr int directions = 8;                    // along the target
constexpr double golden_angle = 2.399963;        // by which they turn from round to round
// Above and below the target, in mean edges around a vertex, where it may leave it: a flat triangle whose corners lie
// on both sides of a valley or a thin sheet comes off the wrong wall so.
constexpr std::array heights{0.0, 0.1, -0.1, 0.2, -0.2};
constexpr double least_area = 0.1; // of the smallest triangle's before
// What a triangle that looks into the target costs beside its detour (in edges), as such and by how much it does; and
// what the squared distances of all triangles and of the vertex itself cost.
constexpr double as_such = 0.1, by_cosine = 0.2, by_distance = 0.1;
// In all, and in a row that mend nothing further. Where more than a few faults are left the shapes are not alike: their
// cuts stay, and the flips get less of the time.
struct Rounds {
    int most, patient;
    bool wide, cuts;
};
constexpr std::size_t few_faults = 300;
constexpr Rounds for_few{100, 12, true, true}, for_many{10, 3, false, false};

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

std::vector<int> faulty(const Tangles& faults) {
    std::vector<int> triangles = faults.flips;
    for (const auto& pair : faults.cuts) triangles.insert(triangles.end(), pair.begin(), pair.end());
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    return triangles;
}

// What does not move.
struct Ground {
    const Shell& shell;
    const FitTarget& target;
    std::span<const Pin> pins;
    std::vector<std::vector<int>> pins_at; // a vertex: those in the triangles around it
    double unit = 0;                       // a typical edge
    std::vector<int> beside_cuts;          // triangles: what could cut each other
    bool leave = false;                    // vertices may leave the target
};

Ground ground_of(const Shell& shell, const FitTarget& target, std::span<const Pin> pins, const Points& positions,
                 const Tangles& faults, bool leave) {
    Ground ground{shell, target, pins, std::vector<std::vector<int>>(idx(positions.rows())), 0, {}, leave};
    ground.beside_cuts = beside_cuts(shell, faults.cuts);
    for (std::size_t k = 0; k < pins.size(); ++k)
        for (int c = 0; c < 3; ++c)
            ground.pins_at[idx(shell.triangles(pins[k].where.triangle, c))].push_back(static_cast<int>(k));
    const std::vector<int> triangles = faulty(faults);
    for (const int t : triangles) ground.unit += std::sqrt(double_area_normal(positions, shell.triangles, t).norm());
    ground.unit /= static_cast<double>(triangles.size());
    return ground;
}

// What a vertex's place is judged by.
struct Fan {
    std::vector<int> triangles; // its own, the worst first
    std::vector<int> sheets;    // that they could cut
    double least_area = 0;      // doubled, of its smallest triangle
    double markers = 0;         // their squared distances from their places
};

double markers_off(const Ground& ground, const Points& x, Eigen::Index vertex) {
    double sum = 0;
    for (const int k : ground.pins_at[idx(vertex)]) {
        const Pin& pin = ground.pins[idx(k)];
        sum += (position(x, ground.shell.triangles, pin.where) - pin.target).squaredNorm();
    }
    return sum;
}

double smallest_area(const Triangles& triangles, const Points& x, const std::vector<int>& fan) {
    double least = std::numeric_limits<double>::infinity();
    for (const int t : fan) least = std::min(least, double_area_normal(x, triangles, t).norm());
    return least;
}

// What is wanting at a triangle; `place` is where the target answers, near the next answer.
double wanting(const Ground& ground, const Points& x, int t, const std::vector<int>& sheets, int& place) {
    const Triangles& triangles = ground.shell.triangles;
    double cost = 0;
    for (const int s : sheets)
        if (const auto length = cut_length(x, triangles, s, t)) cost += as_such + *length / ground.unit;
    const Point centre = (x.row(triangles(t, 0)) + x.row(triangles(t, 1)) + x.row(triangles(t, 2))) / 3;
    const Facing there = facing(centre, double_area_normal(x, triangles, t), ground.target, place);
    place = there.place;
    if (there.into()) cost += as_such + there.detour / ground.unit - by_cosine * there.cosine;
    return cost + by_distance * there.squared_distance / (ground.unit * ground.unit);
}

// At a vertex that far from the target; not past `most`.
double cost_around(const Ground& ground, const Points& x, const Fan& fan, double distance, double most) {
    double cost = by_distance * distance * distance / (ground.unit * ground.unit);
    int place = -1;
    for (std::size_t k = 0; k < fan.triangles.size() && cost < most; ++k)
        cost += wanting(ground, x, fan.triangles[k], fan.sheets, place);
    return cost;
}

// The fan as it is, with what is wanting at its triangles.
Fan fan_of(const Ground& ground, const Points& x, Eigen::Index vertex, const std::vector<int>& sheets, double reach,
           double& cost) {
    Fan fan;
    fan.sheets = near_vertex(ground.shell, x, vertex, sheets, reach);
    std::vector<std::pair<double, int>> ranked;
    int place = -1;
    cost = 0;
    for (const int t : ground.shell.topology.vertex_triangles[vertex]) {
        ranked.emplace_back(-wanting(ground, x, t, fan.sheets, place), t);
        cost -= ranked.back().first;
    }
    std::sort(ranked.begin(), ranked.end());
    for (const auto& [rank, t] : ranked) fan.triangles.push_back(t);
    fan.least_area = smallest_area(ground.shell.triangles, x, fan.triangles);
    fan.markers = markers_off(ground, x, vertex);
    return fan;
}

// Moves the vertex where it does best, of some places around its own.
void to_best_place(const Ground& ground, const std::vector<int>& sheets, Points& x, Eigen::Index vertex, bool wide,
                   double turn) {
    const auto neighbours = ground.shell.topology.neighbours[vertex];
    const Point start = x.row(vertex);
    Point middle(0, 0, 0);
    double shortest = std::numeric_limits<double>::infinity(), mean = 0;
    for (const int j : neighbours) {
        const double length = (x.row(j) - start).norm();
        shortest = std::min(shortest, length);
        mean += length / static_cast<double>(neighbours.size());
        middle += x.row(j) / static_cast<double>(neighbours.size());
    }
    double best = 0;
    const Fan fan = fan_of(ground, x, vertex, sheets, mean, best); // steps and heights do not lead further off
    if (best < as_such) return;                                    // nothing is wanting there
    const ClosestPoint here = ground.target.index.closest(start);
    best += by_distance * here.squared_distance / (ground.unit * ground.unit);
    Point place = start;
    const auto try_over = [&](const ClosestPoint& there) {
        const Point up = mean * normal_at(ground.target, there.where);
        for (const double height : std::span(heights).first(ground.leave ? heights.size() : 1)) {
            x.row(vertex) = there.position + height * up;
            if (smallest_area(ground.shell.triangles, x, fan.triangles) < least_area * fan.least_area ||
                markers_off(ground, x, vertex) > fan.markers)
                continue;
            const double cost = cost_around(ground, x, fan, height * mean, best);
            if (!(cost < best)) continue;
            best = cost;
            place = x.row(vertex);
        }
    };
    try_over(here);
    const Point normal = normal_at(ground.target, here.where);
    const Point u = normal.unitOrthogonal(), v = normal.cross(u);
    for (const double step : wide ? wide_steps : small_steps)
        for (int k = 0; k < directions; ++k) {
            const double angle = turn + 2 * EIGEN_PI * k / directions;
            const Point way = std::cos(angle) * u + std::sin(angle) * v;
            const Point there = start + step * (wide ? mean : shortest) * way;
            try_over(ground.target.index.closest(there, here.where.triangle));
        }
    if (wide) {
        try_over(ground.target.index.closest(middle));
        for (const int j : neighbours)
            try_over(ground.target.index.closest(Point(start + to_neighbour * (x.row(j) - start))));
    }
    x.row(vertex) = place;
}

// The vertices of these triangles and their neighbours, in connected parts. The border stays.
std::vector<std::vector<int>> parts_around(const Shell& shell, const std::vector<int>& triangles) {
    const Lists& neighbours = shell.topology.neighbours;
    std::vector<char> near(idx(shell.rest.rows()), 0);
    for (const int t : triangles)
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

// Parts that can be worked on at once: what could cut each other comes first, in one group.
std::vector<std::vector<int>> grouped(const Ground& ground, const std::vector<std::vector<int>>& parts) {
    std::vector<char> could_cut(idx(ground.shell.rest.rows()), 0);
    for (const int t : ground.beside_cuts)
        for (int k = 0; k < 3; ++k) could_cut[idx(ground.shell.triangles(t, k))] = 1;
    std::vector<std::vector<int>> groups(1);
    for (const std::vector<int>& part : parts)
        if (std::ranges::any_of(part, [&](int i) { return could_cut[idx(i)] != 0; }))
            groups[0].insert(groups[0].end(), part.begin(), part.end());
        else
            groups.push_back(part);
    return groups;
}

using Pairs = std::vector<std::array<int, 2>>;

// Which part each vertex belongs to, or -1.
struct PartOf {
    const Triangles& triangles;
    std::vector<int> vertex;
    std::size_t count = 0; // of parts

    std::vector<int> at(const std::array<int, 2>& pair) const {
        std::vector<int> result;
        for (const int t : pair)
            for (int k = 0; k < 3; ++k)
                if (const int own = vertex[idx(triangles(t, k))]; own >= 0) result.push_back(own);
        std::sort(result.begin(), result.end());
        result.erase(std::unique(result.begin(), result.end()), result.end());
        return result;
    }
    std::vector<long> counted(const Pairs& pairs) const {
        std::vector<long> result(count, 0);
        for (const auto& pair : pairs)
            for (const int own : at(pair)) ++result[idx(own)];
        return result;
    }
};

// The vertices of the pairs that have come to parts with more pairs than before go back; says whether any did.
bool take_back(const PartOf& parts, const Pairs& before, const Pairs& after, const Points& x, Points& now) {
    const std::vector<long> count_before = parts.counted(before), count = parts.counted(after);
    bool any = false;
    for (const auto& pair : after) {
        if (std::binary_search(before.begin(), before.end(), pair)) continue;
        for (const int t : pair)
            for (int k = 0; k < 3; ++k) {
                const int i = parts.triangles(t, k), own = parts.vertex[idx(i)];
                if (own < 0 || count[idx(own)] <= count_before[idx(own)] || now.row(i) == x.row(i)) continue;
                now.row(i) = x.row(i);
                any = true;
            }
    }
    return any;
}

// No part cuts more than it did, be it all that cuts or what the shapes do not cut themselves.
void take_back_cuts(TangleSearch& search, const std::vector<std::vector<int>>& parts, const Points& x, Points& now) {
    const Triangles& triangles = search.shell.triangles;
    PartOf part{triangles, std::vector<int>(idx(x.rows()), -1), parts.size()};
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (const int i : parts[k]) part.vertex[idx(i)] = static_cast<int>(k);
    const std::vector<char> asked = touched(search.shell, x, now);
    const Pairs before = all_cuts(x, triangles, asked), new_before = without_known(search, x, before);
    for (bool back = true; back;) {
        const Pairs after = all_cuts(now, triangles, asked);
        back = take_back(part, before, after, x, now);
        if (!back) back = take_back(part, new_before, without_known(search, now, after), x, now);
    }
}

// Flips as FacingWatch has them.
Points nudged_within(TangleSearch& search, const Points& positions, Tangles faults, const Rounds& rounds,
                     std::span<const Pin> pins, bool leave) {
    const Shell& shell = search.shell;
    FacingWatch watch(shell.triangles, search.target, EdgeSides::both);
    const Ground ground = ground_of(shell, search.target, pins, positions, faults, leave);
    Points best = positions, x = positions;
    std::size_t fewest = faults.count();
    for (int round = 0, idle = 0; round < rounds.most && idle < rounds.patient && faults.count() > 0; ++round, ++idle) {
        Points now = x;
        const std::vector<std::vector<int>> parts = parts_around(shell, faulty(faults));
        const std::vector<std::vector<int>> groups = grouped(ground, parts);
        parallel_for(
            std::ssize(groups),
            [&](std::ptrdiff_t k) {
                const std::vector<int> none;
                for (const int vertex : groups[idx(k)])
                    to_best_place(ground, k == 0 ? ground.beside_cuts : none, now, vertex, rounds.wide && idle % 2 == 1,
                                  round * golden_angle);
            },
            1);
        take_back_cuts(search, parts, x, now);
        faults.flips = watch.into(now);
        if (rounds.cuts) faults.cuts = new_cuts(search, now, faults.cuts, touched(shell, x, now));
        x = std::move(now);
        if (faults.count() >= fewest) continue;
        fewest = faults.count();
        idle = -1;
        best = x;
    }
    return best;
}

// The same for the region's numbers, without what lies outside.
Pairs within(const Region& region, const Pairs& pairs) {
    Pairs result;
    for (const auto& pair : pairs)
        if (const int s = region.triangle(pair[0]), t = region.triangle(pair[1]); s >= 0 && t >= 0)
            result.push_back({s, t});
    return result;
}

std::vector<Pin> within(const Region& region, std::span<const Pin> pins) {
    std::vector<Pin> result;
    for (const Pin& pin : pins)
        if (const int t = region.triangle(pin.where.triangle); t >= 0) {
            result.push_back(pin);
            result.back().where.triangle = t;
        }
    return result;
}

} // namespace

Nudged nudge(TangleSearch& search, const Points& positions, const Tangles& before, std::span<const Pin> pins,
             bool leave, const std::vector<int>& places) {
    const Shell& shell = search.shell;
    Tangles faults{
        FacingWatch(shell.triangles, search.target, EdgeSides::both, at_first_corners(shell.triangles, places))
            .into(positions),
        before.cuts};
    const Rounds rounds = faults.count() > few_faults ? for_many : for_few;
    if (!rounds.cuts) faults.cuts.clear();
    if (faults.count() == 0) return {positions, before};
    const Region region = region_around(shell, positions, faulty(faults));
    TangleSearch near{region.shell, search.target, {}};
    if (search.known) near.known = KnownCuts{within(region, search.known->source), search.known->target};
    faults.cuts = within(region, faults.cuts);
    for (int& t : faults.flips) t = region.triangle(t);
    const Points moved = nudged_within(near, positions(region.vertices, Eigen::all), std::move(faults), rounds,
                                       within(region, pins), leave);
    Points best = positions;
    best(region.vertices, Eigen::all) = moved;
    return {best, tangles(search, best, before, touched(shell, positions, best))};
}

} // namespace meshtween
