// Schaefer, McPhail, Warren: Image deformation using moving least squares. SIGGRAPH 2006; here in space, between
// surfaces, with similarities.
#include "meshtween/fit/loose_parts.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/align.h"
#include "meshtween/fit/free_region.h"
#include "meshtween/fit/shell.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/search/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshtween {
namespace {

constexpr double small = 0.1;       // of the largest part's area
constexpr double unseen = 0.9;      // of a part's own area, that nothing draws
constexpr Eigen::Index enough = 12; // vertices that tell a similarity
constexpr double around = 1;        // of a part's diagonal: how far the surface beside it tells where it goes

std::size_t idx(auto i) {
    return static_cast<std::size_t>(i);
}

// The fitted surface that parts follow.
struct Host {
    const Points& before;
    const Points& after;
    std::vector<double> area; // a vertex
    ClosestPointIndex index;
    double edge = 0; // mean length
};

// The host's vertices that may count for a part, by their first coordinate.
struct Surroundings {
    Points before, after;
    std::vector<double> area;

    Eigen::Index count() const { return before.rows(); }
    // Those whose first coordinate lies within; all where they are too few.
    Surroundings between(double low, double high) const {
        const auto x = before.col(0);
        const auto first = std::lower_bound(x.begin(), x.end(), low) - x.begin(),
                   last = std::upper_bound(x.begin(), x.end(), high) - x.begin();
        if (last - first < enough) return *this;
        return {before.middleRows(first, last - first),
                after.middleRows(first, last - first),
                {area.begin() + first, area.begin() + last}};
    }
};

Surroundings surroundings(const Host& host, const Eigen::AlignedBox3d& box) {
    std::vector<int> inside;
    for (int i = 0; i < host.before.rows(); ++i)
        if (box.contains(host.before.row(i).transpose())) inside.push_back(i);
    std::sort(inside.begin(), inside.end(),
              [&](int i, int j) { return std::pair(host.before(i, 0), i) < std::pair(host.before(j, 0), j); });
    Surroundings result{host.before(inside, Eigen::all), host.after(inside, Eigen::all), {}};
    for (const int i : inside) result.area.push_back(host.area[idx(i)]);
    return result;
}

// At least so many that a similarity is well told, from a box that grows.
Surroundings enough_around(const Host& host, const Eigen::AlignedBox3d& part, double reach) {
    for (;; reach *= 2) {
        const Eigen::Vector3d margin = Eigen::Vector3d::Constant(reach);
        Surroundings result = surroundings(host, {part.min() - margin, part.max() + margin});
        if (result.count() >= std::min(enough, host.before.rows())) return result;
    }
}

// The similarity by which the surroundings have gone, each vertex by its area and a Gaussian of its distance. What has
// gone another way than the most counts less (Geman and McClure's weights), such as a lip that is folded over.
Similarity motion(const Surroundings& near, const Eigen::VectorXd& squared_distances, double width) {
    constexpr int rounds = 5;
    const double least = squared_distances.minCoeff(); // so that the nearest counts, however far
    Eigen::VectorXd weights(near.count());
    for (Eigen::Index i = 0; i < near.count(); ++i)
        weights[i] = near.area[idx(i)] * std::exp(-(squared_distances[i] - least) / (width * width));
    Similarity result = align(near.before, near.after, weights);
    for (int round = 0; round < rounds; ++round) {
        const Eigen::VectorXd squared = (result(near.before) - near.after).rowwise().squaredNorm();
        const double spread = weights.dot(squared) / weights.sum();
        if (!(spread > 0)) break;
        const Eigen::VectorXd share = (1 + squared.array() / spread).square().inverse();
        result = align(near.before, near.after, weights.cwiseProduct(share));
    }
    return result;
}

// A body has an inside; a sheet, such as lashes or hair, has none.
bool is_body(const Portion& part) {
    constexpr double round = 0.6; // of the squared diagonal: a ball's area is 1.05, a flat square's 0.5
    const Topology topology = meshtween::topology(part.positions.rows(), part.triangles);
    const bool closed = std::ranges::none_of(topology.on_boundary, [](char flag) { return flag != 0; });
    return closed ||
           surface_area(part.positions, part.triangles) > round * std::pow(diagonal(part.positions, part.triangles), 2);
}

Points carried_body(const Host& host, const Portion& part) {
    const ClosestPointIndex surface(part.positions, part.triangles);
    double nearest = std::numeric_limits<double>::infinity();
    for (const ClosestPoint& c : host.index.closest(part.positions)) nearest = std::min(nearest, c.squared_distance);
    const double width = around * diagonal(part.positions, part.triangles) + 2 * std::sqrt(nearest) + host.edge;
    const Surroundings near = enough_around(host, bounding_box(part.positions, part.triangles), 3 * width);
    Eigen::VectorXd squared(near.count());
    const std::vector<ClosestPoint> closest = surface.closest(near.before);
    for (Eigen::Index i = 0; i < near.count(); ++i) squared[i] = closest[idx(i)].squared_distance;
    return motion(near, squared, width)(part.positions);
}

Points carried_points(const Host& host, const Points& points) {
    constexpr double far = 2, fine = 3; // a point's width: distances from the host, and its edges
    Points result(points.rows(), 3);
    if (points.rows() == 0) return result;
    const std::vector<ClosestPoint> closest = host.index.closest(points);
    const auto width = [&](Eigen::Index i) {
        return far * std::sqrt(closest[idx(i)].squared_distance) + fine * host.edge;
    };
    double widest = 0;
    for (Eigen::Index i = 0; i < points.rows(); ++i) widest = std::max(widest, width(i));
    const Surroundings near = enough_around(host, bounding_box(points, Triangles(0, 3)), 3 * widest);
    parallel_for(
        points.rows(),
        [&](std::ptrdiff_t i) {
            const Point at = points.row(i);
            const double reach = 3 * width(i); // where the Gaussian has fallen to a ten-thousandth
            const Surroundings own = near.between(at[0] - reach, at[0] + reach);
            const Eigen::VectorXd squared = (own.before.rowwise() - at).rowwise().squaredNorm();
            result.row(i) = motion(own, squared, width(i))(Points(at)).row(0);
        },
        16);
    return result;
}

} // namespace

