// From coarse to fine: few vertices first find the pose, then each finer level follows smaller features. The weight of
// bending falls as the fourth power of a length, from a fifth of the target to less than a thousandth; in the limit the
// shell lies on the surface and its bending alone says where along it each vertex goes.
//
// The stages and their papers are in align, shell, refine, mend_level, settle, untangle, crease, nudge and lift.
#include "meshtween/fit/surface_fit.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/fit/align.h"
#include "meshtween/fit/counterpart.h"
#include "meshtween/fit/crease.h"
#include "meshtween/fit/fit_sides.h"
#include "meshtween/fit/lift.h"
#include "meshtween/fit/mend_level.h"
#include "meshtween/fit/nudge.h"
#include "meshtween/fit/refine.h"
#include "meshtween/fit/renumber.h"
#include "meshtween/fit/settle.h"
#include "meshtween/fit/untangle.h"
#include "meshtween/geometry/measure.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace meshtween {
namespace {

// What falls in equal ratios from the first round to the last.
struct Falling {
    double first, last;
    double at(double done) const { return first == last ? first : first * std::pow(last / first, done); }
};
constexpr Falling falling_length{0.2, 0.0015}; // of the shell: features that it follows, in diagonals
constexpr Falling falling_slide{0.01, 1e-4};   // coarse levels keep still; the last round lets go
constexpr double yielded = 1e-13;              // of noisy markers' weight in the last round of a fit without them
constexpr int rounds_a_level = 8, finest_rounds = 7;
constexpr double crushed = 0.2; // what a triangle has left of its area
// Of pulls from the target's side on the coarsest level, beside 1 on the others. Which part goes to which is decided
// there, where the mesh is stiff, and covering tells it better than closeness: a leg that clings to the belly stays
// there.
constexpr double coarsest_back = 100;
// In the last rounds the whole of each triangle clings, not its corners alone: a quarter of them and three of the
// centre integrate squares exactly. The more unlike the shapes, the less do the target's facets answer to the mesh's;
// and where triangles are as large as in a mesh of one level, their corners would end far off. What lies between
// corners moves slowly, which takes the solver longer.
constexpr double centres_share = 0.75;
constexpr int whole_rounds = 3, whole_cycles = 20;
constexpr double calm_turn = 0.35;          // radians: between two faces or standing bodies all turn less
constexpr int articulation_rounds = 40;     // with the markers alone, on the coarsest level
constexpr double articulation_still = 1e-4; // stop where no vertex moves further, in diagonals

// How unlike the shapes are in their edges' lengths, as the spread of their logarithms: 0.06 between two faces, 0.1
// between two bodies, 0.35 between two heads of different proportions.
double strain(const Shell& shell, const Points& x) {
    double sum = 0, squares = 0, count = 0;
    for (const Edge& edge : shell.topology.edges) {
        const auto length = [&](const Points& p) { return (p.row(edge.vertices[0]) - p.row(edge.vertices[1])).norm(); };
        const double now = length(x), rest = length(shell.rest);
        if (!(now > 0 && rest > 0)) continue;
        const double logarithm = std::log(now / rest);
        sum += logarithm, squares += logarithm * logarithm, ++count;
    }
    return count > 0 ? std::sqrt(std::max(0.0, squares / count - sum * sum / (count * count))) : 0;
}

// The membrane's share: unlike shapes crumple where bending alone says what goes where, like ones creep where the
// membrane pulls at them.
double membrane_share(double strain) {
    constexpr double unlike = 0.33;
    return std::clamp(std::pow(strain / unlike, 4), 1e-3, 1.0);
}

// Everything is computed in coordinates where the target's diagonal is 1 and, as far as markers tell, it is turned as
// the source is.
struct Frame {
    Point origin{0, 0, 0};
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity(); // of rows
    double diagonal = 1;
    Points in(const Points& x) const { return (x.rowwise() - origin) * turn / diagonal; }
    Points out(const Points& x) const { return ((x * (diagonal * turn.transpose())).rowwise() + origin).eval(); }
};

// On a grid finer than any mesh is meant, so that a turned target gives the same bits and with them the same decisions:
// which of two places as close is closest decides far more than a rounding.
Points on_grid(const Points& x) {
    constexpr double grid = 1 << 26;
    return (x.array() * grid).round() / grid;
}

// On the triangles' new numbers and by their places, so that the order in a file changes nothing, not even a rounding.
std::vector<Marker> in_order(std::span<const Marker> given, const std::vector<int>& triangle) {
    std::vector<int> now(triangle.size());
    for (std::size_t t = 0; t < triangle.size(); ++t) now[static_cast<std::size_t>(triangle[t])] = static_cast<int>(t);
    std::vector<Marker> markers(given.begin(), given.end());
    for (Marker& m : markers) m.source.triangle = now[static_cast<std::size_t>(m.source.triangle)];
    const auto key = [](const Marker& m) {
        const Point &b = m.source.barycentric, &t = m.target;
        return std::array<double, 7>{static_cast<double>(m.source.triangle), b[0], b[1], b[2], t[0], t[1], t[2]};
    };
    std::stable_sort(markers.begin(), markers.end(), [&](const Marker& a, const Marker& b) { return key(a) < key(b); });
    return markers;
}

// Vertices of the file by their new numbers.
std::vector<int> in_new_order(const std::vector<int>& vertex, std::span<const int> given) {
    std::vector<int> now(vertex.size());
    for (std::size_t v = 0; v < vertex.size(); ++v) now[static_cast<std::size_t>(vertex[v])] = static_cast<int>(v);
    std::vector<int> result;
    for (const int v : given) result.push_back(now[static_cast<std::size_t>(v)]);
    return result;
}

bool on_one_line(const Points& points) {
    const Points centred = points.rowwise() - points.colwise().mean();
    const Eigen::Vector3d spread =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(centred.transpose() * centred, Eigen::EigenvaluesOnly)
            .eigenvalues();
    return spread[1] <= 1e-12 * spread[2];
}

Similarity start(const Renumbered& source, const Renumbered& target, std::span<const Marker> markers,
                 const Points& goals, std::vector<std::string>& notes) {
    if (markers.empty()) {
        notes.emplace_back(
            "no markers: the start is a guess, as the files stand or by their principal axes; look at the "
            "result, and place a few markers if it is turned the wrong way");
        return align_axes(source.positions, source.triangles, target.positions, target.triangles);
    }
    Points from(goals.rows(), 3);
    for (std::size_t k = 0; k < markers.size(); ++k)
        from.row(static_cast<Eigen::Index>(k)) = position(source.positions, source.triangles, markers[k].source);
    if (markers.size() >= 3) {
        if (on_one_line(from) || on_one_line(goals))
            throw Error(ErrorKind::computation,
                        fmt::format("the {} markers lie on one line, which leaves the turn around it open: place one "
                                    "beside the line",
                                    markers.size()));
        return align(from, goals);
    }
    notes.push_back(fmt::format("{} marker{}: turn and size are taken from the shapes' extents", markers.size(),
                                markers.size() == 1 ? "" : "s"));
    Similarity s = align_axes(source.positions, source.triangles, target.positions, target.triangles);
    s.translation += (goals - s(from)).colwise().mean();
    return s;
}

Frame frame_of(const Renumbered& source, const Mesh& target, std::span<const Marker> markers) {
    Frame frame;
    frame.origin = target.positions.cast<long double>().colwise().mean().cast<double>(); // the same in any order
    Points from(std::ssize(markers), 3), to(std::ssize(markers), 3);
    for (std::size_t k = 0; k < markers.size(); ++k) {
        from.row(static_cast<Eigen::Index>(k)) = position(source.positions, source.triangles, markers[k].source);
        to.row(static_cast<Eigen::Index>(k)) = markers[k].target;
    }
    if (markers.size() >= 3 && !on_one_line(from) && !on_one_line(to)) frame.turn = align(from, to).rotation;
    frame.diagonal = diagonal(frame.in(target.positions), target.triangles);
    return frame;
}

// From the target on the grid to the target itself, for the vertices on it.
void leave_grid(Points& x, const FitTarget& target, const Points& itself, const std::vector<int>& places) {
    constexpr double on_it = 1e-7;
    parallel_for(
        x.rows(),
        [&](Eigen::Index i) {
            const ClosestPoint there =
                target.index.closest(Point(x.row(i)), places.empty() ? -1 : places[static_cast<std::size_t>(i)]);
            if (there.squared_distance < on_it * on_it) x.row(i) = position(itself, target.triangles, there.where);
        },
        256);
}

// The pose: as rigid as possible with the markers held, before anything is asked of the surface.
Points articulate(const ShellLevels& shells, const FitTarget& target) {
    const std::size_t coarsest = shells.levels.size() - 1;
    Points x = shells.levels[coarsest].positions;
    if (shells.pins[coarsest].size() < 3) return x;
    RelaxWeights weights;
    weights.closeness = 0;
    weights.length = 0.1;
    weights.membrane = 1;
    weights.smoothing = 0;
    weights.with_scale = false;
    RelaxMemory memory;
    for (int round = 0; round < articulation_rounds; ++round) {
        Points next = relax(shells, coarsest, x, target, weights, memory);
        const double moved = (next - x).rowwise().norm().maxCoeff();
        x = std::move(next);
        if (moved < articulation_still) break;
    }
    return x;
}

// The whole mesh as a coarser level shows it.
Points on_finest(const ShellLevels& shells, std::size_t level, Points x) {
    for (; level > 0; --level) x = refine_positions(shells, level, x, true);
    return x;
}

// The shell on the surface, before the last steps.
struct Closed {
    Points positions;
    int rounds = 0;
    bool cancelled = false;
};

// How much of the markers.
struct Approach {
    Falling pins;     // RelaxWeights
    std::size_t held; // of each level's pins: those that mending holds
    bool mends = true;
};

// From the pose on the coarsest level to the finest; `searches` are one a level. Mending holds the first `held` of each
// level's pins. Once a level had to be mended, the finer ones are kept as the finest always is: they start smooth, and
// what would fold waits. They are mended before they move, too, and details do not reach beyond crushed triangles.
// Cancelled, it goes on to the whole mesh without relaxing.
Closed close_in(const ShellLevels& shells, std::vector<TangleSearch>& searches, Closed posed, const Approach& approach,
                const std::function<void(const Points&)>& watch, const Progress& progress) {
    const std::size_t levels = shells.levels.size();
    RelaxWeights weights;
    weights.membrane = 1e-3;
    weights.calm_turn = calm_turn;
    Closed result = std::move(posed);
    Points& x = result.positions;
    const FitTarget& target = searches[0].target;
    bool mended = false;
    double done = 0, work = 0; // in vertices seen, for the progress
    const auto rounds_on = [](std::size_t level) { return level == 0 ? finest_rounds : rounds_a_level; };
    for (std::size_t k = 0; k < levels; ++k)
        work += static_cast<double>(shells.levels[k].positions.rows()) * rounds_on(k);
    for (std::size_t k = levels; k-- > 0;) {
        RelaxMemory memory;
        weights.back = k > 0 && k + 1 == levels ? coarsest_back : 1;
        const int rounds = rounds_on(k);
        const double step =
            k == 0 ? (rounds_a_level - 1.0) / (rounds - 1) : 1; // the last round is where eight would end
        for (int round = 0; round < rounds; ++round) {
            const double fallen = (static_cast<double>(levels - 1 - k) * rounds_a_level + round * step) /
                                  (static_cast<double>(levels) * rounds_a_level - 1);
            weights.length = falling_length.at(fallen), weights.slide = falling_slide.at(fallen);
            const bool whole = k == 0 && levels > 1 && round >= rounds - whole_rounds;
            weights.centres = whole ? centres_share * (1 - weights.membrane) : 0;
            weights.round = result.rounds;
            weights.pins = approach.pins.at(fallen);
            weights.cycles = weights.centres > 0 ? whole_cycles : RelaxWeights().cycles;
            result.cancelled = result.cancelled || !keep_going(progress, 0.15 + 0.75 * done / work, "fitting");
            if (result.cancelled) break;
            Points relaxed = relax(shells, k, x, target, weights, memory);
            x = (k == 0 && approach.mends) || mended ? held_back(searches[k], x, relaxed) : std::move(relaxed);
            done += static_cast<double>(x.rows());
            ++result.rounds;
            if (watch) watch(on_finest(shells, k, x));
        }
        weights.membrane = membrane_share(strain(shells.shells[k], x));
        if (k == 0) break;
        const auto mend = [&](std::size_t level) {
            const double now = 0.15 + 0.75 * done / work;
            if (result.cancelled || !approach.mends) return;
            std::optional<Points> better =
                mended_level(searches[level], x, std::span(shells.pins[level]).first(approach.held),
                             mended ? Mending::all : Mending::much, part_of(progress, now, now));
            if (!better) return;
            x = std::move(*better);
            mended = true;
        };
        mend(k);
        x = refine_positions(shells, k, x, weights.with_scale, mended ? crushed : 0);
        if (((k == 1 && approach.mends) || mended) && !result.cancelled) x = eased(searches[k - 1], x);
        if (mended) mend(k - 1); // what the details of the finer level folded
    }
    return result;
}

// What the last steps leave.
struct Landed {
    Points positions;        // on the surface
    Points lift;             // how far from there each vertex goes
    std::vector<int> places; // the target's triangle at each vertex
    Tangles left;
    bool cancelled = false;
};

// Onto the surface, what is turned over or cut mended, vertices onto creases, triangles onto the surface in the mean.
Landed land(TangleSearch& search, std::span<const Pin> pins, const Points& x, bool on_surface, const Progress& progress,
            FitResult& result) {
    const Shell& shell = search.shell;
    search.beyond = without_counterpart(shell, x, search.target);
    Settled settled = settle(shell, x, search.target, pins, search.beyond);
    result.refused_steps = std::ssize(settled.refused);
    result.refused = std::move(settled.refused);
    const Tangles faults = tangles(search, settled.positions, settled.flipped);
    const Untangled untangled = untangle(search, settled.positions, faults, pins, part_of(progress, 0, 0.4));
    result.patches = untangled.patches;
    Nudged nudged = nudge(search, creased(search, untangled.positions, untangled.left, settled.places), untangled.left,
                          pins, false, settled.places, part_of(progress, 0.4, 0.5));
    Landed landed{nudged.positions,
                  Points::Zero(x.rows(), 3),
                  std::move(settled.places),
                  {},
                  untangled.cancelled || nudged.cancelled || !keep_going(progress, 0.5, "lifting")};
    if (!on_surface && !landed.cancelled) {
        const Points up = without_new_cuts(search, landed.positions, nudged.left,
                                           lifted(landed.positions, shell.triangles, shell.topology, search.target));
        nudged = nudge(search, up, nudged.left, pins, true, landed.places, part_of(progress, 0.5, 1));
        landed.cancelled = nudged.cancelled;
        landed.lift = nudged.positions - landed.positions;
    }
    landed.left = {without_beyond(shell.triangles, search.beyond,
                                  flipped_triangles(landed.positions + landed.lift, shell.triangles, search.target,
                                                    landed.places)),
                   std::move(nudged.left.cuts)};
    const std::vector<int>& flips = landed.left.flips;
    std::vector<int> seen;
    std::set_union(settled.mended.begin(), settled.mended.end(), faults.flips.begin(), faults.flips.end(),
                   std::back_inserter(seen));
    std::set_difference(seen.begin(), seen.end(), flips.begin(), flips.end(), std::back_inserter(result.mended));
    return landed;
}

// What the result says of vertices and triangles, by their numbers in the file.
void report_in_file_order(const Renumbered& source, const Tangles& left, FitResult& result) {
    const auto before = [](const std::vector<int>& numbers, std::vector<int>& list) {
        for (int& i : list) i = numbers[static_cast<std::size_t>(i)];
        std::sort(list.begin(), list.end());
    };
    before(source.vertex, result.refused);
    before(source.triangle, result.mended);
    result.flipped = left.flips;
    before(source.triangle, result.flipped);
    for (const auto& [s, t] : left.cuts)
        result.cuts.push_back(
            {source.triangle[static_cast<std::size_t>(s)], source.triangle[static_cast<std::size_t>(t)]});
}

void measure_markers(const Points& x, const Triangles& triangles, std::span<const Marker> markers, const Points& goals,
                     FitResult& result) {
    for (std::size_t k = 0; k < markers.size(); ++k) {
        const double off = (position(x, triangles, markers[k].source) - goals.row(static_cast<Eigen::Index>(k))).norm();
        if (off > 0.01) result.missed.emplace_back(off, markers[k].name);
    }
    std::ranges::stable_sort(result.missed, std::greater<>(), &std::pair<double, std::string>::first);
}

} // namespace

