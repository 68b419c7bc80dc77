#include "meshtween/fit/nudge.h"

#include "meshtween/geometry/measure.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <limits>

namespace meshtween {
namespace {

constexpr std::array steps{0.1, 0.2, 0.4}; // of a vertex's shortest edge
constexpr double least_area = 0.1;         // of the smallest triangle's before
constexpr int most_rounds = 3;             // a vertex that has moved may free another

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// The mesh around a vertex.
struct Around {
    int flips = 0;       // triangles that look into the target
    double distance = 0; // from the triangles' centres to the target, squared
    double least_area = std::numeric_limits<double>::infinity();
};

Around around(const Shell& shell, const FitTarget& target, const Points& x, Eigen::Index vertex) {
    Around result;
    for (const int t : shell.topology.vertex_triangles[vertex]) {
        const auto corners = shell.triangles.row(t);
        const Point centre = (x.row(corners[0]) + x.row(corners[1]) + x.row(corners[2])) / 3;
        const ClosestPoint there = target.index.closest(centre);
        const Point area = double_area_normal(x, shell.triangles, t);
        if (area.dot(target.index.normals().row(there.where.triangle)) < 0) ++result.flips;
        result.distance += there.squared_distance;
        result.least_area = std::min(result.least_area, area.norm());
    }
    return result;
}

// Where the vertex does best, of some places around its own. `x` comes back as it was.
Point best_place(const Shell& shell, const FitTarget& target, Points& x, Eigen::Index vertex) {
    const Point start = x.row(vertex);
    double shortest = std::numeric_limits<double>::infinity();
    for (const int j : shell.topology.neighbours[vertex]) shortest = std::min(shortest, (x.row(j) - start).norm());
    const Around before = around(shell, target, x, vertex);
    Around best = before;
    Point place = start;
    for (const double step : steps)
        for (int direction = 0; direction < 27; ++direction) {
            const int a = direction % 3 - 1, b = direction / 3 % 3 - 1, c = direction / 9 - 1;
            const Point way(a, b, c);
            if (way.isZero()) continue;
            x.row(vertex) = target.index.closest(Point(start + step * shortest * way.normalized())).position;
            const Around now = around(shell, target, x, vertex);
            const bool better = now.flips < best.flips || (now.flips == best.flips && now.distance < best.distance);
            if (!better || now.flips >= before.flips || now.least_area < least_area * before.least_area) continue;
            best = now;
            place = x.row(vertex);
        }
    x.row(vertex) = start;
    return place;
}

} // namespace

Nudged nudge(TangleSearch& search, const Points& positions, const Tangles& before) {
    const Shell& shell = search.shell;
    Nudged result{positions, before};
    for (int round = 0; round < most_rounds && !result.left.flips.empty(); ++round) {
        Points now = result.positions;
        for (const int t : result.left.flips)
            for (int k = 0; k < 3; ++k) {
                const int vertex = shell.triangles(t, k);
                now.row(vertex) = best_place(shell, search.target, now, vertex);
            }
        const std::vector<char> asked = touched(shell, result.positions, now);
        Tangles left = tangles(search, now, result.left, asked);
        const std::vector<char> ill = newly_tangled(shell, result.left, left);
        for (Eigen::Index i = 0; i < now.rows(); ++i)
            if (ill[idx(i)]) now.row(i) = result.positions.row(i);
        left = tangles(search, now, result.left, asked);
        if (left.count() >= result.left.count() || left.cuts.size() > result.left.cuts.size()) break;
        result = {std::move(now), std::move(left)};
    }
    return result;
}

} // namespace meshtween
