// The last word on a triangle's distance, in doubles.
#include "meshtween/search/nearest.h"
#include "meshtween/search/wide_tree.h"

#include <algorithm>

namespace meshtween::search {

bool agrees(const WideView& tree, const WideQuery& query, int triangle) {
    if (!query.compatible) return true;
    const double* n = tree.normals[triangle];
    return n[0] * query.normal[0] + n[1] * query.normal[1] + n[2] * query.normal[2] >= query.least_cosine;
}

void settle(const WideView& tree, WideQuery& query, int triangle) {
    const int* corners = tree.triangles[triangle];
    const auto position = [&](int k) {
        const double* p = tree.positions[corners[k]];
        return Vector3<double>{p[0], p[1], p[2]};
    };
    const Vector3<double> a = position(0), point{query.point[0], query.point[1], query.point[2]};
    const Nearest<double> found = nearest(point - a, position(1) - a, position(2) - a);
    const double d = found.squared_distance;
    // Of triangles equally close the first one answers, whatever the hint and the tree; -1 comes after all of them.
    const bool before = static_cast<unsigned>(triangle) < static_cast<unsigned>(query.triangle);
    if (!(d < query.squared_distance || (d == query.squared_distance && before))) return;
    query.squared_distance = d;
    query.triangle = triangle;
    query.v = found.v;
    query.w = found.w;
}

void search_far(const WideView& tree, WideQuery& query) {
    double point[3];
    for (int k = 0; k < 3; ++k) point[k] = (query.point[k] - tree.origin[k]) * tree.scale;
    const auto worth_it = [&](const WideNode& node, int i) {
        double squared = 0;
        for (int k = 0; k < 3; ++k) {
            const double outside = std::max({node.low[k][i] - point[k], point[k] - node.high[k][i], 0.0});
            squared += outside * outside;
        }
        return squared <= query.squared_distance * tree.scale * tree.scale * (1 + 1e-12);
    };
    const auto visit = [&](const auto& self, const WideNode& node) -> void {
        for (int i = 0; i < wide; ++i) {
            const bool empty = node.low[0][i] > node.high[0][i];
            if (empty || !worth_it(node, i)) continue;
            if (node.child[i] >= 0) {
                self(self, tree.nodes[node.child[i]]);
                continue;
            }
            for (const int t : tree.blocks[~node.child[i]].triangle)
                if (agrees(tree, query, t)) settle(tree, query, t);
        }
    };
    visit(visit, tree.nodes[0]);
}

} // namespace meshtween::search
