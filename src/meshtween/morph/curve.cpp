#include "meshtween/morph/curve.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/morph/spline_fit.h"

#include <Eigen/QR>

#include <algorithm>

namespace meshtween {
namespace {

// Part of the tolerance that the path's own polynomial may take of it.
constexpr double sampled_part = 0.1;

// Between the sites at which a spline is compared with its path, it may be a little further off.
constexpr double between_sites = 1.02;

// The knots of one piece after the other; those between stand `degree` times, so that a node lies there.
SplineBasis joined(const std::vector<SplineBasis>& bases, const std::vector<double>& times) {
    SplineBasis whole{bases.front().degree, {}};
    const auto degree = static_cast<std::size_t>(whole.degree);
    whole.knots.push_back(0);
    for (std::size_t p = 0; p < bases.size(); ++p) {
        const double start = times[p], length = times[p + 1] - start;
        if (p == 0) whole.knots.insert(whole.knots.end(), degree, 0.0);
        for (std::size_t k = degree + 1; k < bases[p].size(); ++k)
            whole.knots.push_back(start + length * bases[p].knots[k]);
        whole.knots.insert(whole.knots.end(), degree, times[p + 1]);
    }
    whole.knots.push_back(1);
    return whole;
}

} // namespace

void check(const CurveOptions& options) {
    if (!(options.tolerance > 0)) throw Error(ErrorKind::argument, "the curve's tolerance must be above 0");
    if (options.max_nodes < 2) throw Error(ErrorKind::argument, "a curve needs at least 2 nodes: its ends");
}

std::vector<double> Curve::weights(double u) const {
    return basis.weights(u);
}

Points Curve::at(double u) const {
    return weighted_sum(nodes, weights(u));
}

std::vector<bool> nodes_on_path(const Curve& curve) {
    std::vector<bool> on(curve.basis.size(), false);
    for (const double key : curve.keys) {
        const std::vector<double> w = curve.weights(key);
        on[static_cast<std::size_t>(std::max_element(w.begin(), w.end()) - w.begin())] = true;
    }
    return on;
}

CurveSites curve_sites(const Curve& curve) {
    CurveSites result;
    const std::vector<double> spans = curve.basis.spans();
    const auto count = static_cast<Eigen::Index>(curve.basis.size());
    const int each = curve.basis.degree + 2;
    for (std::size_t s = 0; s + 1 < spans.size(); ++s)
        for (const double t : lobatto_nodes(each))
            if (t > 0 || s == 0)
                result.sites.push_back(t == 1 ? spans[s + 1] : spans[s] + (spans[s + 1] - spans[s]) * t);
    const Eigen::Index rows = std::ssize(result.sites);
    Eigen::MatrixXd weights(rows, count);
    for (Eigen::Index i = 0; i < rows; ++i) {
        const std::vector<double> w = curve.weights(result.sites[static_cast<std::size_t>(i)]);
        weights.row(i) = Eigen::Map<const Eigen::RowVectorXd>(w.data(), count);
    }
    // What lies on the path is its own; the others are free.
    const std::vector<bool> on = nodes_on_path(curve);
    result.fit = Eigen::MatrixXd::Zero(count, rows);
    std::vector<Eigen::Index> free;
    for (Eigen::Index k = 0; k < count; ++k) {
        if (!on[static_cast<std::size_t>(k)]) {
            free.push_back(k);
            continue;
        }
        Eigen::Index site = 0;
        weights.col(k).maxCoeff(&site);
        result.fit(k, site) = 1;
    }
    if (free.empty()) return result;
    const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(rows, rows) - weights * result.fit;
    const Eigen::MatrixXd columns = weights(Eigen::all, free);
    const Eigen::MatrixXd solved = columns.householderQr().solve(rest);
    for (Eigen::Index i = 0; i < std::ssize(free); ++i)
        result.fit.row(free[static_cast<std::size_t>(i)]) = solved.row(i);
    return result;
}

std::vector<Points> control_normals(const Curve& curve, const Triangles& triangles) {
    const CurveSites at = curve_sites(curve);
    std::vector<Points> normals(curve.nodes.size(), Points::Zero(curve.nodes.front().rows(), 3));
    for (std::size_t s = 0; s < at.sites.size(); ++s) {
        const Points on = vertex_normals(curve.at(at.sites[s]), triangles);
        for (std::size_t k = 0; k < normals.size(); ++k)
            if (const double share = at.fit(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(s)); share != 0)
                normals[k] += share * on;
    }
    return normals;
}

Curve curve(const std::vector<Interpolant>& pieces, const std::vector<double>& times, bool closed,
            const CurveOptions& options) {
    check(options);
    const double size = pieces.front().diagonal;
    std::vector<SplineTask> tasks;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const bool before = p > 0 || closed, after = p + 1 < pieces.size() || closed;
        tasks.push_back(
            {pieces[p],
             {before, after},
             std::max(options.tolerance * size - pieces[p].error, 0.5 * options.tolerance * size) / between_sites});
    }
    const bool joins = pieces.size() > 1 || closed;
    const std::vector<SplineBasis> bases =
        fewest_splines(tasks, joins ? std::max(4, options.max_nodes) : options.max_nodes);
    Curve result;
    result.basis = joined(bases, times);
    result.keys = times;
    result.diagonal = size;
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const double error = between_sites * spline_error(bases[p], tasks[p]) + pieces[p].error;
        result.deviation = std::max(result.deviation, size > 0 ? error / size : error);
        std::vector<Points> own = control_meshes(bases[p], tasks[p]);
        result.nodes.insert(result.nodes.end(), std::make_move_iterator(own.begin() + (p > 0)),
                            std::make_move_iterator(own.end()));
    }
    return result;
}

Curve curve(const Morph& morph, const CurveOptions& options, const Progress& progress) {
    check(options);
    std::vector<Interpolant> pieces{
        interpolant(morph, sampled_part * options.tolerance, std::max(17, 2 * options.max_nodes - 1), progress)};
    if (!pieces.front().cancelled) return curve(pieces, {0, 1}, false, options);
    Curve none;
    none.cancelled = true;
    return none;
}

} // namespace meshtween
