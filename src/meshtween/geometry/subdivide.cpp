#include "meshtween/geometry/subdivide.h"

#include "meshtween/geometry/topology.h"

#include <algorithm>

namespace meshtween {
namespace {

// Rows of corners cut in four, and the pair of rows between which each new row lies.
struct Cut {
    Triangles triangles;
    std::vector<Edge> edges;
};

Cut cut_in_four(Eigen::Index count, const Triangles& triangles) {
    Cut cut{Triangles(4 * triangles.rows(), 3), topology(count, triangles).edges};
    const auto middle = [&](int a, int b) {
        const std::array<int, 2> ends{std::min(a, b), std::max(a, b)};
        const auto edge = std::lower_bound(cut.edges.begin(), cut.edges.end(), ends,
                                           [](const Edge& e, const auto& key) { return e.vertices < key; });
        return static_cast<int>(count + (edge - cut.edges.begin()));
    };
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
        const int a = triangles(t, 0), b = triangles(t, 1), c = triangles(t, 2);
        const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        cut.triangles.middleRows<4>(4 * t) << a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca;
    }
    return cut;
}

template <typename Rows>
Rows with_midpoints(const Rows& rows, const std::vector<Edge>& edges) {
    Rows all(rows.rows() + static_cast<Eigen::Index>(edges.size()), rows.cols());
    all.topRows(rows.rows()) = rows;
    Eigen::Index next = rows.rows();
    for (const Edge& e : edges) all.row(next++) = (rows.row(e.vertices[0]) + rows.row(e.vertices[1])) / 2;
    return all;
}

} // namespace

Mesh subdivide(const Mesh& mesh, int times) {
    Mesh fine = mesh;
    for (int i = 0; i < times; ++i) {
        const Cut cut = cut_in_four(fine.positions.rows(), fine.triangles);
        fine.positions = with_midpoints(fine.positions, cut.edges);
        if (fine.colors.rows() > 0) fine.colors = with_midpoints(fine.colors, cut.edges);
        if (fine.texcoords.rows() > 0) {
            Cut seams = cut_in_four(fine.texcoords.rows(), fine.texcoord_triangles);
            fine.texcoords = with_midpoints(fine.texcoords, seams.edges);
            fine.texcoord_triangles = std::move(seams.triangles);
        }
        fine.triangles = cut.triangles;
    }
    return fine;
}

} // namespace meshtween
