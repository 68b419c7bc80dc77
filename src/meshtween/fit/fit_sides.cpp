#include "meshtween/fit/fit_sides.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/marker_noise.h"
#include "meshtween/fit/marker_twins.h"

#include <utility>

namespace meshtween {
namespace {

// Pins for the markers' mirror twins, behind those of the markers.
void add_twins(const Points& rest, const Triangles& triangles, const FitTarget& target, std::vector<Pin>& pins) {
    Points from(std::ssize(pins), 3), to(std::ssize(pins), 3);
    for (std::size_t k = 0; k < pins.size(); ++k) {
        from.row(static_cast<Eigen::Index>(k)) = position(rest, triangles, pins[k].where);
        to.row(static_cast<Eigen::Index>(k)) = pins[k].target;
    }
    const std::vector<MarkerTwin> twins =
        marker_twins(rest, triangles, target.positions, target.triangles, target.index, from, to);
    for (const MarkerTwin& twin : twins) pins.push_back({twin.source, {0, 0, 0}, twin.target, twin.weight, twin.slack});
}

// On each level where the finest's nearest border vertex is cut off.
void end_borders(ShellLevels& shells, const std::vector<int>& cut_off) {
    const Shell& finest = shells.shells[0];
    std::vector<char> flags(finest.area.size(), 0);
    for (const int v : cut_off) flags[static_cast<std::size_t>(v)] = 1;
    const Triangles border = finest.border;
    if (border.rows() == 0) return;
    const ClosestPointIndex index(finest.rest, border);
    for (Shell& shell : shells.shells) {
        std::vector<char> own(shell.area.size(), 0);
        for (const auto edge : shell.border.rowwise()) {
            const SurfacePoint nearest = index.closest(Point(shell.rest.row(edge[0]))).where;
            const int end = nearest.barycentric[0] > 0.5 ? 0 : 1; // of an edge (a, b, b)
            own[static_cast<std::size_t>(edge[0])] = flags[static_cast<std::size_t>(border(nearest.triangle, end))];
        }
        end_borders(shell, own);
    }
}

} // namespace

std::vector<Pin> pins_of(std::span<const Marker> markers, const Points& goals) {
    std::vector<Pin> pins;
    for (std::size_t k = 0; k < markers.size(); ++k)
        pins.push_back({markers[k].source, {0, 0, 0}, goals.row(static_cast<Eigen::Index>(k)), 1, 0});
    return pins;
}

void set_all_pins(const Points& rest, const Triangles& triangles, std::vector<Pin> pins, bool with_twins,
                  FitSides& sides) {
    if (with_twins) add_twins(rest, triangles, *sides.target, pins);
    set_pins(sides.shells, pins);
}

Points without_noise(const Points& rest, const Triangles& triangles, const Points& free, std::span<const Pin> pins,
                     const FitSides& sides) {
    Points from(std::ssize(pins), 3), now = from, to = from;
    for (std::size_t k = 0; k < pins.size(); ++k) {
        const auto row = static_cast<Eigen::Index>(k);
        from.row(row) = position(rest, triangles, pins[k].where);
        now.row(row) = position(free, triangles, pins[k].where);
        to.row(row) = pins[k].target;
    }
    return marker_goals(now + smooth_misfits(from, to - now, sides.marker_noise), *sides.target).places;
}

// Both sides at once, for much of the source's is one thread's work.
FitSides fit_sides(const Points& rest, const Triangles& triangles, const Renumbered& target,
                   std::span<const Marker> markers, Points& goals, bool with_twins, const std::vector<int>& cut_off) {
    FitSides sides;
    const auto prepare_target = [&] {
        sides.target.emplace(fit_target(target.positions, target.triangles));
        MarkerGoals on_target = marker_goals(goals, *sides.target);
        sides.marker_noise = on_target.noise;
        goals = std::move(on_target.places);
    };
    const auto prepare_source = [&] {
        sides.shells = shell_levels(rest, triangles, {250, 4});
        if (!cut_off.empty()) end_borders(sides.shells, cut_off);
    };
    parallel_for(
        2, [&](std::ptrdiff_t side) { side == 0 ? prepare_target() : prepare_source(); }, 1);
    set_all_pins(rest, triangles, pins_of(markers, goals), with_twins, sides);
    return sides;
}

} // namespace meshtween
