// A binary tree of boxes over items: the ground of the searches, which never leaves this folder.
#pragma once

#include "meshtween/core/mesh.h"

#include <limits>
#include <vector>

namespace meshtween::search {

using Float4 = float __attribute__((vector_size(16))); // x, y, z, and one that tells nothing

struct FloatBox {
    static constexpr float nowhere = std::numeric_limits<float>::infinity();
    Float4 low{nowhere, nowhere, nowhere, nowhere}, high{-nowhere, -nowhere, -nowhere, -nowhere};

    void extend(const FloatBox& other) {
        low = other.low < low ? other.low : low;
        high = other.high > high ? other.high : high;
    }
    float half_area() const {
        const Float4 size = high - low;
        return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
    }
};

inline bool overlap(const FloatBox& a, const FloatBox& b) {
    const auto both = (a.low <= b.high) & (b.low <= a.high);
    return (both[0] & both[1] & both[2]) != 0;
}

// Into coordinates that floats hold well: the mesh's middle at the origin and its size about 1, by a power of two,
// which changes no digit.
struct Frame {
    Point origin{0, 0, 0};
    double scale = 1;

    Point into(const Point& p) const { return (p - origin) * scale; }
};
Frame frame(const Points& positions, const Triangles& triangles);

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