FitResult surface_fit(const Mesh& source_mesh, const Mesh& target_mesh, std::span<const Marker> given,
                      const FitOptions& options, const Progress& progress, std::span<const int> cut_off) {
    // Before there is anything to keep, whoever asks to stop is heard at the next stage that can be left.
    keep_going(progress, 0, "numbering the meshes");
    FitResult result;
    const Renumbered source = renumbered(source_mesh.positions, source_mesh.triangles);
    const std::vector<Marker> markers = in_order(given, source.triangle);
    const Frame frame = frame_of(source, target_mesh, markers);
    const Points in_frame = frame.in(target_mesh.positions);
    const Renumbered on_the_grid = renumbered(on_grid(in_frame), target_mesh.triangles);
    Points goals(std::ssize(markers), 3);
    for (std::size_t k = 0; k < markers.size(); ++k) goals.row(static_cast<Eigen::Index>(k)) = markers[k].target;
    goals = on_grid(frame.in(goals));
    keep_going(progress, 0.01, "aligning");
    const Points rest = start(source, on_the_grid, markers, goals, result.notes)(source.positions);
    keep_going(progress, 0.02, "preparing coarse levels");
    const bool with_twins = options.symmetry && options.marker_weight > 0;
    FitSides sides = fit_sides(rest, source.triangles, on_the_grid, markers, goals, with_twins,
                               in_new_order(source.vertex, cut_off));
    const FitTarget& target = *sides.target;
    const ShellLevels& shells = sides.shells;
    result.twins = static_cast<int>(shells.pins[0].size() - markers.size());

    std::function<void(const Points&)> watch;
    if (options.watch)
        watch = [&](const Points& on_curve) { options.watch(frame.out(as_before(source.vertex, on_curve))); };
    std::vector<TangleSearch> searches;
    MendingEffort effort = mending_effort(rest.rows());
    for (const Shell& shell : shells.shells) searches.push_back({shell, target, {}, {}, {}, &effort});
    Closed closed{{}, 0, !keep_going(progress, 0.1, "posing")};
    closed.positions = articulate(shells, target);
    const std::size_t held = options.marker_weight > 0 ? markers.size() : 0; // of the pins: twins are guesses
    const double full = RelaxWeights().pins * options.marker_weight;
    if (sides.marker_noise > 0 && full > 0) {
        result.notes.push_back(fmt::format(
            "the markers scatter by {:.1f} % of the diagonal across the target's surface, and so they will along it: "
            "they lead at first and yield where the shapes agree on another place",
            100 * sides.marker_noise));
        const Approach alone{{full, full * yielded}, 0, false};
        const Closed free = close_in(shells, searches, closed, alone, {}, part_of(progress, 0.1, 0.15));
        goals = without_noise(rest, source.triangles, free.positions, pins_of(markers, goals), sides);
        set_all_pins(rest, source.triangles, pins_of(markers, goals), with_twins, sides);
        closed.positions = articulate(shells, target);
    }
    closed = close_in(shells, searches, std::move(closed), {{full, full}, held}, watch, progress);
    result.rounds = closed.rounds;
    Points x = std::move(closed.positions);
    Landed landed{x, Points::Zero(x.rows(), 3), {}, {}};
    if (!closed.cancelled)
        landed = land(searches[0], std::span(shells.pins[0]).first(held), x, options.on_surface,
                      part_of(progress, 0.9, 1), result);
    x = std::move(landed.positions);
    for (Eigen::Index i = 0; i < x.rows(); ++i) // vertices of no triangle go where the similarity takes them
        if (shells.shells[0].topology.vertex_triangles[i].empty()) x.row(i) = rest.row(i);
    report_in_file_order(source, landed.left, result);
    measure_markers(x, source.triangles, markers, goals, result);
    leave_grid(x, target, in_order_of(on_the_grid.vertex, in_frame), landed.places);
    x += landed.lift;
    result.positions = frame.out(as_before(source.vertex, x));
    result.end = !closed.cancelled && !landed.cancelled ? FitEnd::converged : FitEnd::cancelled;
    keep_going(progress, 1, "done");
    return result;
}

} // namespace meshtween
