#include "meshtween/geometry/topology.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/gather.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace meshtween {
Topology topology(Eigen::Index vertex_count, const Triangles& triangles) {
    Topology result;
    // Half-edges (3 t + k) by the smaller of their vertices, then by the larger: those of one edge are together.
    Lists halves = gather(vertex_count, [&](const auto& put) {
        for (Eigen::Index t = 0; t < triangles.rows(); ++t)
            for (int k = 0; k < 3; ++k) {
                const int a = triangles(t, k), b = triangles(t, (k + 1) % 3);
                if (a != b) put(std::min(a, b), static_cast<int>(3 * t + k));
            }
    });
    const auto larger = [&](int half) {
        return std::max(triangles(half / 3, half % 3), triangles(half / 3, (half + 1) % 3));
    };
    std::vector<int> first_edge(static_cast<std::size_t>(vertex_count) + 1, 0);
    parallel_for(vertex_count, [&](Eigen::Index v) {
        const auto begin = halves.items.begin() + halves.first[static_cast<std::size_t>(v)],
                   end = halves.items.begin() + halves.first[static_cast<std::size_t>(v) + 1];
        std::sort(begin, end, [&](int x, int y) { return std::pair(larger(x), x) < std::pair(larger(y), y); });
        for (auto h = begin; h != end; ++h)
            first_edge[static_cast<std::size_t>(v) + 1] += h == begin || larger(*h) != larger(*(h - 1));
    });
    std::partial_sum(first_edge.begin(), first_edge.end(), first_edge.begin());
    result.edges.resize(static_cast<std::size_t>(first_edge.back()));
    parallel_for(vertex_count, [&](Eigen::Index v) {
        int last = -1, number = first_edge[static_cast<std::size_t>(v)] - 1;
        for (const int half : halves[v]) {
            const int other = larger(half);
            number += other != last;
            last = other;
            Edge& edge = result.edges[static_cast<std::size_t>(number)];
            edge.vertices = {static_cast<int>(v), other};
            if (edge.count < 2) edge.triangles[static_cast<std::size_t>(edge.count)] = half / 3;
            ++edge.count;
        }
    });
    result.neighbours = gather(vertex_count, [&](const auto& put) {
        for (const Edge& edge : result.edges) put(edge.vertices[1], edge.vertices[0]);
        for (const Edge& edge : result.edges) put(edge.vertices[0], edge.vertices[1]);
    });
    result.vertex_triangles = gather(vertex_count, [&](const auto& put) {
        for (Eigen::Index t = 0; t < triangles.rows(); ++t)
            for (int k = 0; k < 3; ++k) put(triangles(t, k), static_cast<int>(t));
    });
    result.on_boundary.assign(static_cast<std::size_t>(vertex_count), 0);
    for (const Edge& edge : result.edges)
        if (edge.count == 1)
            for (const int v : edge.vertices) result.on_boundary[static_cast<std::size_t>(v)] = 1;
    return result;
}

std::vector<int> components(const Topology& topology) {
    std::vector<int> component(static_cast<std::size_t>(topology.neighbours.size()), -1);
    std::vector<int> stack;
    int count = 0;
    for (std::size_t start = 0; start < component.size(); ++start) {
        if (component[start] >= 0) continue;
        stack.push_back(static_cast<int>(start));
        component[start] = count;
        while (!stack.empty()) {
            const int v = stack.back();
            stack.pop_back();
            for (const int w : topology.neighbours[v])
                if (component[static_cast<std::size_t>(w)] < 0) {
                    component[static_cast<std::size_t>(w)] = count;
                    stack.push_back(w);
                }
        }
        ++count;
    }
    return component;
}

std::vector<std::vector<int>> boundary_loops(const Triangles& triangles, const Topology& topology) {
    std::multimap<int, int> next; // a boundary vertex to the one after it
    for (const Edge& edge : topology.edges) {
        if (edge.count != 1) continue;
        for (int k = 0; k < 3; ++k) {
            const int a = triangles(edge.triangles[0], k), b = triangles(edge.triangles[0], (k + 1) % 3);
            if (std::minmax(a, b) == std::minmax(edge.vertices[0], edge.vertices[1])) next.emplace(a, b);
        }
    }
    std::vector<std::vector<int>> loops;
    while (!next.empty()) {
        std::vector<int> loop;
        for (auto it = next.begin(); it != next.end(); it = next.find(loop.back())) {
            if (loop.empty()) loop.push_back(it->first);
            const int to = it->second;
            next.erase(it);
            if (to == loop.front()) break;
            loop.push_back(to);
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

double mean_edge_length(const Points& positions, const Topology& topology) {
    double sum = 0;
    for (const Edge& e : topology.edges) sum += (positions.row(e.vertices[0]) - positions.row(e.vertices[1])).norm();
    return topology.edges.empty() ? 0 : sum / static_cast<double>(topology.edges.size());
}

} // namespace meshtween
