// A mesh whose numbering is cut, as files are cut where attributes jump.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/geometry/topology.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace meshtween {

struct CutMesh {
    Mesh mesh;                                                            // copies of vertices come after the others
    std::vector<int> vertex;                                              // the vertex that each was
    Points whole(const Points& x) const { return x(vertex, Eigen::all); } // rows of the whole mesh, each copy its own
};

// Cut along these edges (smaller vertex first). Texture coordinates stay with their corners.
inline CutMesh cut_along(const Mesh& mesh, const std::set<std::pair<int, int>>& edges) {
    CutMesh cut{mesh, std::vector<int>(static_cast<std::size_t>(mesh.positions.rows()))};
    std::iota(cut.vertex.begin(), cut.vertex.end(), 0);
    const Topology top = topology(mesh.positions.rows(), mesh.triangles);
    std::vector<char> touched(cut.vertex.size(), 0);
    for (const auto& [a, b] : edges) touched[static_cast<std::size_t>(a)] = touched[static_cast<std::size_t>(b)] = 1;
    for (int v = 0; v < mesh.positions.rows(); ++v) {
        if (touched[static_cast<std::size_t>(v)] == 0) continue;
        std::vector<int> left(top.vertex_triangles[v].begin(), top.vertex_triangles[v].end());
        for (bool first = true; !left.empty(); first = false) {
            std::vector<int> fan{left.front()};
            left.erase(left.begin());
            for (std::size_t i = 0; i < fan.size(); ++i)
                for (int k = 0; k < 3; ++k) {
                    const int w = mesh.triangles(fan[i], k);
                    if (w == v || edges.count(std::minmax(v, w)) != 0) continue;
                    for (std::size_t j = left.size(); j-- > 0;)
                        if ((mesh.triangles.row(left[j]).array() == w).any()) {
                            fan.push_back(left[j]);
                            left.erase(left.begin() + static_cast<std::ptrdiff_t>(j));
                        }
                }
            if (first) continue;
            for (const int t : fan)
                for (int k = 0; k < 3; ++k)
                    if (mesh.triangles(t, k) == v) cut.mesh.triangles(t, k) = static_cast<int>(cut.vertex.size());
            cut.vertex.push_back(v);
        }
    }
    cut.mesh.positions = mesh.positions(cut.vertex, Eigen::all);
    if (mesh.colors.rows() > 0) cut.mesh.colors = mesh.colors(cut.vertex, Eigen::all);
    return cut;
}

// Three vertices for each triangle.
inline CutMesh flat_shaded(const Mesh& mesh) {
    CutMesh cut{mesh, {}};
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            cut.vertex.push_back(mesh.triangles(t, k));
            cut.mesh.triangles(t, k) = static_cast<int>(3 * t + k);
        }
    cut.mesh.positions = mesh.positions(cut.vertex, Eigen::all);
    if (mesh.colors.rows() > 0) cut.mesh.colors = mesh.colors(cut.vertex, Eigen::all);
    return cut;
}

// The edges between patches of the surface that grow from random triangles, as between the charts of a texture, and
// some walks along edges that end anywhere.
inline std::set<std::pair<int, int>> random_seams(const Mesh& mesh, int patches, int walks, unsigned seed) {
    const Topology top = topology(mesh.positions.rows(), mesh.triangles);
    std::mt19937 random(seed);
    std::vector<int> patch(static_cast<std::size_t>(mesh.triangles.rows()), -1), front;
    for (int p = 0; p < patches; ++p) {
        front.push_back(static_cast<int>(random() % static_cast<unsigned>(mesh.triangles.rows())));
        patch[static_cast<std::size_t>(front.back())] = p;
    }
    std::vector<std::vector<int>> beside(patch.size());
    for (const Edge& edge : top.edges)
        if (edge.count == 2)
            for (std::size_t k = 0; k < 2; ++k)
                beside[static_cast<std::size_t>(edge.triangles[k])].push_back(edge.triangles[1 - k]);
    for (std::size_t i = 0; i < front.size(); ++i)
        for (const int t : beside[static_cast<std::size_t>(front[i])])
            if (patch[static_cast<std::size_t>(t)] < 0) {
                patch[static_cast<std::size_t>(t)] = patch[static_cast<std::size_t>(front[i])];
                front.push_back(t);
            }
    std::set<std::pair<int, int>> edges;
    for (const Edge& edge : top.edges)
        if (edge.count == 2 &&
            patch[static_cast<std::size_t>(edge.triangles[0])] != patch[static_cast<std::size_t>(edge.triangles[1])])
            edges.insert({edge.vertices[0], edge.vertices[1]});
    for (int w = 0; w < walks; ++w) {
        int v = static_cast<int>(random() % static_cast<unsigned>(mesh.positions.rows()));
        for (int step = 0; step < 12 && !top.neighbours[v].empty(); ++step) {
            const auto around = top.neighbours[v];
            const int next = around[random() % around.size()];
            edges.insert(std::minmax(v, next));
            v = next;
        }
    }
    return edges;
}

} // namespace meshtween
