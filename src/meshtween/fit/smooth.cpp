// Eq. 6 of the paper: the area-weighted mean of the adjacent triangles' centres of gravity.
#include "meshtween/fit/smooth.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"

#include <Eigen/Geometry>

namespace meshtween {
namespace {

using Eigen::Index;

// Where Eq. 6 puts a vertex inside; where it is if nothing pulls.
Point inner_mean(Index i, const Points& positions, const Eigen::VectorXd& areas, const Triangles& triangles,
                 const Surroundings& around) {
    Point sum = Point::Zero();
    double total = 0;
    for (const int t : around.topology.vertex_triangles[i]) {
        const Point centre =
            (positions.row(triangles(t, 0)) + positions.row(triangles(t, 1)) + positions.row(triangles(t, 2))) / 3;
        sum += areas[t] * centre; // A_i C_i
        total += areas[t];
    }
    if (total > 0) return sum / total;
    const auto neighbours = around.topology.neighbours[i];
    if (neighbours.empty()) return positions.row(i);
    for (const int j : neighbours) sum += positions.row(j);
    return sum / static_cast<double>(neighbours.size());
}

// Eq. 6 on the boundary's own curve: edges for triangles, lengths for areas.
Point rim_mean(Index i, const Points& positions, std::span<const int> rim) {
    if (rim.size() != 2) return positions.row(i);
    const double before = (positions.row(rim[0]) - positions.row(i)).norm();
    const double after = (positions.row(rim[1]) - positions.row(i)).norm();
    if (!(before + after > 0)) return positions.row(i);
    return (before * (positions.row(rim[0]) + positions.row(i)) + after * (positions.row(rim[1]) + positions.row(i))) /
           (2 * (before + after));
}

Eigen::VectorXd areas_of(const Points& positions, const Triangles& triangles) {
    Eigen::VectorXd areas(triangles.rows());
    parallel_for(triangles.rows(), [&](Index t) { areas[t] = triangle_area(positions, triangles, t); });
    return areas;
}

} // namespace

Surroundings surroundings(Index vertex_count, const Triangles& triangles) {
    Surroundings around{topology(vertex_count, triangles), {}};
    std::vector<int>& first = around.rim.first;
    first.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
    for (const Edge& edge : around.topology.edges)
        if (edge.count == 1)
            for (const int v : edge.vertices) ++first[static_cast<std::size_t>(v) + 1];
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    around.rim.items.resize(static_cast<std::size_t>(first.back()));
    std::vector<int> next(first.begin(), first.end() - 1);
    const auto put = [&](int owner, int item) {
        around.rim.items[static_cast<std::size_t>(next[static_cast<std::size_t>(owner)]++)] = item;
    };
    for (const int greater : {1, 0}) // smaller neighbours first, so that lists ascend
        for (const Edge& edge : around.topology.edges)
            if (edge.count == 1)
                put(edge.vertices[static_cast<std::size_t>(greater)],
                    edge.vertices[static_cast<std::size_t>(1 - greater)]);
    return around;
}

Points smooth(const Points& positions, const Triangles& triangles, const Surroundings& around, double strength) {
    const Eigen::VectorXd areas = areas_of(positions, triangles);
    Points result(positions.rows(), 3);
    parallel_for(positions.rows(), [&](Index i) {
        const Point here = positions.row(i);
        const auto rim = around.rim[i];
        if (rim.empty()) {
            result.row(i) = here + strength * (inner_mean(i, positions, areas, triangles, around) - here);
            return;
        }
        Point along = Point::Zero();
        if (rim.size() == 2) along = (positions.row(rim[1]) - positions.row(rim[0])).normalized();
        result.row(i) = here + strength * (rim_mean(i, positions, rim) - here).dot(along) * along;
    });
    return result;
}

} // namespace meshtween
