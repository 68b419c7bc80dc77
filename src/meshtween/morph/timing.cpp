#include "meshtween/morph/timing.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/seams.h"
#include "meshtween/solve/cholesky.h"
#include "meshtween/solve/laplacian.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace meshtween {

Ease ease_named(std::string_view name) {
    for (const Ease kind : {Ease::linear, Ease::in, Ease::out, Ease::in_out})
        if (name_of(kind) == name) return kind;
    throw Error(ErrorKind::argument, fmt::format("no ease is called \"{}\"; there are linear, in, out, in-out", name));
}

std::string_view name_of(Ease kind) {
    switch (kind) {
    case Ease::linear:
        return "linear";
    case Ease::in:
        return "in";
    case Ease::out:
        return "out";
    case Ease::in_out:
        return "in-out";
    }
    return "";
}

double ease(Ease kind, double t) {
    switch (kind) {
    case Ease::in:
        return t * t;
    case Ease::out:
        return t * (2 - t);
    case Ease::in_out:
        return t * t * (3 - 2 * t);
    case Ease::linear:
        break;
    }
    return t;
}

double ping_pong(double t) {
    const double phase = t - std::floor(t);
    return phase < 0.5 ? 2 * phase : 2 - 2 * phase;
}

namespace {

RegionTiming timing_of_whole(const Mesh& mesh, const std::vector<TimedVertex>& given, double width) {
    const Eigen::Index n = mesh.positions.rows();
    if (!(width >= 0)) throw Error(ErrorKind::argument, "the width over which times are smoothed must not be negative");
    const SparseMatrix laplacian =
        cotangent_laplacian(n, mesh.triangles, half_cotangents(edge_lengths(mesh.positions, mesh.triangles)));
    Eigen::VectorXd mass = Eigen::VectorXd::Constant(n, 1e-300);
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) mass[mesh.triangles(t, k)] += triangle_area(mesh.positions, mesh.triangles, t) / 3;
    // A weak pull towards the whole's own times decides where no value is given nor connected.
    const double strength = laplacian.diagonal().maxCoeff() * 1e3 + 1;
    SparseMatrix matrix = laplacian;
    Points right = Points::Zero(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) {
        matrix.coeffRef(i, i) += 1e-9 * strength;
        right.row(i) << 0, 1e-9 * strength, 0;
    }
    for (const TimedVertex& v : given) {
        if (v.vertex < 0 || v.vertex >= n)
            throw Error(ErrorKind::argument, fmt::format("a time is given to vertex {}; there are {}", v.vertex, n));
        if (!(v.start >= 0 && v.start < v.end && v.end <= 1))
            throw Error(ErrorKind::argument,
                        fmt::format("vertex {} moves from {} to {}: times lie in 0..1, the first before the second",
                                    v.vertex, v.start, v.end));
        matrix.coeffRef(v.vertex, v.vertex) += strength;
        right.row(v.vertex) += strength * Point(v.start, v.end, 0);
    }
    Points times = SparseCholesky(matrix).solve(right);
    if (width > 0) { // one step of diffusion that reaches about `width`
        const double reach = width * diagonal(mesh);
        SparseMatrix step = laplacian * (reach * reach);
        Points weighted = times;
        for (Eigen::Index i = 0; i < n; ++i) {
            const double m = std::max(mass[i], 1e-12 * mass.maxCoeff());
            step.coeffRef(i, i) += m;
            weighted.row(i) *= m;
        }
        times = SparseCholesky(step).solve(weighted);
    }
    RegionTiming timing{times.col(0).cwiseMax(0).cwiseMin(1), times.col(1).cwiseMax(0).cwiseMin(1)};
    constexpr double shortest = 1e-3;
    for (Eigen::Index i = 0; i < n; ++i) {
        timing.start[i] = std::min(timing.start[i], 1 - shortest);
        timing.end[i] = std::max(timing.end[i], timing.start[i] + shortest);
    }
    return timing;
}

// For welded vertices; what copies say alike is said once.
std::vector<TimedVertex> reduced(const std::vector<TimedVertex>& given, const Weld& seams) {
    std::vector<TimedVertex> result;
    std::set<std::tuple<int, double, double>> said;
    for (TimedVertex v : given) {
        if (v.vertex >= 0 && v.vertex < std::ssize(seams.vertex))
            v.vertex = seams.vertex[static_cast<std::size_t>(v.vertex)];
        if (said.insert({v.vertex, v.start, v.end}).second) result.push_back(v);
    }
    return result;
}

} // namespace

RegionTiming region_timing(const Mesh& mesh, const std::vector<TimedVertex>& given, double width) {
    const Weld found = seams(mesh);
    if (!found.any()) return timing_of_whole(mesh, given, width);
    const RegionTiming timing = timing_of_whole(welded(mesh, found), reduced(given, found), width);
    return {timing.start(found.vertex), timing.end(found.vertex)};
}

Eigen::VectorXd own_times(const RegionTiming& timing, double u) {
    Eigen::VectorXd times(timing.start.size());
    for (Eigen::Index i = 0; i < times.size(); ++i)
        times[i] = ease(Ease::in_out, std::clamp((u - timing.start[i]) / (timing.end[i] - timing.start[i]), 0.0, 1.0));
    return times;
}

Morph retimed(const Morph& morph, const RegionTiming& timing) {
    Morph result = morph;
    result.at = [morph, timing](double u) { return morph.at_each(own_times(timing, u), u); };
    return result;
}

} // namespace meshtween
