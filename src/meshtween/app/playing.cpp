// A chord over a step h of time is off by at most h^2 |p''| / 8, which falls fourfold with every halving: a few chords
// of each span tell how many are needed.
#include "meshtween/app/playing.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/gltf_write.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meshtween {
namespace {

using Eigen::Index;

constexpr int most_keys = 4096;
constexpr double beside_middle = 1.02; // a chord may lie a little further off than at its middle

// When the eased time is at u. Eases never fall, so that halving finds it.
double time_of(Ease kind, double u) {
    if (kind == Ease::linear || u <= 0 || u >= 1) return u;
    double low = 0, high = 1;
    for (int step = 0; step < 60; ++step) {
        const double middle = (low + high) / 2;
        (ease(kind, middle) < u ? low : high) = middle;
    }
    return high;
}

Eigen::RowVectorXd weights_at(const Curve& curve, Ease kind, double t) {
    const std::vector<double> w = curve.weights(ease(kind, t));
    return Eigen::Map<const Eigen::RowVectorXd>(w.data(), std::ssize(w));
}

// The largest distance between the curve and each chord from one time to the next, at their middles.
Eigen::VectorXd chord_errors(const Curve& curve, Ease kind, const std::vector<double>& times) {
    const Index chords = std::ssize(times) - 1, shapes = std::ssize(curve.nodes);
    Eigen::MatrixXd gaps(chords, shapes); // weights in the middle less the mean of those at the ends
    for (Index i = 0; i < chords; ++i) {
        const double a = times[static_cast<std::size_t>(i)], b = times[static_cast<std::size_t>(i) + 1];
        gaps.row(i) =
            weights_at(curve, kind, (a + b) / 2) - (weights_at(curve, kind, a) + weights_at(curve, kind, b)) / 2;
    }
    constexpr Index block = 128; // vertices
    const Index vertices = curve.nodes.front().rows(), blocks = (vertices + block - 1) / block;
    Eigen::MatrixXd worst = Eigen::MatrixXd::Zero(chords, std::max<Index>(blocks, 1));
    parallel_for(
        blocks,
        [&](Index b) {
            const Index begin = b * block, count = std::min(block, vertices - begin);
            Eigen::MatrixXd places(shapes, 3 * count);
            for (Index k = 0; k < shapes; ++k)
                for (Index i = 0; i < count; ++i)
                    places.block<1, 3>(k, 3 * i) =
                        curve.nodes[static_cast<std::size_t>(k)].row(begin + i) - curve.nodes.front().row(begin + i);
            const Eigen::MatrixXd off = gaps * places;
            for (Index i = 0; i < count; ++i)
                worst.col(b) = worst.col(b).cwiseMax(off.middleCols<3>(3 * i).rowwise().norm());
        },
        1);
    return worst.rowwise().maxCoeff();
}

// Each span between two of `marks` in so many equal steps.
std::vector<double> divided(const std::vector<double>& marks, const std::vector<int>& steps) {
    std::vector<double> times{marks.front()};
    for (std::size_t s = 0; s < steps.size(); ++s)
        for (int i = 1; i <= steps[s]; ++i)
            times.push_back(i == steps[s] ? marks[s + 1] : marks[s] + (marks[s + 1] - marks[s]) * i / steps[s]);
    return times;
}

// The largest error of each span's chords.
std::vector<double> span_errors(const Eigen::VectorXd& errors, const std::vector<int>& steps) {
    std::vector<double> worst;
    for (Index first = 0; const int count : steps) {
        worst.push_back(errors.segment(first, count).maxCoeff());
        first += count;
    }
    return worst;
}

struct Times {
    std::vector<double> times; // from 0 to 1
    double error = 0;          // a length
};

Times key_moments(const Curve& curve, Ease kind, double allowed) {
    std::vector<double> marks;
    for (const double knot : curve.basis.spans()) marks.push_back(time_of(kind, knot));
    std::vector<int> steps(marks.size() - 1, 2 * (curve.basis.degree + 1));
    const int most = std::max(most_keys / static_cast<int>(steps.size()), steps.front()); // a span
    Times result;
    for (int round = 0; round < 4; ++round) {
        result.times = divided(marks, steps);
        const Eigen::VectorXd errors = chord_errors(curve, kind, result.times);
        result.error = beside_middle * errors.maxCoeff();
        if (round > 0 && result.error <= allowed) break;
        const std::vector<double> worst = span_errors(errors, steps);
        for (std::size_t s = 0; s < steps.size(); ++s) {
            if (round > 0 && beside_middle * worst[s] <= allowed) continue;
            const double times_more = allowed > 0 ? std::sqrt(beside_middle * worst[s] / allowed) : 0;
            // A little more: the first chords are not yet quite parabolas.
            steps[s] = static_cast<int>(std::clamp(std::ceil(1.02 * steps[s] * times_more), 1.0, most * 1.0));
        }
    }
    return result;
}

// What a viewer that adds offsets up in float shows at a row of weights, less the curve there: the largest distance.
double float_error(const Curve& curve, double u, const float* weights) {
    const Point origin = glb_origin(curve.nodes.front());
    const Points exact = curve.at(u);
    std::vector<double> worst(static_cast<std::size_t>(exact.rows()), 0.0);
    parallel_for(exact.rows(), [&](std::ptrdiff_t v) {
        const Point base = curve.nodes.front().row(v) - origin;
        const Eigen::RowVector3f rounded = base.cast<float>();
        Eigen::RowVector3f sum = rounded;
        for (std::size_t k = 1; k < curve.nodes.size(); ++k) {
            const Point offset = curve.nodes[k].row(v) - origin - rounded.cast<double>();
            sum += weights[k - 1] * offset.cast<float>();
        }
        worst[static_cast<std::size_t>(v)] = (sum.cast<double>() + origin - exact.row(v)).norm();
    });
    return worst.empty() ? 0 : *std::max_element(worst.begin(), worst.end());
}

void check(const Curve& curve, const PlayOptions& options) {
    if (curve.nodes.size() < 2 || curve.basis.size() != curve.nodes.size())
        throw Error(ErrorKind::argument,
                    "a morph to play needs at least two shapes and a basis with a weight for each");
    for (const Points& node : curve.nodes)
        if (node.rows() != curve.nodes.front().rows())
            throw Error(ErrorKind::argument, fmt::format("a shape of the curve has {} vertices, but the first has {}",
                                                         node.rows(), curve.nodes.front().rows()));
    if (!(options.seconds >= 1e-3 && options.seconds <= 1e5))
        throw Error(ErrorKind::argument, fmt::format("a morph of {} seconds cannot be played", options.seconds));
}

} // namespace

