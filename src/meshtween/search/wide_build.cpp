// I. Wald, C. Benthin, S. Boulos, Getting Rid of Packets: Efficient SIMD Single-Ray Traversal using Multi-branching
// BVHs, IEEE Symposium on Interactive Ray Tracing, 2008: a wide node takes the place of a few levels of a binary tree,
// opening the child of largest area until there are eight.
#include "meshtween/search/wide_build.h"

#include "meshtween/core/parallel.h"
#include "meshtween/search/box_tree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace meshtween::search {
namespace {

struct Collapse {
    const BoxTree& binary;
    std::vector<WideNode>& nodes;
    std::vector<int>& leaves; // the binary leaf of each block

    const BoxTree::Node& at(int n) const { return binary.nodes[static_cast<std::size_t>(n)]; }

    std::vector<int> children(int top) const {
        std::vector<int> result{top};
        while (static_cast<int>(result.size()) < wide) {
            std::size_t largest = result.size();
            for (std::size_t i = 0; i < result.size(); ++i)
                if (at(result[i]).count == 0 &&
                    (largest == result.size() || at(result[i]).box.half_area() > at(result[largest]).box.half_area()))
                    largest = i;
            if (largest == result.size()) break;
            const int left = at(result[largest]).first;
            result[largest] = left;
            result.push_back(left + 1);
        }
        return result;
    }

    // Iterative: each work item is a binary node and the wide node kept for it.
    void run() {
        struct Work {
            int binary, wide_node;
        };
        std::vector<Work> todo{{0, 0}};
        nodes.resize(1);
        while (!todo.empty()) {
            const Work work = todo.back();
            todo.pop_back();
            const std::vector<int> kids = children(work.binary);
            WideNode node{};
            for (int i = 0; i < wide; ++i) {
                const bool empty = i >= static_cast<int>(kids.size());
                const FloatBox box = empty ? FloatBox{} : at(kids[static_cast<std::size_t>(i)]).box;
                for (std::size_t k = 0; k < 3; ++k) {
                    node.low[k][i] = box.low[k];
                    node.high[k][i] = box.high[k];
                }
                node.child[i] = 0;
                if (empty) continue;
                const int kid = kids[static_cast<std::size_t>(i)];
                if (at(kid).count > 0) {
                    node.child[i] = ~static_cast<int>(leaves.size());
                    leaves.push_back(kid);
                } else {
                    node.child[i] = static_cast<int>(nodes.size());
                    todo.push_back({kid, node.child[i]});
                    nodes.emplace_back();
                }
            }
            nodes[static_cast<std::size_t>(work.wide_node)] = node;
        }
    }
};

constexpr double float_unit = 6e-8; // relative error of an operation

// How far off the floats' distance of this triangle may be, as TriangleBlock::slack says. Near the edges it is a few
// roundings. Inside, an error in the barycentric coordinates, which grows with the square of 1 / sin of the corner from
// which they are counted, moves the foot; but an edge is never further from it than the inscribed circle's radius.
double slack(double longest, double middle, double shortest, double double_area) {
    if (double_area == 0) return 32 * float_unit;
    const double per_sine = middle * shortest / double_area; // at the corner between these two
    return 32 * float_unit +
           std::min(32 * float_unit * per_sine * per_sine, double_area / (longest + middle + shortest) / 4);
}

// Puts a triangle, in the block's coordinates, into a lane, counted from the corner opposite its longest edge.
double put(const std::array<Point, 3>& corners, int lane, TriangleBlock& block) {
    std::array<double, 3> opposite{};
    for (std::size_t k = 0; k < 3; ++k) opposite[k] = (corners[(k + 1) % 3] - corners[(k + 2) % 3]).norm();
    const auto top = static_cast<std::size_t>(std::max_element(opposite.begin(), opposite.end()) - opposite.begin());
    const Point& a = corners[top];
    const Point ab = corners[(top + 1) % 3] - a, ac = corners[(top + 2) % 3] - a;
    for (int k = 0; k < 3; ++k) {
        block.a[k][lane] = static_cast<float>(a[k]);
        block.ab[k][lane] = static_cast<float>(ab[k]);
        block.ac[k][lane] = static_cast<float>(ac[k]);
    }
    std::sort(opposite.begin(), opposite.end());
    return slack(opposite[2], opposite[1], opposite[0], ab.cross(ac).norm());
}

TriangleBlock block_of(const Points& positions, const Triangles& triangles, std::span<const int> items,
                       double smallest) {
    TriangleBlock block{};
    Point low = positions.row(triangles(items[0], 0)), high = low;
    for (const int t : items)
        for (int k = 0; k < 3; ++k) {
            low = low.cwiseMin(positions.row(triangles(t, k)));
            high = high.cwiseMax(positions.row(triangles(t, k)));
        }
    const Point centre = low / 2 + high / 2;
    int exponent = 0;
    std::frexp(std::max((high / 2 - low / 2).maxCoeff(), smallest), &exponent);
    block.scale = std::ldexp(1.0, -exponent);
    block.unit = std::ldexp(1.0, exponent);
    for (int k = 0; k < 3; ++k) block.centre[k] = centre[k];
    double most = 0;
    for (int lane = 0; lane < wide; ++lane) {
        const int t = items[std::min(static_cast<std::size_t>(lane), items.size() - 1)];
        std::array<Point, 3> corners;
        for (int k = 0; k < 3; ++k)
            corners[static_cast<std::size_t>(k)] = (positions.row(triangles(t, k)) - centre) * block.scale;
        most = std::max(most, put(corners, lane, block));
        block.triangle[lane] = t;
    }
    block.slack = static_cast<float>(most * (1 + 1e-6));
    return block;
}

// One neighbourhood that no query is inside of, for all triangles: every search comes down from the root.
void no_neighbourhoods(WideTree& tree) {
    Neighbourhood nowhere{};
    for (int k = 0; k < 3; ++k) nowhere.inside_low[k] = FloatBox::nowhere, nowhere.inside_high[k] = -FloatBox::nowhere;
    tree.neighbourhoods.assign(1, nowhere);
    std::fill(tree.home.begin(), tree.home.end(), 0);
}

void put(const FloatBox& box, int child, WideNode& node) {
    for (std::size_t k = 0; k < 3; ++k) node.low[k][child] = box.low[k], node.high[k][child] = box.high[k];
}

bool empty(const WideNode& node, int child) {
    return node.low[0][child] > node.high[0][child];
}

FloatBox box_of(const WideNode& node) {
    FloatBox all;
    for (int i = 0; i < wide; ++i)
        if (!empty(node, i))
            all.extend({Float4{node.low[0][i], node.low[1][i], node.low[2][i]},
                        Float4{node.high[0][i], node.high[1][i], node.high[2][i]}});
    return all;
}

} // namespace

