// Projection with a guard. Refusing steps that turn triangles over: as in research on remeshing (Botsch, Kobbelt: A
// remeshing approach to multiresolution modeling, SGP 2004), here by halving the step.
#include "meshtween/fit/settle.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/counterpart.h"
#include "meshtween/fit/facing.h"
#include "meshtween/geometry/measure.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <iterator>
#include <numeric>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

struct Goals {
    Points positions, normals; // normals are zero where there is none
    std::vector<int> places;   // n: the triangle of the last answer, a hint for the next; -1 for none
};

// Vertices that pins lie at: where they belong is known.
std::vector<char> named_by(std::span<const Pin> pins, const Shell& shell) {
    std::vector<char> named(shell.area.size(), 0);
    for (const Pin& pin : pins)
        for (int k = 0; k < 3; ++k)
            if (pin.where.barycentric[k] > 0.5) named[idx(shell.triangles(pin.where.triangle, k))] = 1;
    return named;
}

// What is known of vertices beforehand, a flag each; `beyond` may be empty.
struct Known {
    std::vector<char> named, beyond;
};

// Brings the goals of the vertices in `asked` up to date.
void find_goals(const Shell& shell, const Points& positions, const FitTarget& target, const Known& known,
                const SettleOptions& options, const std::vector<int>& asked, Goals& goals) {
    const Points normals = vertex_normals(positions, shell.triangles);
    const Points directions = border_directions(positions, shell.border);
    parallel_for(
        std::ssize(asked),
        [&](std::ptrdiff_t k) {
            const Eigen::Index i = asked[idx(k)];
            goals.positions.row(i) = positions.row(i);
            goals.normals.row(i).setZero();
            if (has_border(shell, i)) {
                const ClosestPoint rim =
                    closest_on_border(target, positions.row(i), directions.row(i), shell.border_size[idx(i)]);
                if (rim.found() && rim.squared_distance <= options.reach * options.reach) {
                    goals.positions.row(i) = rim.position;
                    goals.normals.row(i) = normals.row(i);
                    return;
                }
            }
            const bool named = known.named[idx(i)] != 0;
            if (!named && !known.beyond.empty() && known.beyond[idx(i)]) return;
            const Compatible compatible = named ? Compatible{} : Compatible{normals.row(i), options.least_cosine};
            int& hint = goals.places[idx(i)];
            const ClosestPoint closest = target.index.closest(Point(positions.row(i)), compatible, options.reach, hint);
            if (!closest.found()) return;
            hint = closest.where.triangle;
            if (!has_border(shell, i) && on_border(target, closest.where)) return;
            goals.positions.row(i) = closest.position;
            goals.normals.row(i) = target.index.normals().row(closest.where.triangle);
        },
        64);
}

// The steps shortened until no triangle that looked along the surface's normals at its corners looks against them.
Points guarded(const Shell& shell, const Points& from, const Goals& to, std::vector<int>& refused) {
    const Triangles& triangles = shell.triangles;
    std::vector<double> share(idx(from.rows()), 1.0);
    Points now = to.positions;
    std::vector<char> bad(idx(triangles.rows()));
    constexpr int halvings = 4;
    for (int round = 0; round <= halvings; ++round) {
        parallel_for(triangles.rows(), [&](std::ptrdiff_t t) {
            const Point outward =
                to.normals.row(triangles(t, 0)) + to.normals.row(triangles(t, 1)) + to.normals.row(triangles(t, 2));
            bad[idx(t)] = double_area_normal(now, triangles, t).dot(outward) < 0 &&
                          double_area_normal(from, triangles, t).dot(outward) > 0;
        });
        std::vector<char> shorten(share.size(), 0);
        for (std::ptrdiff_t t = 0; t < triangles.rows(); ++t)
            if (bad[idx(t)])
                for (int k = 0; k < 3; ++k) shorten[idx(triangles(t, k))] = 1;
        bool any = false;
        for (std::size_t i = 0; i < share.size(); ++i) {
            if (!shorten[i]) continue;
            any = true;
            share[i] = round == halvings ? 0 : share[i] / 2;
            const auto row = static_cast<Eigen::Index>(i);
            now.row(row) = from.row(row) + share[i] * (to.positions.row(row) - from.row(row));
        }
        if (!any) break;
    }
    refused.clear();
    for (std::size_t i = 0; i < share.size(); ++i)
        if (share[i] < 1) refused.push_back(static_cast<int>(i));
    return now;
}

