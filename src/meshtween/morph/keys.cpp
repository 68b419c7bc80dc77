// Catmull and Rom, A Class of Local Interpolating Splines, 1974. Pieces are polynomials through their own shapes until
// all is decided; the curve is made of them last.
#include "meshtween/morph/keys.h"

#include "meshtween/core/error.h"
#include "meshtween/io/seams.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meshtween {
namespace {

constexpr double sampled_part = 0.1; // of the tolerance: what the polynomial through a piece's shapes may take of it

// The derivative at the first or last node.
Points end_velocity(const Interpolant& path, bool last) {
    return weighted_sum(path.nodes, end_derivative_weights(path.parameters, last));
}

std::vector<double> checked_times(std::size_t segments, std::vector<double> times) {
    if (times.empty())
        for (std::size_t k = 0; k <= segments; ++k)
            times.push_back(static_cast<double>(k) / static_cast<double>(segments));
    if (times.size() != segments + 1)
        throw Error(ErrorKind::argument,
                    fmt::format("{} times are needed, a key each, not {}", segments + 1, times.size()));
    const bool rising = std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end();
    if (!rising || times.front() != 0 || times.back() != 1)
        throw Error(ErrorKind::argument, "the keys' times must rise from 0 to 1");
    return times;
}

// Adds cubics without value at both ends, whose slopes there make up what the velocities lack.
void correct_velocities(Interpolant& path, const Points& lacks_first, const Points& lacks_last) {
    for (std::size_t k = 1; k + 1 < path.nodes.size(); ++k) {
        const double s = path.parameters[k], r = 1 - s;
        path.nodes[k] += s * r * r * lacks_first - s * s * r * lacks_last;
    }
}

// A piece's own time: from 0 to 1, rising, with these slopes at its ends (at most 3, or it would turn back).
struct Pace {
    double first = 1, last = 1;
    double operator()(double t) const {
        const double r = 1 - t;
        return t * t * (3 - 2 * t) + first * t * r * r - last * t * t * r;
    }
};

// The same shapes at another pace; more nodes where that takes them.
Interpolant paced(const Interpolant& piece, const Pace& pace, const CurveOptions& options) {
    if (pace.first == 1 && pace.last == 1) return piece;
    Morph moved;
    moved.diagonal = piece.diagonal;
    moved.at = [&](double t) { return piece.at(std::clamp(pace(t), 0.0, 1.0)); };
    Interpolant result = interpolant(moved, sampled_part * options.tolerance);
    result.error += piece.error;
    return result;
}

// What part of their mean speed two motions keep where one follows the other: all where they point the same way, none
// where they part by more than 30 degrees. A change of direction at full speed would have to cut the corner, and
// straight lines across large turns squash what turns.
double kept_speed(const Points& before, const Points& after) {
    const double lengths = before.norm() * after.norm();
    return lengths > 0 ? std::max(0.0, 1 - 8 * (1 - before.cwiseProduct(after).sum() / lengths)) : 1;
}

// Makes one velocity of the two at every key between pieces, and where a closed path begins and ends: pieces slow down
// or hurry to one speed, and what then still differs in direction is made up for by cubics.
void join_velocities(std::vector<Interpolant>& pieces, const std::vector<double>& times, const KeyOptions& options) {
    const std::size_t count = pieces.size();
    const auto duration = [&](std::size_t i) { return times[i + 1] - times[i]; };
    std::vector<Pace> pace(count);
    std::vector<Points> wanted(count); // at the key that piece k begins with, by the time of the whole
    for (std::size_t k = options.closed ? 0 : 1; k < count; ++k) {
        const std::size_t i = (k + count - 1) % count; // the piece before
        const Points before = end_velocity(pieces[i], true) / duration(i);
        const Points after = end_velocity(pieces[k], false) / duration(k);
        const double share = duration(k) / (duration(i) + duration(k)); // the shorter piece decides more
        const double speed = kept_speed(before, after) * (share * before.norm() + (1 - share) * after.norm());
        const auto slope = [&](double own) { return own > 0 ? std::min(speed / own, 2.5) : 1; };
        pace[i].last = slope(before.norm());
        pace[k].first = slope(after.norm());
        wanted[k] = share * pace[i].last * before + (1 - share) * pace[k].first * after;
    }
    for (std::size_t k = 0; k < count; ++k) {
        pieces[k] = resampled(paced(pieces[k], pace[k], options.curve), 5);
        const auto lacks = [&](std::size_t key, bool last) -> Points {
            if (wanted[key].rows() == 0) return Points::Zero(pieces[k].nodes.front().rows(), 3);
            return wanted[key] * duration(k) - end_velocity(pieces[k], last);
        };
        const Points first = lacks(k, false), last = k + 1 < count || options.closed ? lacks((k + 1) % count, true)
                                                                                     : Points::Zero(first.rows(), 3);
        correct_velocities(pieces[k], first, last);
    }
}

void add(RepairReport& sum, const RepairReport& one) {
    sum.cuts_before += one.cuts_before;
    sum.cuts_after += one.cuts_after;
    sum.contacts += one.contacts;
    sum.left += one.left;
    sum.trials += one.trials;
    sum.moved = std::max(sum.moved, one.moved);
}

// Vertices that are one in all shapes. None where the shapes do not fit the mesh, which morph() tells.
Weld common_seams(const Mesh& mesh, const std::vector<Points>& shapes) {
    std::vector<const Points*> all;
    for (const Points& shape : shapes) {
        if (shape.rows() != mesh.positions.rows()) return {};
        all.push_back(&shape);
    }
    return seams(mesh, all);
}

std::vector<Points> reduced(const std::vector<Points>& shapes, const Weld& seams) {
    std::vector<Points> result;
    for (const Points& shape : shapes) result.push_back(seams.reduced(shape));
    return result;
}

KeyPath welded_path(const Mesh& mesh, const std::vector<Points>& shapes, const KeyOptions& options,
                    const Progress& progress) {
    const std::size_t count = shapes.size() - (options.closed ? 0 : 1);
    const std::vector<double> times = checked_times(count, options.times);
    const auto piece_of = [&](const Progress& whole, std::size_t k, double from, double to) {
        const double length = (to - from) / static_cast<double>(count), start = from + length * static_cast<double>(k);
        return part_of(whole, start, start + length);
    };
    const double solved = options.repair ? 0.5 : 1; // of the progress
    KeyPath path;
    check(options.curve);
    std::vector<Interpolant> pieces;
    for (std::size_t k = 0; k < count; ++k) {
        Mesh from = mesh;
        from.positions = shapes[k];
        const Progress part = piece_of(progress, k, 0, solved);
        Morph between = morph(from, shapes[(k + 1) % shapes.size()], options.morph, part_of(part, 0, 0.3));
        if (options.timing) between = retimed(between, *options.timing);
        pieces.push_back(interpolant(between, sampled_part * options.curve.tolerance,
                                     std::max(17, 2 * options.curve.max_nodes - 1), part_of(part, 0.3, 1)));
        if (pieces.back().cancelled) {
            path.curve.cancelled = true;
            return path;
        }
        if (between.report && between.report().sweeps >= path.report.sweeps) path.report = between.report();
    }
    if (count > 1) join_velocities(pieces, times, options);
    for (std::size_t k = 0; k < count && options.repair; ++k) {
        Repaired better = repaired(pieces[k], mesh.triangles, *options.repair, piece_of(progress, k, solved, 1));
        if (better.cancelled) {
            path.curve.cancelled = true;
            return path;
        }
        pieces[k] = std::move(better.path);
        add(path.repair, better.report);
    }
    path.curve = curve(pieces, times, options.closed, options.curve);
    return path;
}

} // namespace