std::vector<char> following_parts(const Points& positions, const Triangles& triangles, const std::vector<int>& chosen,
                                  const std::vector<int>& part, const std::vector<int>& marked,
                                  const std::vector<char>& free, PartsMode mode) {
    const int count = part.empty() ? 0 : *std::max_element(part.begin(), part.end()) + 1;
    std::vector<double> area(idx(count), 0.0), of_free(idx(count), 0.0);
    for (std::size_t i = 0; i < chosen.size(); ++i)
        if (free[idx(chosen[i])] != 0) of_free[idx(part[i])] += triangle_area(positions, triangles, chosen[i]);
    for (std::size_t i = 0; i < chosen.size(); ++i)
        area[idx(part[i])] += triangle_area(positions, triangles, chosen[i]);
    std::vector<char> follows(idx(count), 0);
    if (mode == PartsMode::fit || count < 2) return follows;
    const double largest = *std::max_element(area.begin(), area.end());
    for (std::size_t p = 0; p < follows.size(); ++p)
        follows[p] = area[p] < (mode == PartsMode::follow ? 1 : small) * largest ||
                     (area[p] < largest && of_free[p] > unseen * area[p]);
    for (std::size_t i = 0; i < chosen.size(); ++i)
        if (std::binary_search(marked.begin(), marked.end(), chosen[i])) follows[idx(part[i])] = 0;
    return follows;
}

void carry(const Portion& fitted, const Points& now, const Carried& carried, const Points& rest, Points& x) {
    if (!carried.any()) return;
    const Topology topology = meshtween::topology(fitted.positions.rows(), fitted.triangles);
    const Host host{fitted.positions, now, vertex_area_shares(fitted.positions, fitted.triangles),
                    ClosestPointIndex(fitted.positions, fitted.triangles),
                    mean_edge_length(fitted.positions, topology)};
    std::vector<Points> moved(carried.parts.size());
    parallel_for(
        std::ssize(moved),
        [&](std::ptrdiff_t p) {
            const Portion& part = carried.parts[idx(p)];
            moved[idx(p)] = is_body(part) ? carried_body(host, part) : carried_points(host, part.positions);
        },
        1);
    for (std::size_t p = 0; p < moved.size(); ++p) put_rows(carried.parts[p], moved[p], x);
    for (const int v : carried.strays) x.row(v) = carried_points(host, rest.row(v)).row(0); // each may lie anywhere
    const Portion& region = carried.region;
    if (region.vertex.empty()) return;
    std::vector<char> held;
    for (const int v : region.vertex) held.push_back(fitted.of_vertex[idx(v)] >= 0 ? 1 : 0);
    put_rows(region, attached(region, carried_points(host, region.positions), held, rows_of(region, x)), x);
}

} // namespace meshtween
