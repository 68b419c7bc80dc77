// The paper's mapping (section 2): a thin-plate warp of the markers (Eq. 1-5), then rounds of smoothing (Eq. 6) and
// projection to the closest compatible point until the distance (Eq. 7) is small. Four things keep the rounds from
// folding the mesh, creeping along the surface and losing detail:
// - smoothing weakens from round to round, but stays at full strength, and grows in reach, around triangles that still
//   look against the target, so that folds open and the rest keeps its detail;
// - no step turns a triangle over (project.h);
// - a warp of what the markers are off by takes them back every round, softly;
// - vertices without a compatible point follow their neighbours.
#include "meshtween/fit/paper_fit.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/fit/project.h"
#include "meshtween/fit/smooth.h"
#include "meshtween/geometry/measure.h"

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

using Eigen::Index;

constexpr double first_strength = 0.3, last_strength = 0.02; // of smoothing, falling by a constant factor a round
constexpr double near_rim = 0.03;         // parts of the target's size within which boundaries belong together
constexpr double looks_away = 0.1;        // cosine to the target's normal under which a triangle needs smoothing
constexpr double held_softly = 1e-3;      // smoothing of the warp that takes markers back
constexpr std::size_t many_markers = 300; // from here on the O(N^3) warp runs in one round of eight

std::size_t at(Index i) {
    return static_cast<std::size_t>(i);
}

struct MarkerPoints {
    Points source, target; // a row a marker
    std::vector<std::string> names;
};

MarkerPoints marker_points(const Points& positions, const Triangles& triangles, std::span<const Marker> markers) {
    MarkerPoints points{Points(markers.size(), 3), Points(markers.size(), 3), {}};
    for (std::size_t i = 0; i < markers.size(); ++i) {
        points.source.row(static_cast<Index>(i)) = position(positions, triangles, markers[i].source);
        points.target.row(static_cast<Index>(i)) = markers[i].target;
        points.names.push_back(markers[i].name);
    }
    return points;
}

Triangles turned_over(Triangles triangles) {
    triangles.col(1).swap(triangles.col(2));
    return triangles;
}

// Whether most of the template looks against the surface that it should become: one of the two is inside out.
bool looks_against(const Points& positions, const Triangles& triangles, const ClosestPointIndex& index) {
    const Points normals = vertex_normals(positions, triangles);
    const std::vector<ClosestPoint> hits = index.closest(positions);
    const double agreement = parallel_sum(positions.rows(), 0.0, [&](Index i) {
        return normals.row(i).dot(index.normals().row(hits[at(i)].where.triangle));
    });
    return agreement < 0;
}

// Takes the markers back to their places by a warp of what they are off by.
Points hold_markers(const Points& positions, const Triangles& triangles, std::span<const Marker> markers,
                    RbfOptions options) {
    const MarkerPoints now = marker_points(positions, triangles, markers);
    options.smoothing = std::max(options.smoothing, held_softly);
    try {
        return warp(now.source, now.target, options)(positions);
    } catch (const Error&) { // two markers met on a fold: the fold has to open first
        return positions;
    }
}

// How much smoothing each vertex needs beyond the schedule's: 1 at triangles that look against the target and at
// vertices without a goal, less over `rings` rings around them, and fading where the trouble is over.
std::vector<double> trouble(const Points& positions, const Triangles& triangles, const Surroundings& around,
                            const Goals& goals, const std::vector<double>& before, int rings) {
    constexpr double a_ring = 0.7, a_round = 0.5;
    std::vector<char> bad(at(triangles.rows()));
    parallel_for(triangles.rows(), [&](Index t) {
        const Point want = goals.normals.row(triangles(t, 0)) + goals.normals.row(triangles(t, 1)) +
                           goals.normals.row(triangles(t, 2));
        const Point n = double_area_normal(positions, triangles, t);
        bad[at(t)] = !(n.dot(want) > looks_away * n.norm() * want.norm());
    });
    std::vector<double> need(at(positions.rows()));
    parallel_for(positions.rows(), [&](Index i) {
        const auto triangles_here = around.topology.vertex_triangles[i];
        const bool is = std::any_of(triangles_here.begin(), triangles_here.end(), [&](int t) { return bad[at(t)]; });
        need[at(i)] = is || !goals.found(i) ? 1 : 0;
    });
    for (int ring = 0; ring < rings; ++ring) {
        const std::vector<double> inner = need;
        parallel_for(positions.rows(), [&](Index i) {
            for (const int j : around.topology.neighbours[i])
                need[at(i)] = std::max(need[at(i)], a_ring * inner[at(j)]);
        });
    }
    for (std::size_t i = 0; i < need.size(); ++i) need[i] = std::max(need[i], a_round * before[i]);
    return need;
}

