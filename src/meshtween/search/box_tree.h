// A binary tree of boxes over items: the ground of the searches, which never leaves this folder.
#pragma once

#include "meshtween/core/mesh.h"

#include <array>
#include <limits>
#include <vector>

namespace meshtween::search {

struct FloatBox {
    static constexpr float nowhere = std::numeric_limits<float>::infinity();
    std::array<float, 3> low{nowhere, nowhere, nowhere}, high{-nowhere, -nowhere, -nowhere};

    void extend(const FloatBox& other) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = other.low[k] < low[k] ? other.low[k] : low[k];
            high[k] = other.high[k] > high[k] ? other.high[k] : high[k];
        }
    }
    float half_area() const {
        const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
        return x * y + y * z + z * x;
    }
};

inline bool overlap(const FloatBox& a, const FloatBox& b) {
    return a.low[0] <= b.high[0] && b.low[0] <= a.high[0] && a.low[1] <= b.high[1] && b.low[1] <= a.high[1] &&
           a.low[2] <= b.high[2] && b.low[2] <= a.high[2];
}

// Into coordinates that floats hold well: the mesh's middle at the origin and its size about 1, by a power of two,
// which changes no digit.
struct Frame {
    Point origin{0, 0, 0};
    double scale = 1;

    Point into(const Point& p) const { return (p - origin) * scale; }
};
Frame frame(const Points& positions);

// A box a triangle in that frame, rounded outwards: it holds the triangle whatever the rounding.
std::vector<FloatBox> triangle_boxes(const Points& positions, const Triangles& triangles, const Frame& frame);

struct BoxTree {
    static constexpr int deepest = 80; // no leaf is deeper
    struct Node {
        FloatBox box;
        int first = 0; // of its items in `order`, or its left child, whom the right one follows
        int count = 0; // of items; 0 for an inner node
    };
    std::vector<Node> nodes; // the root first; none for no items
    std::vector<int> order;  // of the items, by leaf
};

// By the surface area heuristic; leaves hold at most leaf_size items. The same tree for any number of threads.
// O(n log n).
BoxTree box_tree(const std::vector<FloatBox>& boxes, int leaf_size);

} // namespace meshtween::search
