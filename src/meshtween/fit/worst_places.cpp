#include "meshtween/fit/worst_places.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

constexpr double worth_telling = 0.2; // of the badness
constexpr double near_marker = 0.03, near_suggestion = 0.05;

// The largest factor, at least 1, by which an edge at each vertex has changed beyond the change of the whole.
std::vector<double> stretch(const Mesh& source, const Mesh& fitted) {
    std::vector<double> factor(idx(source.positions.rows()), 1.0), logarithms;
    const auto each = [&](const auto& visit) {
        for (Eigen::Index t = 0; t < source.triangles.rows(); ++t)
            for (int k = 0; k < 3; ++k) {
                const int i = source.triangles(t, k), j = source.triangles(t, (k + 1) % 3);
                const double before = (source.positions.row(i) - source.positions.row(j)).norm(),
                             after = (fitted.positions.row(i) - fitted.positions.row(j)).norm();
                if (before > 0 && after > 0) visit(i, j, std::log(after / before));
            }
    };
    each([&](int, int, double l) { logarithms.push_back(l); });
    if (logarithms.empty()) return factor;
    const auto middle = logarithms.begin() + std::ssize(logarithms) / 2;
    std::nth_element(logarithms.begin(), middle, logarithms.end());
    const double usual = *middle;
    const Weld one = seams(source, {&source.positions, &fitted.positions});
    each([&](int i, int j, double l) {
        const double f = std::exp(std::abs(l - usual));
        for (const int v : {i, j}) {
            const int at = one.any() ? one.first[idx(one.vertex[idx(v)])] : v;
            factor[idx(at)] = std::max(factor[idx(at)], f);
        }
    });
    one.share(factor);
    return factor;
}

double least_distance(const Point& at, const Points& others) {
    return others.rows() == 0 ? std::numeric_limits<double>::infinity()
                              : std::sqrt((others.rowwise() - at).rowwise().squaredNorm().minCoeff());
}

void append(Points& points, const Point& point) {
    points.conservativeResize(points.rows() + 1, 3);
    points.row(points.rows() - 1) = point;
}

} // namespace

std::string_view name_of(PlaceFault fault) {
    constexpr std::array<std::string_view, 5> names{"off target", "uncovered", "facing away", "beyond the target",
                                                    "stretched"};
    return names[static_cast<std::size_t>(fault)];
}

std::vector<WorstPlace> place_faults(const Mesh& source, const Mesh& fitted, const Correspondence& map) {
    constexpr double far = 0.005, turned = 0.5, drawn_out = 3;
    const std::vector<double> factor = stretch(source, fitted);
    std::vector<WorstPlace> faults(map.places.size());
    for (std::size_t i = 0; i < faults.size(); ++i) {
        WorstPlace& f = faults[i];
        f.vertex = static_cast<int>(i);
        if (map.border[i] == 2) continue; // carried along
        const auto offer = [&](PlaceFault fault, double badness, double value) {
            if (badness > f.badness) f.fault = fault, f.badness = badness, f.value = value;
        };
        if (map.border[i] != 0)
            offer(PlaceFault::beyond, std::min(1.0, map.distance[i] / far), map.distance[i]);
        else
            offer(PlaceFault::off_target, map.distance[i] / far, map.distance[i]);
        offer(PlaceFault::uncovered, map.uncovered[i] / far, map.uncovered[i]);
        if (map.border[i] == 0) offer(PlaceFault::facing_away, (1 - map.agreement[i]) / turned, map.agreement[i]);
        offer(PlaceFault::stretched, std::log(factor[i]) / std::log(drawn_out), factor[i]);
    }
    return faults;
}

std::vector<WorstPlace> worst_places(const Mesh& fitted, const std::vector<WorstPlace>& faults, std::size_t count,
                                     double apart) {
    std::vector<WorstPlace> order, chosen;
    std::copy_if(faults.begin(), faults.end(), std::back_inserter(order),
                 [](const WorstPlace& f) { return f.badness >= worth_telling; });
    std::stable_sort(order.begin(), order.end(),
                     [](const WorstPlace& a, const WorstPlace& b) { return a.badness > b.badness; });
    const double least = apart * diagonal(fitted);
    Points places(0, 3);
    for (const WorstPlace& f : order) {
        if (chosen.size() == count) break;
        const Point at = fitted.positions.row(f.vertex);
        if (least_distance(at, places) < least) continue;
        chosen.push_back(f);
        append(places, at);
    }
    return chosen;
}

std::vector<MarkerSuggestion> suggest_markers(const Mesh& source, const Mesh& target, const Correspondence& map,
                                              const std::vector<WorstPlace>& faults, std::span<const Marker> markers,
                                              std::size_t count) {
    const double size = diagonal(source);
    Points taken(0, 3);
    for (const Marker& m : markers) append(taken, position(source.positions, source.triangles, m.source));
    Eigen::VectorXd alone(source.positions.rows()); // to the nearest marker, parts of the diagonal
    parallel_for(alone.size(),
                 [&](std::ptrdiff_t i) { alone[i] = least_distance(source.positions.row(i), taken) / size; });
    Eigen::VectorXd apart = // from the nearest suggestion
        Eigen::VectorXd::Constant(alone.size(), std::numeric_limits<double>::infinity());
    const Point centre = source.positions.colwise().mean();
    std::vector<MarkerSuggestion> chosen;
    while (chosen.size() < count) {
        int best = -1;
        double most = 0;
        for (Eigen::Index i = 0; i < alone.size(); ++i) {
            if (alone[i] < near_marker || apart[i] < near_suggestion || map.border[idx(i)] != 0) continue;
            const double nearest = std::min(alone[i], apart[i]);
            const double lonely = std::isfinite(nearest) ? nearest : (source.positions.row(i) - centre).norm() / size;
            const double gain = lonely * (worth_telling + std::min(faults[idx(i)].badness, 10.0));
            if (gain > most) most = gain, best = static_cast<int>(i);
        }
        if (best < 0) break;
        const WorstPlace& f = faults[idx(best)];
        MarkerSuggestion s{f, position(target.positions, target.triangles, map.places[idx(best)]), alone[best]};
        if (f.fault == PlaceFault::uncovered && f.badness >= 1) s.target = map.uncovered_at.row(best);
        chosen.push_back(s);
        for (Eigen::Index i = 0; i < apart.size(); ++i)
            apart[i] = std::min(apart[i], (source.positions.row(i) - source.positions.row(best)).norm() / size);
    }
    return chosen;
}

} // namespace meshtween