KeyPath key_path(const Mesh& mesh, const std::vector<Points>& shapes, const KeyOptions& options,
                 const Progress& progress) {
    if (shapes.size() < 2) throw Error(ErrorKind::argument, "a path through keys needs at least two shapes");
    const Weld found = options.morph.weld ? common_seams(mesh, shapes) : Weld();
    if (!found.any()) return welded_path(mesh, shapes, options, progress);
    KeyOptions inner = options;
    if (inner.timing) {
        const Eigen::VectorXd start = inner.timing->start(found.first), end = inner.timing->end(found.first);
        inner.timing = RegionTiming{start, end};
    }
    KeyPath path = welded_path(welded(mesh, found), reduced(shapes, found), inner, progress);
    for (Points& node : path.curve.nodes) node = found.expanded(node);
    return path;
}

Points blend(const Mesh& mesh, const std::vector<Points>& shapes, const std::vector<double>& weights,
             const MorphOptions& options) {
    if (shapes.empty() || shapes.size() != weights.size())
        throw Error(ErrorKind::argument,
                    fmt::format("{} weights for {} shapes: one each is needed", weights.size(), shapes.size()));
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(std::abs(sum - 1) < 1e-6))
        throw Error(ErrorKind::argument, fmt::format("the weights add up to {}, not to 1", sum));
    std::vector<std::size_t> order(shapes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    // Positive weights first, the heaviest leading: sums on the way never vanish.
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return weights[a] > weights[b]; });
    const Weld found = options.weld ? common_seams(mesh, shapes) : Weld();
    Mesh current = welded(mesh, found);
    current.positions = found.reduced(shapes[order[0]]);
    double so_far = weights[order[0]];
    for (std::size_t k = 1; k < order.size(); ++k) {
        const double weight = weights[order[k]];
        if (weight == 0) continue;
        so_far += weight;
        current.positions = morph(current, found.reduced(shapes[order[k]]), options).at(weight / so_far);
    }
    return found.expanded(current.positions);
}

} // namespace meshtween
