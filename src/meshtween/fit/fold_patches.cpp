#include "meshtween/fit/fold_patches.h"

#include <algorithm>
#include <utility>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// Connected parts of what no patch has.
struct Rest {
    std::vector<std::vector<int>> parts;
    std::vector<int> of; // a vertex: its part or -1
};

Rest rest_of(const Lists& neighbours, const FoldedPatches& patches) {
    Rest rest{{}, std::vector<int>(patches.of.size(), -1)};
    for (std::size_t seed = 0; seed < patches.of.size(); ++seed) {
        if (patches.of[seed] >= 0 || rest.of[seed] >= 0) continue;
        const auto number = static_cast<int>(rest.parts.size());
        std::vector<int> part{static_cast<int>(seed)};
        rest.of[seed] = number;
        for (std::size_t k = 0; k < part.size(); ++k)
            for (const int j : neighbours[part[k]])
                if (patches.of[idx(j)] < 0 && rest.of[idx(j)] < 0) rest.of[idx(j)] = number, part.push_back(j);
        rest.parts.push_back(std::move(part));
    }
    return rest;
}

// The parts beside a patch, each once.
std::vector<int> beside(const Lists& neighbours, const FoldedPatch& patch, const Rest& rest) {
    std::vector<int> parts;
    for (const int i : patch.vertices)
        for (const int j : neighbours[i])
            if (rest.of[idx(j)] >= 0) parts.push_back(rest.of[idx(j)]);
    std::sort(parts.begin(), parts.end());
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    return parts;
}

void take(FoldedPatch& patch, const std::vector<int>& more) {
    std::vector<std::pair<int, double>> all;
    for (std::size_t k = 0; k < patch.vertices.size(); ++k) all.emplace_back(patch.vertices[k], patch.remote[k]);
    for (const int i : more) all.emplace_back(i, 0.0);
    std::sort(all.begin(), all.end());
    patch.vertices.clear(), patch.remote.clear();
    for (const auto& [vertex, remote] : all) patch.vertices.push_back(vertex), patch.remote.push_back(remote);
}

} // namespace

int FoldedPatches::of_triangle(const Triangles& triangles, int t) const {
    int patch = -1;
    for (int k = 0; k < 3; ++k) patch = std::max(patch, of[idx(triangles(t, k))]);
    return patch;
}

FoldedPatches patches_around(const TangleSearch& search, const Tangles& faults, int rings) {
    const Shell& shell = search.shell;
    std::vector<int> ring(shell.area.size(), -1), queue;
    const auto start = [&](int t) {
        for (int k = 0; k < 3; ++k) {
            const int i = shell.triangles(t, k);
            if (ring[idx(i)] < 0) ring[idx(i)] = 0, queue.push_back(i);
        }
    };
    for (const int t : faults.flips) start(t);
    for (const auto& pair : faults.cuts) start(pair[0]), start(pair[1]);
    for (std::size_t k = 0; k < queue.size() && ring[idx(queue[k])] < rings; ++k)
        for (const int j : shell.topology.neighbours[queue[k]])
            if (ring[idx(j)] < 0) ring[idx(j)] = ring[idx(queue[k])] + 1, queue.push_back(j);
    for (const int i : queue)
        if (shell.topology.on_boundary[idx(i)] || is_beyond(search, i)) ring[idx(i)] = -1;
    FoldedPatches patches{{}, std::vector<int>(shell.area.size(), -1)};
    for (const int seed : queue) {
        if (ring[idx(seed)] < 0 || patches.of[idx(seed)] >= 0) continue;
        const auto number = static_cast<int>(patches.list.size());
        FoldedPatch patch;
        patch.vertices.push_back(seed);
        patches.of[idx(seed)] = number;
        for (std::size_t k = 0; k < patch.vertices.size(); ++k)
            for (const int j : shell.topology.neighbours[patch.vertices[k]])
                if (ring[idx(j)] >= 0 && patches.of[idx(j)] < 0) {
                    patches.of[idx(j)] = number;
                    patch.vertices.push_back(j);
                }
        std::sort(patch.vertices.begin(), patch.vertices.end());
        for (const int i : patch.vertices) patch.remote.push_back(static_cast<double>(ring[idx(i)]) / rings);
        patches.list.push_back(std::move(patch));
    }
    return patches;
}

void keep_patches(FoldedPatches& patches, const std::vector<char>& kept) {
    std::vector<int> number(kept.size(), -1);
    std::vector<FoldedPatch> list;
    for (std::size_t k = 0; k < kept.size(); ++k) {
        if (kept[k] == 0) continue;
        number[k] = static_cast<int>(list.size());
        list.push_back(std::move(patches.list[k]));
    }
    patches.list = std::move(list);
    for (int& patch : patches.of)
        if (patch >= 0) patch = number[static_cast<std::size_t>(patch)];
}

void fill_holes(const TangleSearch& search, FoldedPatches& patches) {
    const Lists& neighbours = search.shell.topology.neighbours;
    const Rest rest = rest_of(neighbours, patches);
    const auto size = [&](int part) { return rest.parts[idx(part)].size(); };
    const auto ends = [&](int i) { return search.shell.topology.on_boundary[idx(i)] || is_beyond(search, i); };
    std::vector<int> patches_beside(rest.parts.size(), 0);
    std::vector<std::vector<int>> parts;
    for (const FoldedPatch& patch : patches.list) {
        parts.push_back(beside(neighbours, patch, rest));
        for (const int part : parts.back()) ++patches_beside[idx(part)];
    }
    for (std::size_t k = 0; k < parts.size(); ++k) {
        if (parts[k].empty()) continue;
        const int outside = *std::ranges::max_element(parts[k], {}, size);
        std::vector<int> inside;
        for (const int part : parts[k]) {
            const std::vector<int>& vertices = rest.parts[idx(part)];
            if (part == outside || patches_beside[idx(part)] > 1 || std::ranges::any_of(vertices, ends)) continue;
            inside.insert(inside.end(), vertices.begin(), vertices.end());
        }
        for (const int i : inside) patches.of[idx(i)] = static_cast<int>(k);
        take(patches.list[k], inside);
    }
}

std::vector<long> faults_of(const FoldedPatches& patches, const Triangles& triangles, const Tangles& faults) {
    std::vector<long> count(patches.list.size(), 0);
    const auto add = [&](int patch) {
        if (patch >= 0) ++count[idx(patch)];
    };
    for (const int t : faults.flips) add(patches.of_triangle(triangles, t));
    for (const auto& pair : faults.cuts)
        add(std::max(patches.of_triangle(triangles, pair[0]), patches.of_triangle(triangles, pair[1])));
    return count;
}

} // namespace meshtween
