// Catmull and Rom, A Class of Local Interpolating Splines, 1974; Berrut and Trefethen, Barycentric Lagrange
// Interpolation, 2004 (derivatives at the nodes).
#include "meshtween/morph/keys.h"

#include "meshtween/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meshtween {
namespace {

// The same polynomial through more nodes.
Curve with_nodes(const Curve& curve, int count) {
    if (static_cast<int>(curve.nodes.size()) >= count) return curve;
    Curve result = curve;
    result.parameters = lobatto_nodes(count);
    result.nodes.clear();
    for (const double u : result.parameters) result.nodes.push_back(curve.at(u));
    return result;
}

// The derivative at the first or last node.
Points end_velocity(const Curve& curve, bool last) {
    const std::size_t n = curve.parameters.size(), j = last ? n - 1 : 0;
    const auto weight = [&](std::size_t k) { return (k % 2 ? -1.0 : 1.0) * (k == 0 || k + 1 == n ? 0.5 : 1.0); };
    Points velocity = Points::Zero(curve.nodes[j].rows(), 3);
    for (std::size_t k = 0; k < n; ++k)
        if (k != j)
            velocity +=
                weight(k) / weight(j) / (curve.parameters[j] - curve.parameters[k]) * (curve.nodes[k] - curve.nodes[j]);
    return velocity;
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
void correct_velocities(Curve& curve, const Points& lacks_first, const Points& lacks_last) {
    for (std::size_t k = 0; k < curve.nodes.size(); ++k) {
        const double s = curve.parameters[k], r = 1 - s;
        curve.nodes[k] += s * r * r * lacks_first - s * s * r * lacks_last;
    }
}

} // namespace

Points KeyPath::at(double t) const {
    const auto next = std::upper_bound(times.begin() + 1, times.end() - 1, t);
    const auto k = static_cast<std::size_t>(next - times.begin()) - 1;
    return segments[k].at(std::clamp((t - times[k]) / (times[k + 1] - times[k]), 0.0, 1.0));
}

KeyPath key_path(const Mesh& mesh, const std::vector<Points>& shapes, const KeyOptions& options,
                 const Progress& progress) {
    if (shapes.size() < 2) throw Error(ErrorKind::argument, "a path through keys needs at least two shapes");
    const std::size_t count = shapes.size() - (options.closed ? 0 : 1);
    KeyPath path{checked_times(count, options.times), {}};
    std::vector<Points> first, last; // velocities by the time of the whole
    for (std::size_t k = 0; k < count; ++k) {
        Mesh from = mesh;
        from.positions = shapes[k];
        const Progress part = part_of(progress, static_cast<double>(k) / static_cast<double>(count),
                                      static_cast<double>(k + 1) / static_cast<double>(count));
        const Morph between = morph(from, shapes[(k + 1) % shapes.size()], options.morph, part_of(part, 0, 0.5));
        Curve segment = curve(between, options.curve, part_of(part, 0.5, 1));
        if (segment.cancelled) throw Error(ErrorKind::computation, "cancelled before the path was whole");
        path.segments.push_back(with_nodes(segment, 5));
        const double duration = path.times[k + 1] - path.times[k];
        first.push_back(end_velocity(path.segments.back(), false) / duration);
        last.push_back(end_velocity(path.segments.back(), true) / duration);
    }
    for (std::size_t k = 0; k < count; ++k) {
        const auto duration = [&](std::size_t i) { return path.times[i + 1] - path.times[i]; };
        // What the joint between segments i and j wants, less what segment k has there; none at open ends.
        const auto lacks = [&](std::size_t i, std::size_t j, const Points& have) -> Points {
            const double a = duration(j) / (duration(i) + duration(j)); // the shorter segment decides more
            return (a * last[i] + (1 - a) * first[j] - have) * duration(k);
        };
        const Points none = Points::Zero(mesh.positions.rows(), 3);
        const bool joined_before = k > 0 || options.closed, joined_after = k + 1 < count || options.closed;
        correct_velocities(path.segments[k], joined_before ? lacks((k + count - 1) % count, k, first[k]) : none,
                           joined_after ? lacks(k, (k + 1) % count, last[k]) : none);
    }
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
    Mesh current = mesh;
    current.positions = shapes[order[0]];
    double so_far = weights[order[0]];
    for (std::size_t k = 1; k < order.size(); ++k) {
        const double weight = weights[order[k]];
        if (weight == 0) continue;
        so_far += weight;
        current.positions = morph(current, shapes[order[k]], options).at(weight / so_far);
    }
    return current.positions;
}

} // namespace meshtween
