// I. Wald, On fast Construction of SAH-based Bounding Volume Hierarchies, IEEE Symposium on Interactive Ray Tracing,
// 2007: the surface area heuristic over a few bins of box centres.
#include "meshtween/search/box_tree.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>

namespace meshtween::search {
namespace {

constexpr int bin_count = 16;
constexpr int deepest_by_area = BoxTree::deepest - 32; // below, halves: 2^31 items are no deeper than 31 of them

struct Work {
    int node, begin, end, depth;
};

struct Builder {
    const std::vector<FloatBox>& boxes;
    std::vector<int>& order;
    int leaf_size;

    int& item(int i) const { return order[static_cast<std::size_t>(i)]; }
    const FloatBox& box(int i) const { return boxes[static_cast<std::size_t>(item(i))]; }
    static Float4 centre(const FloatBox& box) { return 0.5F * (box.low + box.high); }

    // The node for begin..end, and where its items, put in order, are divided; that is `end` for a leaf.
    struct Made {
        FloatBox box;
        int middle = 0;
    };
    Made make(const Work& work) const;
    int divide(const Work& work, const FloatBox& centres) const;
};

// Keeps the node and adds its two children's work, unless it is a leaf.
void keep(const Work& work, const Builder::Made& made, std::vector<BoxTree::Node>& nodes, std::vector<Work>& todo) {
    BoxTree::Node& node = nodes[static_cast<std::size_t>(work.node)];
    node.box = made.box;
    if (made.middle == work.end) {
        node.first = work.begin;
        node.count = work.end - work.begin;
        return;
    }
    const int left = static_cast<int>(nodes.size());
    node.first = left;
    nodes.resize(nodes.size() + 2);
    todo.push_back({left + 1, made.middle, work.end, work.depth + 1});
    todo.push_back({left, work.begin, made.middle, work.depth + 1});
}

struct Bin {
    FloatBox box;
    int count = 0;
};

struct Split {
    float cost = std::numeric_limits<float>::infinity();
    std::size_t axis = 0;
    std::size_t bin = 0; // the first on the right
};

// Where along this axis the two sides' areas times counts are least.
void best_split(const std::array<Bin, bin_count>& bins, std::size_t axis, Split& best) {
    std::array<float, bin_count> right_cost{};
    Bin right;
    for (int b = bin_count - 1; b > 0; --b) {
        right.box.extend(bins[static_cast<std::size_t>(b)].box);
        right.count += bins[static_cast<std::size_t>(b)].count;
        right_cost[static_cast<std::size_t>(b)] =
            right.count > 0 ? right.box.half_area() * static_cast<float>(right.count) : -1;
    }
    Bin left;
    for (int b = 1; b < bin_count; ++b) {
        left.box.extend(bins[static_cast<std::size_t>(b - 1)].box);
        left.count += bins[static_cast<std::size_t>(b - 1)].count;
        if (left.count == 0 || right_cost[static_cast<std::size_t>(b)] < 0) continue;
        const float cost =
            left.box.half_area() * static_cast<float>(left.count) + right_cost[static_cast<std::size_t>(b)];
        if (cost < best.cost) best = {cost, axis, static_cast<std::size_t>(b)};
    }
}

int Builder::divide(const Work& work, const FloatBox& centres) const {
    const int half = work.begin + (work.end - work.begin) / 2;
    Float4 to_bin{};
    for (int k = 0; k < 3; ++k) {
        const float size = centres.high[k] - centres.low[k];
        to_bin[k] = size > 0 ? bin_count * (1 - 1e-6F) / size : 0;
    }
    const auto bins_of = [&](const FloatBox& b) { return (centre(b) - centres.low) * to_bin; };
    const auto bin = [](Float4 place, std::size_t k) {
        return static_cast<std::size_t>(std::clamp(static_cast<int>(place[k]), 0, bin_count - 1));
    };
    Split best;
    if (work.depth < deepest_by_area) {
        std::array<std::array<Bin, bin_count>, 3> bins;
        for (int i = work.begin; i < work.end; ++i) {
            const FloatBox& own = box(i);
            const Float4 places = bins_of(own);
            for (std::size_t k = 0; k < 3; ++k) {
                Bin& there = bins[k][bin(places, k)];
                there.box.extend(own);
                ++there.count;
            }
        }
        for (std::size_t k = 0; k < 3; ++k) best_split(bins[k], k, best);
    }
    if (!std::isfinite(best.cost)) return half; // all centres in one place, or deep enough
    const auto right = std::partition(order.begin() + work.begin, order.begin() + work.end, [&](int t) {
        return bin(bins_of(boxes[static_cast<std::size_t>(t)]), best.axis) < best.bin;
    });
    return static_cast<int>(right - order.begin());
}

Builder::Made Builder::make(const Work& work) const {
    FloatBox all, centres;
    for (int i = work.begin; i < work.end; ++i) {
        const FloatBox& b = box(i);
        all.extend(b);
        centres.extend({centre(b), centre(b)});
    }
    return {all, work.end - work.begin <= leaf_size ? work.end : divide(work, centres)};
}

// The next float above: std::nextafter is a call each time.
float next_above(float x) {
    if (!(std::abs(x) <= std::numeric_limits<float>::max())) return x;
    const auto bits = std::bit_cast<std::int32_t>(x + 0.0F); // without a minus before nought
    return std::bit_cast<float>(bits >= 0 ? bits + 1 : bits - 1);
}

} // namespace

Frame frame(const Points& positions, const Triangles& triangles) {
    Frame result;
    const Eigen::AlignedBox3d box = bounding_box(positions, triangles);
    const Point low = box.min().transpose(), high = box.max().transpose();
    result.origin = low / 2 + high / 2;
    int exponent = 0;
    std::frexp((high / 2 - low / 2).maxCoeff(), &exponent); // 0 for a single point
    result.scale = std::ldexp(1.0, std::clamp(-exponent, -1000, 1000));
    return result;
}

std::vector<FloatBox> triangle_boxes(const Points& positions, const Triangles& triangles, const Frame& frame) {
    std::vector<FloatBox> boxes(static_cast<std::size_t>(triangles.rows()));
    parallel_for(triangles.rows(), [&](Eigen::Index t) {
        const Point a = frame.into(positions.row(triangles(t, 0))), b = frame.into(positions.row(triangles(t, 1))),
                    c = frame.into(positions.row(triangles(t, 2)));
        const Point low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
        FloatBox& box = boxes[static_cast<std::size_t>(t)];
        for (int k = 0; k < 3; ++k) {
            box.low[k] = -next_above(static_cast<float>(-low[k]));
            box.high[k] = next_above(static_cast<float>(high[k]));
        }
    });
    return boxes;
}

BoxTree box_tree(const std::vector<FloatBox>& boxes, int leaf_size) {
    BoxTree tree;
    const int count = static_cast<int>(boxes.size());
    if (count == 0) return tree;
    tree.order.resize(boxes.size());
    std::iota(tree.order.begin(), tree.order.end(), 0);
    const Builder builder{boxes, tree.order, leaf_size};
    // The top of the tree first, level by level, then the subtrees beside each other; where to cut depends on the items
    // alone.
    const int small = std::max(1024, count / 64);
    std::vector<Work> level{{0, 0, count, 0}}, subtrees;
    tree.nodes.resize(1);
    while (!level.empty()) {
        const auto is_small = [&](const Work& work) { return work.end - work.begin <= small; };
        std::copy_if(level.begin(), level.end(), std::back_inserter(subtrees), is_small);
        std::erase_if(level, is_small);
        std::vector<Builder::Made> made(level.size());
        parallel_for(
            std::ssize(level),
            [&](std::ptrdiff_t w) {
                made[static_cast<std::size_t>(w)] = builder.make(level[static_cast<std::size_t>(w)]);
            },
            1);
        std::vector<Work> next;
        for (std::size_t w = 0; w < level.size(); ++w) keep(level[w], made[w], tree.nodes, next);
        level = std::move(next);
    }
    std::vector<std::vector<BoxTree::Node>> grown(subtrees.size());
    parallel_for(
        static_cast<std::ptrdiff_t>(subtrees.size()),
        [&](std::ptrdiff_t s) {
            const auto i = static_cast<std::size_t>(s);
            grown[i].resize(1);
            std::vector<Work> rest{{0, subtrees[i].begin, subtrees[i].end, subtrees[i].depth}};
            while (!rest.empty()) {
                const Work work = rest.back();
                rest.pop_back();
                keep(work, builder.make(work), grown[i], rest);
            }
        },
        1);
    for (std::size_t s = 0; s < subtrees.size(); ++s) {
        const int shift = static_cast<int>(tree.nodes.size()) - 1; // a subtree's root takes the place kept for it
        for (BoxTree::Node& node : grown[s])
            if (node.count == 0) node.first += shift;
        tree.nodes[static_cast<std::size_t>(subtrees[s].node)] = grown[s].front();
        tree.nodes.insert(tree.nodes.end(), grown[s].begin() + 1, grown[s].end());
    }
    return tree;
}

} // namespace meshtween::search
