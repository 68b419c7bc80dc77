// A part of a mesh with numbers of its own, for work that touches little of it.
#pragma once

#include "meshtween/fit/shell.h"

#include <array>
#include <span>
#include <vector>

namespace meshtween {

struct Region {
    std::vector<int> vertices, triangles; // their numbers in the whole mesh, ascending
    Shell shell;                          // rest, triangles and topology alone; its rim counts as a border

    int triangle(int whole) const; // the region's number of a triangle of the whole, or -1
};

// Some rings around these triangles, and what lies beside them at `positions`, though it belongs to another sheet.
Region region_around(const Shell& shell, const Points& positions, std::span<const int> triangles);

} // namespace meshtween