std::vector<float> float_weights(const Curve& curve, double u) {
    const std::vector<double> exact = curve.weights(u);
    std::vector<float> rounded(exact.begin() + 1, exact.end());
    if (rounded.empty()) return rounded;
    const auto most = std::max_element(rounded.begin(), rounded.end());
    while (std::accumulate(rounded.begin(), rounded.end(), 0.0) > 1) *most = std::nextafter(*most, 0.0F);
    return rounded;
}

WeightKeys weight_keys(const Curve& curve, const PlayOptions& options) {
    check(curve, options);
    const double size = curve.diagonal, unit = size > 0 ? size : 1;
    const Times moments = key_moments(curve, options.ease, options.tolerance * size);
    WeightKeys keys;
    keys.chords = moments.error / unit;
    const auto add = [&](double time, double t) {
        keys.times.push_back(static_cast<float>(options.seconds * time));
        const std::vector<float> row = float_weights(curve, ease(options.ease, t));
        keys.weights.insert(keys.weights.end(), row.begin(), row.end());
    };
    for (const double t : moments.times) add(t, t);
    const std::size_t there = moments.times.size(), width = curve.nodes.size() - 1;
    constexpr std::size_t looks = 16; // keys at which floats are compared
    for (std::size_t i = 0; i < there; i += std::max<std::size_t>(1, there / looks)) {
        const double u = ease(options.ease, moments.times[i]);
        keys.floats = std::max(keys.floats, float_error(curve, u, &keys.weights[i * width]) / unit);
    }
    if (options.ping_pong)
        for (std::size_t i = there - 1; i-- > 0;) add(2 - moments.times[i], moments.times[i]);
    return keys;
}

} // namespace meshtween
