#include "meshtween/fit/marker_doubts.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/fit/align.h"
#include "meshtween/fit/rbf.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meshtween {
namespace {

constexpr Eigen::Index least_pairs = 8, most_pairs = 120; // a warp without each takes their fourth power
constexpr double mirrored = 1.0 / 3;                      // of the distance that is left without a mirror
constexpr double exchanged = 0.25;                        // of both distances that are left without an exchange
constexpr double outlying = 8;                            // times the median distance from where the others say
constexpr double worth = 0.03;                            // of the extent: smaller distances are no mistake

std::size_t idx(auto i) {
    return static_cast<std::size_t>(i);
}

double left_over(const Points& from, const Points& to) {
    return (align(from, to)(from) - to).norm();
}

Points without_row(const Points& points, Eigen::Index row) {
    Points rest(points.rows() - 1, 3);
    rest << points.topRows(row), points.bottomRows(points.rows() - row - 1);
    return rest;
}

// Where the others say that each pair's target is.
Points said_by_others(const Points& from, const Points& to) {
    Points said = to;
    parallel_for(
        from.rows(),
        [&](std::ptrdiff_t k) {
            try {
                said.row(k) = warp(without_row(from, k), without_row(to, k))(Points(from.row(k))).row(0);
            } catch (const Error&) { // pairs that no warp can use say nothing
            }
        },
        1);
    return said;
}

} // namespace

std::vector<std::string> marker_doubts(const Points& source, const Points& target,
                                       const std::vector<std::string>& names) {
    std::vector<std::string> doubts;
    if (source.rows() < least_pairs) return doubts;
    Points mirror = source;
    mirror.col(0) *= -1;
    const double plain = left_over(source, target), other = left_over(mirror, target);
    if (other < mirrored * plain) {
        doubts.push_back(fmt::format("the markers fit the mirror image {:.0f} times better: the target is mirrored, or "
                                     "left and right are exchanged in the names on one side",
                                     other > 0 ? plain / other : 1000));
        return doubts;
    }
    if (source.rows() > most_pairs) return doubts;
    const Points from = align(source, target)(source), said = said_by_others(from, target);
    const Eigen::VectorXd off = (said - target).rowwise().norm();
    const double extent = (target.colwise().maxCoeff() - target.colwise().minCoeff()).norm();
    std::vector<Eigen::Index> order(idx(off.size()));
    std::iota(order.begin(), order.end(), Eigen::Index{0});
    std::ranges::stable_sort(order, std::greater<>(), [&](Eigen::Index k) { return off[k]; });
    const double typical = off[order[order.size() / 2]];
    std::vector<char> told(order.size(), 0);
    for (const Eigen::Index i : order)
        for (const Eigen::Index j : order) {
            if (j <= i || told[idx(i)] != 0 || told[idx(j)] != 0 || off[i] + off[j] < 2 * worth * extent) continue;
            Points swapped = target;
            swapped.row(i).swap(swapped.row(j));
            const double before = left_over(from, target), after = left_over(from, swapped);
            if (after >= before) continue;
            const double left = (said.row(i) - target.row(j)).norm() + (said.row(j) - target.row(i)).norm();
            if (left > exchanged * (off[i] + off[j])) continue;
            told[idx(i)] = told[idx(j)] = 1;
            doubts.push_back(fmt::format("markers '{}' and '{}' seem to be exchanged on one side: the other markers "
                                         "say so",
                                         names[idx(i)], names[idx(j)]));
        }
    if (!doubts.empty()) return doubts; // one mistake makes others look wrong
    for (const Eigen::Index k : order) {
        if (off[k] < outlying * typical || off[k] < worth * extent || doubts.size() == 3) break;
        const Points others = without_row(from, k);
        if (off[k] < 2 * (others.rowwise() - from.row(k)).rowwise().norm().minCoeff())
            continue; // beyond the others: a warp tells little there
        doubts.push_back(
            fmt::format("marker '{}' lies {:.0f} % of the markers' extent from where the others say: is it "
                        "right?",
                        names[idx(k)], 100 * off[k] / extent));
    }
    return doubts;
}

} // namespace meshtween
