#include "meshtween/fit/region.h"

#include "meshtween/core/parallel.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace meshtween {
namespace {

constexpr int rings = 8;

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

using Box = Eigen::AlignedBox3d;

// Boxes around the connected parts of what lies within some rings of the triangles, a mean edge wider.
std::vector<Box> boxes_around(const Shell& shell, const Points& positions, std::span<const int> triangles) {
    std::vector<char> near(idx(shell.rest.rows()), 0);
    std::vector<int> reached;
    const auto reach = [&](int vertex) {
        if (near[idx(vertex)]) return;
        near[idx(vertex)] = 1;
        reached.push_back(vertex);
    };
    for (const int t : triangles)
        for (int k = 0; k < 3; ++k) reach(shell.triangles(t, k));
    std::size_t next = 0;
    for (int ring = 0; ring < rings; ++ring)
        for (const std::size_t end = reached.size(); next < end; ++next)
            for (const int j : shell.topology.neighbours[reached[next]]) reach(j);
    std::vector<Box> boxes;
    for (const int seed : reached) {
        if (!near[idx(seed)]) continue;
        near[idx(seed)] = 0;
        std::vector<int> part{seed};
        Box box;
        double lengths = 0, edges = 0;
        for (std::size_t k = 0; k < part.size(); ++k) {
            box.extend(positions.row(part[k]).transpose());
            for (const int j : shell.topology.neighbours[part[k]]) {
                lengths += (positions.row(j) - positions.row(part[k])).norm(), ++edges;
                if (near[idx(j)]) near[idx(j)] = 0, part.push_back(j);
            }
        }
        const Eigen::Vector3d edge = Eigen::Vector3d::Constant(edges > 0 ? lengths / edges : 0);
        boxes.emplace_back(box.min() - edge, box.max() + edge);
    }
    return boxes;
}

} // namespace

int Region::triangle(int whole) const {
    const auto found = std::lower_bound(triangles.begin(), triangles.end(), whole);
    return found != triangles.end() && *found == whole ? static_cast<int>(found - triangles.begin()) : -1;
}

Region region_around(const Shell& shell, const Points& positions, std::span<const int> triangles) {
    const std::vector<Box> boxes = boxes_around(shell, positions, triangles);
    std::vector<char> inside(idx(shell.triangles.rows()), 0);
    parallel_for(shell.triangles.rows(), [&](std::ptrdiff_t t) {
        Box own;
        for (int k = 0; k < 3; ++k) own.extend(positions.row(shell.triangles(t, k)).transpose());
        inside[idx(t)] = std::ranges::any_of(boxes, [&](const Box& box) { return box.intersects(own); });
    });
    Region region;
    std::vector<int> number(idx(shell.rest.rows()), -1);
    for (Eigen::Index t = 0; t < shell.triangles.rows(); ++t) {
        if (!inside[idx(t)]) continue;
        region.triangles.push_back(static_cast<int>(t));
        for (int k = 0; k < 3; ++k) number[idx(shell.triangles(t, k))] = 0;
    }
    for (std::size_t i = 0; i < number.size(); ++i)
        if (number[i] == 0) {
            number[i] = static_cast<int>(region.vertices.size());
            region.vertices.push_back(static_cast<int>(i));
        }
    region.shell.rest = shell.rest(region.vertices, Eigen::all);
    region.shell.triangles =
        shell.triangles(region.triangles, Eigen::all).unaryExpr([&](int i) { return number[idx(i)]; });
    region.shell.topology = topology(region.shell.rest.rows(), region.shell.triangles);
    return region;
}

} // namespace meshtween
