// For each node with leaves, all leaves about these, as many as fit.
#include "meshtween/search/wide_build.h"

#include "meshtween/core/parallel.h"
#include "meshtween/search/box_tree.h"

#include <algorithm>

namespace meshtween::search {
namespace {

FloatBox box_of(const WideNode& node, int i) {
    return {Float4{node.low[0][i], node.low[1][i], node.low[2][i]},
            Float4{node.high[0][i], node.high[1][i], node.high[2][i]}};
}

// How far apart along the axis where they are furthest.
float gap(const FloatBox& a, const FloatBox& b) {
    float most = 0;
    for (std::size_t k = 0; k < 3; ++k) most = std::max({most, a.low[k] - b.high[k], b.low[k] - a.high[k]});
    return most;
}

struct Leaf {
    float gap = 0;
    int child = 0;
    FloatBox box;
};

void collect(const std::vector<WideNode>& nodes, int n, const FloatBox& middle, float reach,
             std::vector<Leaf>& leaves) {
    const WideNode& node = nodes[static_cast<std::size_t>(n)];
    for (int i = 0; i < wide; ++i) {
        const FloatBox box = box_of(node, i);
        if (box.low[0] > box.high[0]) continue; // an empty child
        const float apart = gap(box, middle);
        if (apart > reach) continue;
        if (node.child[i] < 0)
            leaves.push_back({apart, node.child[i], box});
        else
            collect(nodes, node.child[i], middle, reach, leaves);
    }
}

Neighbourhood neighbourhood(const std::vector<WideNode>& nodes, const FloatBox& middle) {
    float reach = 0;
    for (std::size_t k = 0; k < 3; ++k) reach = std::max(reach, middle.high[k] - middle.low[k]);
    std::vector<Leaf> leaves;
    collect(nodes, 0, middle, reach, leaves);
    std::sort(leaves.begin(), leaves.end(),
              [](const Leaf& a, const Leaf& b) { return a.gap != b.gap ? a.gap < b.gap : a.child > b.child; });
    if (leaves.size() > most_neighbours) {
        reach = leaves[most_neighbours].gap;
        leaves.resize(most_neighbours);
    }
    Neighbourhood hood{};
    leaves.resize(most_neighbours, {0, 0, {}}); // the empty box is near nothing
    for (int i = 0; i < most_neighbours; ++i) {
        const Leaf& leaf = leaves[static_cast<std::size_t>(i)];
        hood.child[i] = leaf.child;
        for (std::size_t k = 0; k < 3; ++k) {
            hood.low[k][i] = leaf.box.low[k];
            hood.high[k][i] = leaf.box.high[k];
        }
    }
    // Less than the reach, by more than a rounding; nowhere, where more leaves than fit overlap the middle.
    const float inside = reach > 0 ? 0.999F * reach : -FloatBox::nowhere;
    for (std::size_t k = 0; k < 3; ++k) {
        hood.inside_low[k] = middle.low[k] - inside;
        hood.inside_high[k] = middle.high[k] + inside;
    }
    return hood;
}

} // namespace

void add_neighbourhoods(WideTree& tree) {
    std::vector<FloatBox> middles; // of the leaves of each node that has any
    for (const WideNode& node : tree.nodes) {
        FloatBox middle;
        for (int i = 0; i < wide; ++i) {
            const FloatBox box = box_of(node, i);
            if (box.low[0] > box.high[0] || node.child[i] >= 0) continue;
            middle.extend(box);
            const int block = ~node.child[i];
            for (const int t : tree.blocks[static_cast<std::size_t>(block)].triangle)
                tree.home[static_cast<std::size_t>(t)] = static_cast<int>(middles.size());
        }
        if (middle.low[0] <= middle.high[0]) middles.push_back(middle);
    }
    tree.neighbourhoods.resize(middles.size());
    parallel_for(
        static_cast<std::ptrdiff_t>(middles.size()),
        [&](std::ptrdiff_t i) {
            const auto n = static_cast<std::size_t>(i);
            tree.neighbourhoods[n] = neighbourhood(tree.nodes, middles[n]);
        },
        64);
}

} // namespace meshtween::search
