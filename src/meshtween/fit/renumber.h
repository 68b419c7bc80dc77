// A mesh with its vertices and triangles in the order of their places. A file's order scatters neighbours over all of
// the memory, where work on a large mesh mostly waits for them; and which of two places as good is taken should not
// hang on how a file counts.
#pragma once

#include "meshtween/core/mesh.h"

#include <vector>

namespace meshtween {

// Vertices along a space-filling curve, triangles by their vertices; each keeps which corner is its first.
struct Renumbered {
    Points positions;
    Triangles triangles;
    std::vector<int> vertex;   // n: its number before
    std::vector<int> triangle; // m: its number before
};

// O(n) but for the few places where many vertices are closer than a thousandth of the extent. The same mesh whatever
// its order before, but for vertices in one place or of no triangle.
Renumbered renumbered(const Points& positions, const Triangles& triangles);

Points in_order_of(const std::vector<int>& before, const Points& x); // row i is row before[i] of x
Points as_before(const std::vector<int>& before, const Points& x);   // its inverse

} // namespace meshtween
