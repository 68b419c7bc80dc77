// Berrut and Trefethen, Barycentric Lagrange Interpolation, 2004; Trefethen, Approximation Theory and Approximation
// Practice, 2013 (nested nodes, and what their differences tell).
#include "meshtween/morph/interpolant.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace meshtween {
namespace {

double largest_distance(const Points& a, const Points& b) {
    return a.rows() == 0 ? 0 : (a - b).rowwise().norm().maxCoeff();
}

// Barycentric weights of Lobatto nodes (Berrut and Trefethen, Eq. 5.4).
double barycentric_weight(std::size_t k, std::size_t count) {
    return (k % 2 ? -1.0 : 1.0) * (k == 0 || k + 1 == count ? 0.5 : 1.0);
}

Points sum_of(const std::vector<const Points*>& shapes, const std::vector<double>& weights) {
    Points result(shapes.front()->rows(), 3);
    parallel_ranges(result.rows(), 4096, [&](Eigen::Index begin, Eigen::Index end) {
        auto block = result.middleRows(begin, end - begin);
        bool first = true;
        for (std::size_t k = 0; k < weights.size(); ++k) {
            if (weights[k] == 0) continue;
            const auto part = weights[k] * shapes[k]->middleRows(begin, end - begin);
            if (first)
                block = part;
            else
                block += part;
            first = false;
        }
        if (first) block.setZero();
    });
    return result;
}

// The path's shapes by parameter, each asked for once.
struct Sampler {
    const Morph& morph;
    const Progress& progress;
    std::map<double, Points> known;

    // False where the work was cancelled.
    bool sample(const std::vector<double>& parameters) {
        for (const double u : parameters) {
            if (known.count(u)) continue;
            const auto done = static_cast<double>(known.size()); // how many it takes shows on the way
            if (!keep_going(progress, done / (done + 9), "in-between shapes")) return false;
            known.emplace(u, morph.at(u));
        }
        return true;
    }
};

// How far the shapes at the nodes that the last doubling added lie from the polynomial through those before.
double gap(const Sampler& sampler, const std::vector<double>& coarse, const std::vector<double>& fine) {
    std::vector<const Points*> shapes;
    for (const double u : coarse) shapes.push_back(&sampler.known.at(u));
    double most = 0;
    for (std::size_t i = 1; i < fine.size(); i += 2)
        most = std::max(most,
                        largest_distance(sum_of(shapes, lagrange_weights(coarse, fine[i])), sampler.known.at(fine[i])));
    return most;
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

std::vector<double> lagrange_weights(const std::vector<double>& parameters, double u) {
    std::vector<double> w(parameters.size(), 0.0);
    double sum = 0;
    for (std::size_t k = 0; k < w.size(); ++k) {
        if (u == parameters[k]) {
            std::fill(w.begin(), w.end(), 0.0);
            w[k] = 1;
            return w;
        }
        w[k] = barycentric_weight(k, w.size()) / (u - parameters[k]);
        sum += w[k];
    }
    for (double& weight : w) weight /= sum;
    return w;
}

std::vector<double> end_derivative_weights(const std::vector<double>& parameters, bool last) {
    const std::size_t n = parameters.size(), j = last ? n - 1 : 0;
    std::vector<double> w(n, 0.0);
    for (std::size_t k = 0; k < n; ++k) {
        if (k == j) continue;
        w[k] = barycentric_weight(k, n) / barycentric_weight(j, n) / (parameters[j] - parameters[k]);
        w[j] -= w[k];
    }
    return w;
}

Points weighted_sum(const std::vector<Points>& shapes, const std::vector<double>& weights) {
    std::vector<const Points*> places;
    for (const Points& shape : shapes) places.push_back(&shape);
    return sum_of(places, weights);
}

Points Interpolant::at(double u) const {
    return weighted_sum(nodes, lagrange_weights(parameters, u));
}

Interpolant resampled(const Interpolant& path, int count) {
    if (static_cast<int>(path.nodes.size()) >= count) return path;
    Interpolant result = path;
    result.parameters = lobatto_nodes(count);
    result.nodes.clear();
    for (const double u : result.parameters) result.nodes.push_back(path.at(u));
    return result;
}

Interpolant interpolant(const Morph& morph, double tolerance, int most, const Progress& progress) {
    Interpolant result;
    Sampler sampler{morph, progress, {}};
    double before = 0; // the gap of the doubling before
    std::vector<double> coarse = lobatto_nodes(2);
    for (int count = 3;; count = 2 * count - 1) {
        const std::vector<double> fine = lobatto_nodes(count);
        if (!sampler.sample(fine)) {
            result.cancelled = true;
            return result;
        }
        if (result.diagonal == 0) result.diagonal = morph.diagonal > 0 ? morph.diagonal : diagonal(sampler.known.at(0));
        const double now = gap(sampler, coarse, fine);
        // Gaps fall by a factor a doubling, or ever faster: the next is no more than now * now / before. That they fall
        // more than tenfold is not counted on.
        result.error = now * (before > 0 ? std::clamp(now / before, 0.1, 1.0) : 1.0);
        if ((count > 3 && result.error <= tolerance * result.diagonal) || 2 * count - 1 > most) {
            result.parameters = fine;
            for (const double u : fine) result.nodes.push_back(std::move(sampler.known.at(u)));
            return result;
        }
        before = now;
        coarse = fine;
    }
}

} // namespace meshtween