void refit(WideTree& tree, const Points& positions, const Triangles& triangles) {
    const std::vector<FloatBox> boxes = triangle_boxes(positions, triangles, {tree.origin, tree.scale});
    std::vector<FloatBox> of_block(tree.blocks.size());
    parallel_for(
        std::ssize(tree.blocks),
        [&](std::ptrdiff_t b) {
            TriangleBlock& block = tree.blocks[static_cast<std::size_t>(b)];
            std::array<int, wide> items{};
            std::copy_n(block.triangle, wide, items.begin());
            block = block_of(positions, triangles, items, 1e-7 / tree.scale);
            for (const int t : items) of_block[static_cast<std::size_t>(b)].extend(boxes[static_cast<std::size_t>(t)]);
        },
        128);
    for (std::size_t n = tree.nodes.size(); n-- > 0;) { // children come after their parents
        WideNode& node = tree.nodes[n];
        for (int i = 0; i < wide; ++i) {
            if (empty(node, i)) continue;
            const int child = node.child[i];
            put(child < 0 ? of_block[static_cast<std::size_t>(~child)]
                          : box_of(tree.nodes[static_cast<std::size_t>(child)]),
                i, node);
        }
    }
    no_neighbourhoods(tree);
}

WideTree wide_tree(const Points& positions, const Triangles& triangles, MeshIs mesh) {
    WideTree tree;
    const Frame to = frame(positions, triangles);
    tree.origin = to.origin;
    tree.scale = to.scale;
    const BoxTree binary = box_tree(triangle_boxes(positions, triangles, to), wide);
    std::vector<int> leaves;
    Collapse{binary, tree.nodes, leaves}.run();
    tree.blocks.resize(leaves.size());
    parallel_for(static_cast<std::ptrdiff_t>(leaves.size()), [&](std::ptrdiff_t b) {
        const BoxTree::Node& leaf = binary.nodes[static_cast<std::size_t>(leaves[static_cast<std::size_t>(b)])];
        const std::span items(binary.order.data() + leaf.first, static_cast<std::size_t>(leaf.count));
        tree.blocks[static_cast<std::size_t>(b)] = block_of(positions, triangles, items, 1e-7 / to.scale);
    });
    tree.home.resize(static_cast<std::size_t>(triangles.rows()));
    if (mesh == MeshIs::still)
        add_neighbourhoods(tree);
    else
        no_neighbourhoods(tree);
    return tree;
}

std::vector<NamedSearch> searches() {
    std::vector<NamedSearch> result{{"plain", search_plain}};
#if defined(MESHTWEEN_X86)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) result.push_back({"avx2", search_avx2});
#endif
    return result;
}

namespace {
WideSearch& in_use() {
    static WideSearch search = searches().back().search;
    return search;
}
} // namespace

WideSearch current_search() {
    return in_use();
}

void use_search(WideSearch search) {
    in_use() = search != nullptr ? search : searches().back().search;
}

} // namespace meshtween::search
