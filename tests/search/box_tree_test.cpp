#include "meshtween/search/box_tree.h"

#include "meshtween/core/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace meshtween::search {
namespace {

std::vector<FloatBox> random_boxes(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    std::vector<FloatBox> boxes(count);
    for (FloatBox& box : boxes)
        for (std::size_t k = 0; k < 3; ++k) {
            box.low[k] = coordinate(random);
            box.high[k] = box.low[k] + 0.01F * std::abs(coordinate(random));
        }
    return boxes;
}

std::array<float, 6> sides(const FloatBox& box) {
    return {box.low[0], box.low[1], box.low[2], box.high[0], box.high[1], box.high[2]};
}

bool holds(const FloatBox& outer, const FloatBox& inner) {
    FloatBox both = outer;
    both.extend(inner);
    return sides(both) == sides(outer);
}

// Every item in one leaf, every box in its parent's, no leaf too large or too deep.
void expect_sound(const BoxTree& tree, const std::vector<FloatBox>& boxes, int leaf_size) {
    std::vector<int> sorted = tree.order;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], static_cast<int>(i));
    ASSERT_EQ(sorted.size(), boxes.size());
    struct Visit {
        int node, depth;
    };
    std::vector<Visit> todo{{0, 0}};
    std::size_t seen_items = 0, seen_nodes = 0;
    while (!todo.empty()) {
        const Visit visit = todo.back();
        todo.pop_back();
        ++seen_nodes;
        const auto& node = tree.nodes[static_cast<std::size_t>(visit.node)];
        ASSERT_LE(visit.depth, BoxTree::deepest);
        ASSERT_LE(node.count, leaf_size);
        for (int i = node.first; i < node.first + node.count; ++i, ++seen_items)
            ASSERT_TRUE(holds(node.box, boxes[static_cast<std::size_t>(tree.order[static_cast<std::size_t>(i)])]));
        if (node.count > 0) continue;
        for (const int child : {node.first, node.first + 1}) {
            ASSERT_TRUE(holds(node.box, tree.nodes[static_cast<std::size_t>(child)].box));
            todo.push_back({child, visit.depth + 1});
        }
    }
    EXPECT_EQ(seen_items, boxes.size());
    EXPECT_EQ(seen_nodes, tree.nodes.size());
}

TEST(BoxTree, HoldsEveryItemOnce) {
    for (const std::size_t count : {1, 2, 8, 9, 1000, 20000}) {
        const std::vector<FloatBox> boxes = random_boxes(count, 3);
        expect_sound(box_tree(boxes, 8), boxes, 8);
        expect_sound(box_tree(boxes, 1), boxes, 1);
    }
    EXPECT_TRUE(box_tree({}, 8).nodes.empty());
}

TEST(BoxTree, StaysShallowOnAwkwardItems) {
    std::vector<FloatBox> same(5000, random_boxes(1, 7).front());
    expect_sound(box_tree(same, 4), same, 4);
    std::vector<FloatBox> shrinking; // each a hundredth closer to the corner: every bin but one is empty
    for (int i = 0; i < 9000; ++i) {
        const float x = std::pow(0.99F, static_cast<float>(i));
        shrinking.push_back({Float4{x, x, x}, Float4{x, x, x}});
    }
    expect_sound(box_tree(shrinking, 1), shrinking, 1);
}

TEST(BoxTree, IsTheSameForAnyNumberOfThreads) {
    const std::vector<FloatBox> boxes = random_boxes(30000, 11);
    set_threads(1);
    const BoxTree one = box_tree(boxes, 4);
    set_threads(2);
    const BoxTree two = box_tree(boxes, 4);
    set_threads(0);
    EXPECT_EQ(one.order, two.order);
    ASSERT_EQ(one.nodes.size(), two.nodes.size());
    for (std::size_t i = 0; i < one.nodes.size(); ++i) {
        EXPECT_EQ(one.nodes[i].first, two.nodes[i].first);
        EXPECT_EQ(sides(one.nodes[i].box), sides(two.nodes[i].box));
    }
}

TEST(BoxTree, BoxesHoldTheirTrianglesFarFromTheOriginAndInAnyUnit) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> coordinate(-1, 1);
    for (const double unit : {1e-200, 1e-3, 1.0, 1e150})
        for (const double shift : {0.0, 1e5}) {
            const Points positions = Points::NullaryExpr(300, 3, [&] { return (shift + coordinate(random)) * unit; });
            Triangles triangles(100, 3);
            for (int i = 0; i < 300; ++i) triangles(i / 3, i % 3) = i;
            const Frame to = frame(positions, triangles);
            const std::vector<FloatBox> boxes = triangle_boxes(positions, triangles, to);
            for (int i = 0; i < 300; ++i)
                for (int k = 0; k < 3; ++k) {
                    const double x = to.into(positions.row(i))[k];
                    EXPECT_LE(std::abs(x), 1);
                    const FloatBox& box = boxes[static_cast<std::size_t>(i / 3)];
                    EXPECT_LT(box.low[static_cast<std::size_t>(k)], x);
                    EXPECT_GT(box.high[static_cast<std::size_t>(k)], x);
                }
        }
}

} // namespace
} // namespace meshtween::search