Points blend(const Points& from, const Points& to, const std::vector<double>& part, double least) {
    Points result(from.rows(), 3);
    parallel_for(from.rows(), [&](Index i) {
        result.row(i) = from.row(i) + std::max(least, part[at(i)]) * (to.row(i) - from.row(i));
    });
    return result;
}

// sqrt(E / n) of Eq. 7 over the vertices that have a goal, parts of the diagonal.
double distance_to_goals(const Points& positions, const Goals& goals, double diagonal) {
    const double sum = parallel_sum(positions.rows(), 0.0, [&](Index i) {
        return goals.found(i) ? (goals.positions.row(i) - positions.row(i)).squaredNorm() : 0.0;
    });
    const auto n = std::count_if(goals.triangles.begin(), goals.triangles.end(), [](int t) { return t >= 0; });
    return n > 0 ? std::sqrt(sum / static_cast<double>(n)) / diagonal : 0;
}

struct Loop {
    const Mesh& source;
    std::span<const Marker> markers;
    const FitOptions& options;
    Surroundings around;
    TargetSurface target;
    std::vector<char> attached;
    Points positions;
    std::vector<double> need;
    std::vector<int> hints;
};

void run_round(Loop& loop, FitResult& result, int round) {
    const Triangles& triangles = loop.source.triangles;
    const double along = loop.options.max_rounds > 1 ? round / (loop.options.max_rounds - 1.0) : 1;
    const double strength = first_strength * std::pow(last_strength / first_strength, along);
    const int passes = 1 + round / 3, rings = 1 + round / 10; // only trouble that lasts sees the later ones
    for (int pass = 0; pass < passes; ++pass)
        loop.positions =
            blend(loop.positions, smooth(loop.positions, triangles, loop.around), loop.need, pass == 0 ? strength : 0);
    if (loop.markers.size() < many_markers || round % 8 == 7)
        loop.positions = hold_markers(loop.positions, triangles, loop.markers, loop.options.warp);

    GoalOptions compatible;
    compatible.least_cosine = loop.options.least_cosine;
    const Goals goals =
        closest_compatible(loop.positions, triangles, loop.around, loop.target, loop.attached, compatible, loop.hints);
    result.history.push_back(distance_to_goals(loop.positions, goals, loop.target.diagonal));
    GuardedStep step = guarded_step(loop.positions, goals.positions, goals.normals, triangles);
    loop.positions = std::move(step.positions);
    result.refused_steps += step.shortened;
    loop.need = trouble(loop.positions, triangles, loop.around, goals, loop.need, rings);
    loop.hints = goals.triangles;
}

// Without smoothing, so that what is left is as near to the surface as the guard allows.
void last_projection(Loop& loop, FitResult& result) {
    GoalOptions compatible;
    compatible.least_cosine = loop.options.least_cosine;
    const Goals goals = closest_compatible(loop.positions, loop.source.triangles, loop.around, loop.target,
                                           loop.attached, compatible, loop.hints);
    GuardedStep step = guarded_step(loop.positions, goals.positions, goals.normals, loop.source.triangles);
    loop.positions = std::move(step.positions);
    result.refused_steps += step.shortened;
}

} // namespace

FitResult paper_fit(const Mesh& source, const Mesh& target, std::span<const Marker> markers, const FitOptions& options,
                    const Progress& progress) {
    FitResult result;
    const MarkerPoints start = marker_points(source.positions, source.triangles, markers);
    Points warped = warp(start.source, start.target, options.warp, start.names)(source.positions);
    Loop loop{source,
              markers,
              options,
              surroundings(source.positions.rows(), source.triangles),
              target_surface(target.positions, target.triangles),
              {},
              std::move(warped),
              std::vector<double>(at(source.positions.rows()), 0),
              {}};
    if (looks_against(loop.positions, source.triangles, loop.target.index)) {
        loop.target = target_surface(target.positions, turned_over(target.triangles));
        result.notes.emplace_back("the target looks the other way than the source (one of them is inside out); it was "
                                  "taken turned over");
    }
    loop.attached = attached_boundary(loop.positions, source.triangles, loop.around, loop.target, near_rim);

    while (result.end == FitEnd::out_of_rounds && result.rounds < options.max_rounds) {
        if (!keep_going(progress, result.rounds / (options.max_rounds + 1.0), "smoothing and projecting")) {
            result.end = FitEnd::cancelled;
            break;
        }
        if (options.watch) options.watch(loop.positions);
        run_round(loop, result, result.rounds++);
        if (result.history.back() <= options.threshold) result.end = FitEnd::converged;
    }
    last_projection(loop, result);
    const std::vector<ClosestPoint> nearest = loop.target.index.closest(loop.positions);
    result.error = parallel_sum(loop.positions.rows(), 0.0, [&](Index i) { return nearest[at(i)].squared_distance; }) /
                   (loop.target.diagonal * loop.target.diagonal); // Eq. 7
    result.positions = std::move(loop.positions);
    keep_going(progress, 1, "fitted");
    return result;
}

} // namespace meshtween
