// Who is next to whom: made once a mesh, read by everything that walks over it.
#pragma once

#include "meshtween/core/mesh.h"

#include <array>
#include <span>
#include <vector>

namespace meshtween {

// Lists of different lengths in one array: list i is items[first[i] .. first[i + 1]).
struct Lists {
    std::vector<int> first{0};
    std::vector<int> items;
    std::span<const int> operator[](std::ptrdiff_t i) const {
        return {items.data() + first[static_cast<std::size_t>(i)],
                items.data() + first[static_cast<std::size_t>(i) + 1]};
    }
    std::ptrdiff_t size() const { return static_cast<std::ptrdiff_t>(first.size()) - 1; }
};

struct Edge {
    std::array<int, 2> vertices{};        // smaller index first
    std::array<int, 2> triangles{-1, -1}; // the first two on it; second -1 on a boundary
    int count = 0;                        // triangles on it: 1 boundary, 2 inside, more non-manifold
};

struct Topology {
    std::vector<Edge> edges;       // sorted by their vertices
    Lists neighbours;              // a list a vertex: the vertices on its edges, ascending
    Lists vertex_triangles;        // a list a vertex: the triangles around it, ascending
    std::vector<char> on_boundary; // a flag a vertex: an edge of it has one triangle
};

// O(n log n) time, O(n) memory. Works on any triangles, manifold or not.
Topology topology(Eigen::Index vertex_count, const Triangles& triangles);

// A component number (from 0, in order of their first vertex) a vertex; vertices of no triangle get one each.
std::vector<int> components(const Topology& topology);

double mean_edge_length(const Points& positions, const Topology& topology); // 0 where there is no edge

// The boundary as closed loops of vertex indices, in the triangles' direction.
std::vector<std::vector<int>> boundary_loops(const Triangles& triangles, const Topology& topology);

} // namespace meshtween
