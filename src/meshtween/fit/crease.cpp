#include "meshtween/fit/crease.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meshtween {
namespace {

const double smooth = std::cos(40 * std::numbers::pi / 180); // between faces that a crease does not part
constexpr double reach = 0.5;                                // of a vertex's mean edge: beyond, its neighbour is nearer
constexpr double least_area = 0.25;                          // of a triangle's before
constexpr double least_facing = 0.2;                         // cosine between a triangle's normals before and after

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// The edges between faces that meet at an angle, as triangles without area.
Triangles creases(const FitTarget& target, const Points& normals) {
    std::vector<std::array<int, 2>> found;
    for (const Edge& edge : target.topology.edges)
        if (edge.count == 2 && normals.row(edge.triangles[0]).dot(normals.row(edge.triangles[1])) < smooth)
            found.push_back(edge.vertices);
    Triangles result(std::ssize(found), 3);
    for (std::size_t e = 0; e < found.size(); ++e)
        result.row(static_cast<Eigen::Index>(e)) << found[e][0], found[e][1], found[e][1];
    return result;
}

// Where each vertex would go: the nearest place of a crease; its own place where an edge leads over none, or the other
// end is nearer to it.
Points wanted(const Points& x, const Topology& topology, const FitTarget& target, const Triangles& creases) {
    std::vector<int> faces(idx(x.rows())); // of the target, that the vertex lies on
    parallel_for(
        x.rows(), [&](std::ptrdiff_t i) { faces[idx(i)] = target.index.closest(Point(x.row(i))).where.triangle; }, 64);
    const Points& normals = target.index.normals();
    const auto leads_over = [&](Eigen::Index i, int j) {
        return normals.row(faces[idx(i)]).dot(normals.row(faces[idx(j)])) < smooth;
    };
    const ClosestPointIndex index(target.positions, creases);
    std::vector<ClosestPoint> places(idx(x.rows()));
    parallel_for(
        x.rows(),
        [&](std::ptrdiff_t i) {
            const auto list = topology.neighbours[i];
            if (std::none_of(list.begin(), list.end(), [&](int j) { return leads_over(i, j); })) return;
            double length = 0;
            for (const int j : list) length += (x.row(i) - x.row(j)).norm() / static_cast<double>(list.size());
            places[idx(i)] = index.closest(Point(x.row(i)), Compatible{}, reach * length);
        },
        64);
    Points result = x;
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        const ClosestPoint& mine = places[idx(i)];
        if (!mine.found()) continue;
        for (const int j : topology.neighbours[i])
            if (leads_over(i, j) && mine.squared_distance <= places[idx(j)].squared_distance)
                result.row(i) = mine.position;
    }
    return result;
}

// How far the mesh around a vertex lies from the target, squared: the middles of its edges and triangles.
double distance_around(Eigen::Index i, const Points& x, const Shell& shell, const FitTarget& target) {
    int last = -1; // where the last answer lay is near the next
    const auto squared = [&](const Point& at) {
        const ClosestPoint there = target.index.closest(at, last);
        last = there.where.triangle;
        return there.squared_distance;
    };
    double sum = 0;
    for (const int j : shell.topology.neighbours[i]) sum += squared((x.row(i) + x.row(j)) / 2);
    for (const int t : shell.topology.vertex_triangles[i]) {
        const auto corners = shell.triangles.row(t);
        sum += squared((x.row(corners[0]) + x.row(corners[1]) + x.row(corners[2])) / 3);
    }
    return sum;
}

bool is_spoilt(const Point& before, const Point& now) {
    return now.norm() < least_area * before.norm() || now.dot(before) < least_facing * now.norm() * before.norm();
}

// The vertices that have moved where they should not have.
std::vector<char> ill_moved(const std::vector<int>& moved, const Points& from, const Points& to, const Shell& shell,
                            const FitTarget& target) {
    std::vector<char> result(idx(from.rows()), 0);
    parallel_for(
        std::ssize(moved),
        [&](std::ptrdiff_t k) {
            const int i = moved[idx(k)];
            const auto around = shell.topology.vertex_triangles[i];
            result[idx(i)] = std::any_of(around.begin(), around.end(),
                                         [&](int t) {
                                             return is_spoilt(double_area_normal(from, shell.triangles, t),
                                                              double_area_normal(to, shell.triangles, t));
                                         }) ||
                             distance_around(i, to, shell, target) >= distance_around(i, from, shell, target);
        },
        16);
    return result;
}

} // namespace

Points creased(TangleSearch& search, const Points& positions, const Tangles& before) {
    const Triangles edges = creases(search.target, search.target.index.normals());
    if (edges.rows() == 0) return positions;
    Points result = wanted(positions, search.shell.topology, search.target, edges);
    std::vector<int> moved;
    for (Eigen::Index i = 0; i < positions.rows(); ++i)
        if (result.row(i) != positions.row(i)) moved.push_back(static_cast<int>(i));
    const auto take_back = [&](const std::vector<char>& ill) {
        const auto count = moved.size();
        std::erase_if(moved, [&](int i) {
            if (ill[idx(i)]) result.row(i) = positions.row(i);
            return ill[idx(i)] != 0;
        });
        return moved.size() < count;
    };
    do { // a vertex that goes back may leave another alone
        while (take_back(ill_moved(moved, positions, result, search.shell, search.target))) {
        }
    } while (take_back(newly_tangled(search.shell, before,
                                     tangles(search, result, before, touched(search.shell, positions, result)))));
    return result;
}

} // namespace meshtween
