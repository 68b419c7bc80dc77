// What is wanting is a length: at a triangle that looks into the target the detour to where it would look along it, at
// a cut how far two triangles reach through each other. It falls little by little, so that vertices which mend nothing
// alone do so together.
#include "meshtween/fit/nudge.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/counterpart.h"
#include "meshtween/fit/cut_guard.h"
#include "meshtween/fit/facing.h"
#include "meshtween/fit/fan.h"
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
constexpr std::size_t tried_together = 8;        // places, one after another
constexpr double none = std::numeric_limits<double>::infinity();
// Above and below the target, in mean edges around a vertex, where it may leave it: a flat triangle whose corners lie
// on both sides of a valley or a thin sheet comes off the wrong wall so.
constexpr std::array heights{0.0, 0.1, -0.1, 0.2, -0.2};
// In all, and in a row that mend nothing further. Where more than a few faults are left the shapes are not alike: their
// cuts stay, and the flips get less of the time.
struct Rounds {
    int most, patient;
    bool wide, cuts;
};
constexpr Rounds for_few{100, 12, true, true}, for_many{10, 3, false, false};

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

using Box = Eigen::AlignedBox3d;

std::vector<int> faulty(const Tangles& faults) {
    std::vector<int> triangles = faults.flips;
    for (const auto& pair : faults.cuts) triangles.insert(triangles.end(), pair.begin(), pair.end());
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    return triangles;
}

// What does not move.
struct Ground {
    FanGround fans;
    std::vector<int> beside_cuts; // triangles: what could cut each other
    bool leave = false;           // vertices may leave the target
};

Ground ground_of(const Shell& shell, const FitTarget& target, std::span<const Pin> pins, const Points& positions,
                 const Tangles& faults, bool leave) {
    Ground ground{{shell, target, {pins.begin(), pins.end()}, 0}, beside_cuts(shell, faults.cuts), leave};
    std::ranges::stable_sort(ground.fans.pins, {}, [](const Pin& p) { return p.where.triangle; });
    const std::vector<int> triangles = faulty(faults);
    double& unit = ground.fans.unit;
    for (const int t : triangles) unit += std::sqrt(double_area_normal(positions, shell.triangles, t).norm());
    unit /= static_cast<double>(triangles.size());
    return ground;
}

// Places on the target that a vertex tries, its own first.
std::vector<ClosestPoint> places_to_try(const Ground& ground, const Points& x, Eigen::Index vertex, double shortest,
                                        double mean, bool wide, double turn) {
    const ClosestPointIndex& index = ground.fans.target.index;
    const auto neighbours = ground.fans.shell.topology.neighbours[vertex];
    const Point start = x.row(vertex);
    std::vector<ClosestPoint> places{index.closest(start)};
    const SurfacePoint here = places[0].where;
    const Point looks = normal_at(ground.fans.target, here), normal = looks.isZero(0) ? Point(0, 0, 1) : looks,
                u = normal.unitOrthogonal(), v = normal.cross(u); // where sheets meet back to back nothing tells
    for (const double step : wide ? wide_steps : small_steps)
        for (int k = 0; k < directions; ++k) {
            const double angle = turn + 2 * EIGEN_PI * k / directions;
            const Point way = std::cos(angle) * u + std::sin(angle) * v;
            places.push_back(index.closest(Point(start + step * (wide ? mean : shortest) * way), here.triangle));
        }
    if (!wide) return places;
    Point middle(0, 0, 0);
    for (const int j : neighbours) middle += x.row(j) / static_cast<double>(neighbours.size());
    places.push_back(index.closest(middle));
    for (const int j : neighbours) places.push_back(index.closest(Point(start + to_neighbour * (x.row(j) - start))));
    return places;
}

