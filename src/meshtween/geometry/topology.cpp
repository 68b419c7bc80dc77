#include "meshtween/geometry/topology.h"

#include <algorithm>
#include <cstdint>
#include <map>

namespace meshtween {
namespace {

// Counting sort of (owner, item) pairs into lists; items stay in the order in which they come.
template <typename ForEachPair>
Lists gather(std::ptrdiff_t owners, const ForEachPair& for_each_pair) {
    Lists lists;
    lists.first.assign(static_cast<std::size_t>(owners) + 1, 0);
    for_each_pair([&](int owner, int) { ++lists.first[static_cast<std::size_t>(owner) + 1]; });
    for (std::size_t i = 1; i < lists.first.size(); ++i) lists.first[i] += lists.first[i - 1];
    lists.items.resize(static_cast<std::size_t>(lists.first.back()));
    std::vector<int> next(lists.first.begin(), lists.first.end() - 1);
    for_each_pair([&](int owner, int item) {
        lists.items[static_cast<std::size_t>(next[static_cast<std::size_t>(owner)]++)] = item;
    });
    return lists;
}

} // namespace

Topology topology(Eigen::Index vertex_count, const Triangles& triangles) {
    Topology result;
    struct Half {
        std::uint64_t vertices; // the smaller index above the other: sorted by one comparison
        int triangle;
    };
    std::vector<Half> halves;
    halves.reserve(static_cast<std::size_t>(triangles.rows()) * 3);
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const int a = triangles(t, k), b = triangles(t, (k + 1) % 3);
            if (a != b)
                halves.push_back(
                    {static_cast<std::uint64_t>(std::min(a, b)) << 32 | static_cast<std::uint64_t>(std::max(a, b)),
                     static_cast<int>(t)});
        }
    std::sort(halves.begin(), halves.end(), [](const Half& x, const Half& y) {
        return x.vertices != y.vertices ? x.vertices < y.vertices : x.triangle < y.triangle;
    });
    result.edges.reserve(halves.size() / 2 + 16);
    for (std::size_t h = 0; h < halves.size(); ++h) {
        const Half& half = halves[h];
        if (h == 0 || half.vertices != halves[h - 1].vertices)
            result.edges.push_back(
                {{static_cast<int>(half.vertices >> 32), static_cast<int>(half.vertices & 0xffffffff)}, {-1, -1}, 0});
        Edge& edge = result.edges.back();
        if (edge.count < 2) edge.triangles[static_cast<std::size_t>(edge.count)] = half.triangle;
        ++edge.count;
    }
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

} // namespace meshtween
