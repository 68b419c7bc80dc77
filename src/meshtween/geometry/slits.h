// Which edges that pair up are a border all the same: the rule is told in weld.h. Not for callers outside of it.
#pragma once

#include "meshtween/geometry/weld.h"

#include <array>
#include <vector>

namespace meshtween {

// Two triangles' edges in one place, running in opposite directions.
struct SeamEdge {
    std::array<int, 2> triangle{}, corner{}; // a side: from this corner to the next

    // End 0 is where the first side begins and the second ends.
    int corner_at(int side, int end) const {
        const int k = corner[static_cast<std::size_t>(side)];
        return side == end ? k : (k + 1) % 3;
    }
    int vertex(const Triangles& triangles, int side, int end) const {
        return triangles(triangle[static_cast<std::size_t>(side)], corner_at(side, end));
    }
};

// A flag an edge. `place`: a vertex each, equal where they lie in one.
std::vector<char> slit_edges(const Mesh& mesh, const Points& positions, const std::vector<int>& place,
                             const std::vector<SeamEdge>& edges, const CornerAttributes& file);

} // namespace meshtween
