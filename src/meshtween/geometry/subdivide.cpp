#include "meshtween/geometry/subdivide.h"

#include <algorithm>

namespace meshtween {
namespace {

// How each triangle is cut: which of its sides (k: from corner k to the next), and across which diagonal the
// four-sided piece goes that two cut sides leave.
struct CutPlan {
    std::vector<std::array<char, 3>> sides;
    std::vector<char> other_diagonal;
};

// Rows of corners cut, and the pair of rows between which each new row lies.
struct Cut {
    Triangles triangles;
    std::vector<std::array<int, 2>> edges;
};

std::array<int, 2> ends_of(const Triangles& triangles, Eigen::Index t, int k) {
    const int a = triangles(t, k), b = triangles(t, (k + 1) % 3);
    return {std::min(a, b), std::max(a, b)};
}

std::vector<std::array<int, 2>> cut_edges(const Triangles& triangles, const CutPlan& plan) {
    std::vector<std::array<int, 2>> edges;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            if (plan.sides[static_cast<std::size_t>(t)][static_cast<std::size_t>(k)] != 0)
                edges.push_back(ends_of(triangles, t, k));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

Cut cut_up(Eigen::Index count, const Triangles& triangles, const CutPlan& plan) {
    Cut cut{Triangles(4 * triangles.rows(), 3), cut_edges(triangles, plan)};
    Eigen::Index rows = 0;
    const auto put = [&](int a, int b, int c) { cut.triangles.row(rows++) << a, b, c; };
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
        const auto& sides = plan.sides[static_cast<std::size_t>(t)];
        const int cuts = sides[0] + sides[1] + sides[2];
        int first = 0; // corner from which the pattern starts: its side is cut, and with two, the next one too
        if (cuts == 1 || cuts == 2)
            while (sides[static_cast<std::size_t>(first)] == 0 ||
                   (cuts == 2 && sides[static_cast<std::size_t>((first + 1) % 3)] == 0))
                ++first;
        const int a = triangles(t, first), b = triangles(t, (first + 1) % 3), c = triangles(t, (first + 2) % 3);
        const auto middle = [&](int k) {
            const auto edge =
                std::lower_bound(cut.edges.begin(), cut.edges.end(), ends_of(triangles, t, (first + k) % 3));
            return static_cast<int>(count + (edge - cut.edges.begin()));
        };
        if (cuts == 0) {
            put(a, b, c);
        } else if (cuts == 1) {
            const int ab = middle(0);
            put(a, ab, c), put(ab, b, c);
        } else if (cuts == 2) {
            const int ab = middle(0), bc = middle(1);
            put(ab, b, bc);
            if (plan.other_diagonal[static_cast<std::size_t>(t)] != 0)
                put(a, ab, c), put(ab, bc, c);
            else
                put(a, ab, bc), put(a, bc, c);
        } else {
            const int ab = middle(0), bc = middle(1), ca = middle(2);
            put(a, ab, ca), put(ab, b, bc), put(ca, bc, c), put(ab, bc, ca);
        }
    }
    cut.triangles.conservativeResize(rows, 3);
    return cut;
}

template <typename Rows>
Rows with_midpoints(const Rows& rows, const std::vector<std::array<int, 2>>& edges) {
    Rows all(rows.rows() + static_cast<Eigen::Index>(edges.size()), rows.cols());
    all.topRows(rows.rows()) = rows;
    Eigen::Index next = rows.rows();
    for (const auto& e : edges) all.row(next++) = (rows.row(e[0]) + rows.row(e[1])) / 2;
    return all;
}

Mesh cut_mesh(const Mesh& mesh, const CutPlan& plan) {
    Mesh fine;
    Cut cut = cut_up(mesh.positions.rows(), mesh.triangles, plan);
    fine.positions = with_midpoints(mesh.positions, cut.edges);
    if (mesh.colors.rows() > 0) fine.colors = with_midpoints(mesh.colors, cut.edges);
    if (mesh.texcoords.rows() > 0) {
        Cut seams = cut_up(mesh.texcoords.rows(), mesh.texcoord_triangles, plan);
        fine.texcoords = with_midpoints(mesh.texcoords, seams.edges);
        fine.texcoord_triangles = std::move(seams.triangles);
    }
    fine.triangles = std::move(cut.triangles);
    return fine;
}

} // namespace

Mesh subdivide(const Mesh& mesh, int times) {
    Mesh fine = mesh;
    for (int i = 0; i < times; ++i) {
        const auto count = static_cast<std::size_t>(fine.triangles.rows());
        fine = cut_mesh(fine, {std::vector<std::array<char, 3>>(count, {1, 1, 1}), std::vector<char>(count, 0)});
    }
    return fine;
}

namespace {

CutPlan planned(const Mesh& mesh, const Topology& topology, const std::vector<char>& cut) {
    CutPlan plan;
    const auto flag = [&](const std::array<int, 2>& ends) {
        const auto edge = std::lower_bound(topology.edges.begin(), topology.edges.end(), ends,
                                           [](const Edge& e, const auto& key) { return e.vertices < key; });
        return cut[static_cast<std::size_t>(edge - topology.edges.begin())];
    };
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
        std::array<char, 3> sides{};
        for (int k = 0; k < 3; ++k)
            sides[static_cast<std::size_t>(k)] = flag(ends_of(mesh.triangles, t, k)) != 0 ? 1 : 0;
        plan.sides.push_back(sides);
        // The corner that the whole side ends at, and its opposite middles: the shorter diagonal is taken.
        int whole = 0;
        while (whole < 2 && sides[static_cast<std::size_t>(whole)] != 0) ++whole;
        const auto corner = [&](int k) { return Point(mesh.positions.row(mesh.triangles(t, k % 3))); };
        const Point c = corner(whole), a = corner(whole + 1), b = corner(whole + 2);
        plan.other_diagonal.push_back(((a + b) / 2 - c).norm() < ((b + c) / 2 - a).norm() ? 1 : 0);
    }
    return plan;
}

} // namespace

Mesh subdivide(const Mesh& mesh, const Topology& topology, const std::vector<char>& cut) {
    return cut_mesh(mesh, planned(mesh, topology, cut));
}

Mesh subdivide(const Mesh& mesh, const Mesh& whole, const Topology& topology, const std::vector<char>& cut) {
    return cut_mesh(mesh, planned(whole, topology, cut));
}

} // namespace meshtween
