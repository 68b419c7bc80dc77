// Berrut and Trefethen, Barycentric Lagrange Interpolation, 2004.
#include "meshtween/morph/curve.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"

#include <cmath>
#include <map>
#include <numbers>

namespace meshtween {
namespace {

double largest_distance(const Points& a, const Points& b) {
    return a.rows() == 0 ? 0 : (a - b).rowwise().norm().maxCoeff();
}

// The path's shapes by parameter, each asked for once.
struct Sampler {
    const Morph& morph;
    const Progress& progress;
    std::map<double, Points> known;
    int planned = 3; // evaluations up to the end of the step under way

    // False where the work was cancelled.
    bool sample(const std::vector<double>& parameters) {
        for (const double u : parameters) planned += known.count(u) == 0;
        for (const double u : parameters) {
            if (known.count(u)) continue;
            if (!keep_going(progress, static_cast<double>(known.size()) / std::max(planned, 34), "in-between shapes"))
                return false;
            known.emplace(u, morph.at(u));
        }
        return true;
    }
};

// The parameters at which the curve of K nodes is compared with the path: the nodes that K - 1 doubled adds, and for
// two nodes, where that is one point only, those of the step after it.
std::vector<double> checks(int count) {
    return lobatto_nodes(count == 2 ? 5 : 2 * count - 1);
}

} // namespace

std::vector<double> lobatto_nodes(int count) {
    std::vector<double> nodes;
    for (int k = 0; k < count; ++k) {
        const double s = std::sin(std::numbers::pi * k / (2.0 * (count - 1)));
        nodes.push_back(k + 1 == count ? 1 : s * s);
    }
    return nodes;
}

std::vector<double> Curve::weights(double u) const {
    std::vector<double> w(parameters.size(), 0);
    std::size_t first = 0, last = w.size() - 1;
    for (std::size_t p = 0; p + 1 < knots.size(); ++p) {
        first = static_cast<std::size_t>(knots[p]), last = static_cast<std::size_t>(knots[p + 1]);
        if (u <= parameters[last]) break;
    }
    double sum = 0;
    for (std::size_t k = first; k <= last; ++k) {
        if (u == parameters[k]) {
            std::fill(w.begin(), w.end(), 0);
            w[k] = 1;
            return w;
        }
        const bool end = k == first || k == last;
        w[k] = ((k - first) % 2 ? -1 : 1) * (end ? 0.5 : 1.0) / (u - parameters[k]);
        sum += w[k];
    }
    for (double& weight : w) weight /= sum;
    return w;
}

std::vector<double> key_times(const Curve& curve) {
    if (curve.knots.empty()) return {0, 1};
    std::vector<double> times;
    for (const int knot : curve.knots) times.push_back(curve.parameters[static_cast<std::size_t>(knot)]);
    return times;
}

Points Curve::at(double u) const {
    const std::vector<double> w = weights(u);
    Points result(nodes.front().rows(), 3);
    parallel_ranges(result.rows(), 4096, [&](Eigen::Index begin, Eigen::Index end) {
        auto block = result.middleRows(begin, end - begin);
        block = w[0] * nodes[0].middleRows(begin, end - begin);
        for (std::size_t k = 1; k < w.size(); ++k)
            if (w[k] != 0) block += w[k] * nodes[k].middleRows(begin, end - begin);
    });
    return result;
}

Curve resampled(const Curve& curve, int count) {
    if (static_cast<int>(curve.nodes.size()) >= count) return curve;
    Curve result = curve;
    result.parameters = lobatto_nodes(count);
    result.nodes.clear();
    for (const double u : result.parameters) result.nodes.push_back(curve.at(u));
    return result;
}

Curve curve(const Morph& morph, const CurveOptions& options, const Progress& progress) {
    if (!(options.tolerance > 0)) throw Error(ErrorKind::argument, "the curve's tolerance must be above 0");
    if (options.max_nodes < 2) throw Error(ErrorKind::argument, "a curve needs at least 2 nodes: its ends");
    Curve result;
    Sampler sampler{morph, progress, {}};
    for (int count = 2;; count = std::min(2 * count - 1, options.max_nodes)) {
        const std::vector<double> parameters = lobatto_nodes(count);
        const std::vector<double> between = checks(count);
        if (!sampler.sample(parameters) || !sampler.sample(between)) {
            result.cancelled = true;
            return result;
        }
        result.parameters = parameters;
        result.nodes.clear();
        for (const double u : parameters) result.nodes.push_back(sampler.known.at(u));
        result.deviation = 0;
        for (const double u : between)
            result.deviation = std::max(result.deviation, largest_distance(result.at(u), sampler.known.at(u)));
        const double size = diagonal(result.nodes.front());
        if (size > 0) result.deviation /= size;
        if (result.deviation <= options.tolerance || count >= options.max_nodes) return result;
    }
}

} // namespace meshtween