// Where the vertex does best, of some places around its own.
Point best_place(const Ground& ground, const std::vector<int>& sheets, const Points& x, Eigen::Index vertex, bool wide,
                 double turn) {
    const auto neighbours = ground.fans.shell.topology.neighbours[vertex];
    const Point start = x.row(vertex);
    double shortest = std::numeric_limits<double>::infinity(), mean = 0;
    for (const int j : neighbours) {
        const double length = (x.row(j) - start).norm();
        shortest = std::min(shortest, length);
        mean += length / static_cast<double>(neighbours.size());
    }
    const Fan fan = fan_around(ground.fans, x, vertex, sheets, mean); // steps and heights do not lead further off
    if (fan.wanting < fault_costs) return x.row(vertex);              // nothing is wanting there
    const std::vector<ClosestPoint> places = places_to_try(ground, x, vertex, shortest, mean, wide, turn);
    const double own_height = std::sqrt(places[0].squared_distance);
    struct Best {
        Point place;
        double cost = 0;
    };
    std::vector<Best> best((places.size() + tried_together - 1) / tried_together,
                           {start, wanting(ground.fans, fan, start, own_height, none)});
    parallel_for(
        std::ssize(best),
        [&](std::ptrdiff_t b) {
            Best& own = best[idx(b)];
            for (std::size_t k = idx(b) * tried_together; k < std::min(places.size(), (idx(b) + 1) * tried_together);
                 ++k) {
                const Point up = mean * normal_at(ground.fans.target, places[k].where);
                for (const double height : std::span(heights).first(ground.leave ? heights.size() : 1)) {
                    const Point place = places[k].position + height * up;
                    if (!bearable(fan, place)) continue;
                    const double cost = wanting(ground.fans, fan, place, height * mean, own.cost);
                    if (cost < own.cost) own = {place, cost};
                }
            }
        },
        1);
    return std::ranges::min_element(best, {}, &Best::cost)->place;
}

// The vertices of these triangles and their neighbours, in connected parts. The border stays, and what lies beyond the
// target's.
std::vector<std::vector<int>> parts_around(const TangleSearch& search, const std::vector<int>& triangles) {
    const Shell& shell = search.shell;
    const Lists& neighbours = shell.topology.neighbours;
    std::vector<char> near(idx(shell.rest.rows()), 0);
    for (const int t : triangles)
        for (int k = 0; k < 3; ++k) {
            near[idx(shell.triangles(t, k))] = 1;
            for (const int j : neighbours[shell.triangles(t, k)]) near[idx(j)] = 1;
        }
    for (std::size_t i = 0; i < near.size(); ++i)
        if (shell.topology.on_boundary[i] || is_beyond(search, static_cast<int>(i))) near[i] = 0;
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

// What one thread works on.
struct Group {
    std::vector<int> vertices;
    std::vector<int> sheets; // triangles that they could cut
};

// Parts that could cut each other are one group: those beside cuts that are near each other. No group asks where the
// vertices of another are.
std::vector<Group> grouped(const Ground& ground, const Points& x, const std::vector<std::vector<int>>& parts) {
    const Shell& shell = ground.fans.shell;
    const double unit = ground.fans.unit;
    std::vector<int> group_of(idx(shell.rest.rows()), -1);
    std::vector<char> could_cut(group_of.size(), 0);
    for (const int t : ground.beside_cuts)
        for (int k = 0; k < 3; ++k) could_cut[idx(shell.triangles(t, k))] = 1;
    std::vector<Group> groups;
    std::vector<Box> boxes; // of the groups
    for (const std::vector<int>& part : parts) {
        Group group{part, {}};
        Box box;
        if (std::ranges::any_of(part, [&](int i) { return could_cut[idx(i)] != 0; }))
            for (const int i : part) {
                box.extend(x.row(i).transpose());
                for (const int j : shell.topology.neighbours[i]) box.extend(x.row(j).transpose());
            }
        for (std::size_t k = groups.size(); !box.isEmpty() && k-- > 0;) {
            const Box wider(boxes[k].min().array() - unit, boxes[k].max().array() + unit);
            if (boxes[k].isEmpty() || !wider.intersects(box)) continue;
            group.vertices.insert(group.vertices.begin(), groups[k].vertices.begin(), groups[k].vertices.end());
            box.extend(boxes[k]);
            groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(k));
            boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(k));
            k = groups.size(); // the box has grown
        }
        groups.push_back(std::move(group));
        boxes.push_back(box);
    }
    for (std::size_t k = 0; k < groups.size(); ++k)
        for (const int i : groups[k].vertices) group_of[idx(i)] = static_cast<int>(k);
    for (std::size_t k = 0; k < groups.size(); ++k) {
        if (boxes[k].isEmpty()) continue;
        const auto own = static_cast<int>(k);
        std::copy_if(
            ground.beside_cuts.begin(), ground.beside_cuts.end(), std::back_inserter(groups[k].sheets), [&](int t) {
                return std::ranges::all_of(shell.triangles.row(t),
                                           [&](int i) { return group_of[idx(i)] == own || group_of[idx(i)] < 0; });
            });
    }
    return groups;
}

