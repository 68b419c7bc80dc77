#include "meshtween/fit/border.h"

#include <array>
#include <numeric>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

} // namespace

Triangles border_edges(const Triangles& triangles, const Topology& topology) {
    std::vector<std::array<int, 2>> edges;
    for (const Edge& edge : topology.edges) {
        if (edge.count != 1) continue;
        const auto [a, b] = edge.vertices;
        const auto f = triangles.row(edge.triangles[0]);
        bool along = false;
        for (int k = 0; k < 3; ++k) along |= f[k] == a && f[(k + 1) % 3] == b;
        edges.push_back(along ? std::array{a, b} : std::array{b, a});
    }
    Triangles result(std::ssize(edges), 3);
    for (std::size_t e = 0; e < edges.size(); ++e)
        result.row(static_cast<Eigen::Index>(e)) << edges[e][0], edges[e][1], edges[e][1];
    return result;
}

Points border_directions(const Points& positions, const Triangles& border) {
    Points result = Points::Zero(positions.rows(), 3);
    for (Eigen::Index e = 0; e < border.rows(); ++e) {
        const Point along = positions.row(border(e, 1)) - positions.row(border(e, 0));
        result.row(border(e, 0)) += along;
        result.row(border(e, 1)) += along;
    }
    for (Eigen::Index i = 0; i < result.rows(); ++i)
        if (result.row(i).norm() > 0) result.row(i).normalize();
    return result;
}

std::vector<double> border_sizes(const Points& positions, const Triangles& border) {
    if (border.rows() == 0) return {};
    std::vector<double> sizes(idx(positions.rows()), 0);
    std::vector<int> parent(sizes.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int v) {
        while (parent[idx(v)] != v) v = parent[idx(v)] = parent[idx(parent[idx(v)])];
        return v;
    };
    for (Eigen::Index e = 0; e < border.rows(); ++e) parent[idx(root(border(e, 0)))] = root(border(e, 1));
    Points low = positions, high = positions;
    for (const int v : border.reshaped()) {
        low.row(root(v)) = low.row(root(v)).cwiseMin(positions.row(v));
        high.row(root(v)) = high.row(root(v)).cwiseMax(positions.row(v));
    }
    for (const int v : border.reshaped()) sizes[idx(v)] = (high.row(root(v)) - low.row(root(v))).norm();
    return sizes;
}

} // namespace meshtween