// Vertices of these triangles and of their neighbours go halfway to the mean of theirs, but for those held.
Points relaxed_around(const Shell& shell, const Points& positions, const std::vector<int>& triangles, int rings,
                      const std::vector<char>& held) {
    std::vector<char> chosen(idx(positions.rows()), 0);
    for (const int t : triangles)
        for (int k = 0; k < 3; ++k) chosen[idx(shell.triangles(t, k))] = 1;
    for (int ring = 0; ring < rings; ++ring) {
        std::vector<char> wider = chosen;
        for (std::ptrdiff_t i = 0; i < positions.rows(); ++i)
            if (chosen[idx(i)])
                for (const int j : shell.topology.neighbours[i]) wider[idx(j)] = 1;
        chosen.swap(wider);
    }
    Points result = positions;
    for (std::ptrdiff_t i = 0; i < positions.rows(); ++i) {
        const auto list = shell.topology.neighbours[i];
        if (!chosen[idx(i)] || held[idx(i)] || list.empty() || shell.topology.on_boundary[idx(i)]) continue;
        Point mean(0, 0, 0);
        for (const int j : list) mean += positions.row(j);
        result.row(i) = 0.5 * (positions.row(i) + mean / static_cast<double>(list.size()));
    }
    return result;
}

} // namespace

std::vector<int> flipped_triangles(const Points& positions, const Triangles& triangles, const FitTarget& target,
                                   const std::vector<int>& places) {
    return FacingWatch(triangles, target, EdgeSides::one, at_first_corners(triangles, places)).into(positions);
}

Settled settle(const Shell& shell, const Points& positions, const FitTarget& target, std::span<const Pin> pins,
               const std::vector<char>& beyond, const SettleOptions& options) {
    const Known known{named_by(pins, shell), beyond};
    const Eigen::Index n = positions.rows();
    Goals goals{positions, Points::Zero(n, 3), std::vector<int>(idx(n), -1)};
    std::vector<int> asked(idx(n));
    std::iota(asked.begin(), asked.end(), 0);
    find_goals(shell, positions, target, known, options, asked, goals);
    Settled result;
    result.positions = guarded(shell, positions, goals, result.refused);
    FacingWatch facing(shell.triangles, target, EdgeSides::one, at_first_corners(shell.triangles, goals.places));
    const auto flips = [&](const Points& x) { return without_beyond(shell.triangles, beyond, facing.into(x)); };
    result.flipped = flips(result.positions);
    const std::vector<int> before = result.flipped;
    Points trial = result.positions;
    std::vector<int> looking = result.flipped, refused = result.refused;
    for (int round = 0; round < options.mending_rounds && !result.flipped.empty(); ++round) {
        const Points relaxed = relaxed_around(shell, trial, looking, 1, known.named);
        asked = std::move(refused); // those on their way, and those that moved
        for (Eigen::Index i = 0; i < n; ++i)
            if (relaxed.row(i) != trial.row(i)) asked.push_back(static_cast<int>(i));
        std::sort(asked.begin(), asked.end());
        asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
        find_goals(shell, relaxed, target, known, options, asked, goals);
        trial = guarded(shell, relaxed, goals, refused);
        looking = flips(trial);
        if (looking.size() >= result.flipped.size()) continue;
        result.flipped = looking;
        result.positions = trial;
    }
    std::set_difference(before.begin(), before.end(), result.flipped.begin(), result.flipped.end(),
                        std::back_inserter(result.mended));
    result.places = std::move(goals.places);
    return result;
}

} // namespace meshtween