// Of a fit with so many faults, cuts among them, a round takes seconds and mends a few flips at most.
bool has_failed(const Tangles& faults, const Triangles& triangles) {
    constexpr double share = 0.05;
    return faults.count() > many_faults &&
           static_cast<double>(faults.count()) > share * static_cast<double>(triangles.rows());
}

// Takes a round's vertices from what is left.
bool afford(MendingEffort* effort, const std::vector<std::vector<int>>& parts) {
    if (effort == nullptr) return true;
    double vertices = 0;
    for (const std::vector<int>& part : parts) vertices += static_cast<double>(part.size());
    if (vertices > effort->nudges) return false;
    effort->nudges -= vertices;
    return true;
}

struct Outcome {
    Points positions;
    bool cancelled = false;
};

// Flips as FacingWatch has them.
Outcome nudged_within(TangleSearch& search, const Points& positions, Tangles faults, const Rounds& rounds,
                      std::span<const Pin> pins, bool leave, const Progress& progress) {
    const Shell& shell = search.shell;
    FacingWatch watch(shell.triangles, search.target, EdgeSides::both);
    const Ground ground = ground_of(shell, search.target, pins, positions, faults, leave);
    Cuts cuts = cuts_of(search, positions);
    Outcome best{positions};
    Points x = positions;
    std::size_t fewest = faults.count();
    for (int round = 0, idle = 0; round < rounds.most && idle < rounds.patient && faults.count() > 0; ++round, ++idle) {
        best.cancelled = !keep_going(progress, static_cast<double>(round) / rounds.most, "mending");
        if (best.cancelled) break;
        Points now = x;
        const std::vector<std::vector<int>> parts = parts_around(search, faulty(faults));
        if (!afford(search.effort, parts)) break;
        const std::vector<Group> groups = grouped(ground, x, parts);
        parallel_for(
            std::ssize(groups),
            [&](std::ptrdiff_t k) {
                const Group& group = groups[idx(k)];
                for (const int i : group.vertices)
                    now.row(i) =
                        best_place(ground, group.sheets, now, i, rounds.wide && idle % 2 == 1, round * golden_angle);
            },
            1);
        cuts = take_back_cuts(search, parts, x, cuts, now);
        faults.flips = without_beyond(shell.triangles, search.beyond, watch.into(now));
        if (rounds.cuts) faults.cuts = cuts.fresh;
        x = std::move(now);
        if (faults.count() >= fewest) continue;
        fewest = faults.count();
        idle = -1;
        best.positions = x;
    }
    return best;
}

// The same for the region's numbers, without what lies outside.
CutPairs within(const Region& region, const CutPairs& pairs) {
    CutPairs result;
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
             bool leave, const std::vector<int>& places, const Progress& progress) {
    const Shell& shell = search.shell;
    if (!search.facing)
        search.facing.emplace(shell.triangles, search.target, EdgeSides::both,
                              at_first_corners(shell.triangles, places));
    Tangles faults{without_beyond(shell.triangles, search.beyond, search.facing->into(positions)), before.cuts};
    if (has_failed(faults, shell.triangles)) return {positions, before};
    const Rounds& rounds = faults.count() > few_faults ? for_many : for_few;
    if (!rounds.cuts) faults.cuts.clear();
    if (faults.count() == 0) return {positions, before};
    const Region region = region_around(shell, positions, faulty(faults));
    TangleSearch near{region.shell, search.target, {}, {}, {}, search.effort};
    if (search.known) near.known = KnownCuts{within(region, search.known->source), search.known->target};
    if (!search.beyond.empty())
        for (const int i : region.vertices) near.beyond.push_back(search.beyond[idx(i)]);
    faults.cuts = within(region, faults.cuts);
    for (int& t : faults.flips) t = region.triangle(t);
    const auto [moved, cancelled] = nudged_within(near, positions(region.vertices, Eigen::all), std::move(faults),
                                                  rounds, within(region, pins), leave, progress);
    Points best = positions;
    best(region.vertices, Eigen::all) = moved;
    return {best, tangles(search, best, before, touched(shell, positions, best)), cancelled};
}

} // namespace meshtween
