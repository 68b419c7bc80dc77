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

// Of the target, that each vertex lies on.
std::vector<int> faces_at(const Points& x, const FitTarget& target, std::vector<int> places) {
    places.resize(idx(x.rows()), -1);
    parallel_for(
        x.rows(),
        [&](std::ptrdiff_t i) {
            int& place = places[idx(i)];
            place = target.index.closest(Point(x.row(i)), place).where.triangle;
        },
        64);
    return places;
}

// Where each vertex would go: the nearest place of a crease; its own place where an edge leads over none, or the other
// end is nearer to it.
Points wanted(const Points& x, const Topology& topology, const FitTarget& target, const std::vector<int>& faces,
              const Triangles& creases) {
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
double distance_around(Eigen::Index i, const Points& x, const Shell& shell, const FitTarget& target, int face) {
    int last = face; // where the last answer lay is near the next
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

// Of the vertices asked for, those that have moved where they should not have.
std::vector<int> ill_moved(const std::vector<int>& asked, const Points& from, const Points& to, const Shell& shell,
                           const FitTarget& target, const std::vector<int>& faces) {
    std::vector<char> ill(asked.size(), 0);
    parallel_for(
        std::ssize(asked),
        [&](std::ptrdiff_t k) {
            const int i = asked[idx(k)], face = faces[idx(i)];
            const auto around = shell.topology.vertex_triangles[i];
            ill[idx(k)] = std::any_of(around.begin(), around.end(),
                                      [&](int t) {
                                          return is_spoilt(double_area_normal(from, shell.triangles, t),
                                                           double_area_normal(to, shell.triangles, t));
                                      }) ||
                          distance_around(i, to, shell, target, face) >= distance_around(i, from, shell, target, face);
        },
        16);
    std::vector<int> result;
    for (std::size_t k = 0; k < asked.size(); ++k)
        if (ill[k]) result.push_back(asked[k]);
    return result;
}

} // namespace

Points creased(TangleSearch& search, const Points& positions, const Tangles& before, const std::vector<int>& places) {
    const Shell& shell = search.shell;
    const Triangles edges = creases(search.target, search.target.index.normals());
    if (edges.rows() == 0) return positions;
    const std::vector<int> faces = faces_at(positions, search.target, places);
    Points result = wanted(positions, shell.topology, search.target, faces, edges);
    std::vector<int> asked;
    const auto has_moved = [&](int i) { return result.row(i) != positions.row(i); };
    for (int i = 0; i < static_cast<int>(positions.rows()); ++i)
        if (has_moved(i)) asked.push_back(i);
    // Those go back, and whose neighbours went back is asked again: another may do better alone, or worse.
    const auto take_back = [&](const std::vector<int>& ill) {
        for (const int i : ill) result.row(i) = positions.row(i);
        asked.clear();
        for (const int i : ill)
            for (const int j : shell.topology.neighbours[i])
                if (has_moved(j)) asked.push_back(j);
        std::sort(asked.begin(), asked.end());
        asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
    };
    Tangles left = before;
    Points last = positions;
    for (bool any = true; any;) {
        while (!asked.empty()) take_back(ill_moved(asked, positions, result, shell, search.target, faces));
        left = tangles(search, result, left, touched(shell, last, result));
        last = result;
        std::vector<int> ill;
        const std::vector<char> tangled = newly_tangled(shell, before, left);
        for (int i = 0; i < static_cast<int>(tangled.size()); ++i)
            if (tangled[idx(i)] && has_moved(i)) ill.push_back(i);
        any = !ill.empty();
        take_back(ill);
    }
    return result;
}

} // namespace meshtween
