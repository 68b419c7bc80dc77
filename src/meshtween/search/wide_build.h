// Lays a mesh out for the wide searches.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/search/closest_point.h"
#include "meshtween/search/wide_tree.h"

#include <vector>

namespace meshtween::search {

struct WideTree {
    std::vector<WideNode> nodes; // the root first
    std::vector<TriangleBlock> blocks;
    std::vector<Neighbourhood> neighbourhoods;
    std::vector<int> home; // the neighbourhood of each triangle
    Point origin{0, 0, 0};
    double scale = 1;
};

// Of at least one triangle. The same tree for any number of threads.
WideTree wide_tree(const Points& positions, const Triangles& triangles, MeshIs mesh = MeshIs::still);

// Its last step for a mesh that is still: fills neighbourhoods and home.
void add_neighbourhoods(WideTree& tree);

// The tree of the same triangles with their vertices elsewhere, without neighbourhoods.
void refit(WideTree& tree, const Points& positions, const Triangles& triangles);

// The searches that this machine can do, the plain one first and the widest last.
struct NamedSearch {
    const char* name;
    WideSearch search;
};
std::vector<NamedSearch> searches();

// What every index uses from now on: the widest, unless another is set (nullptr: the widest again). For tests and
// benchmarks; not while a search runs.
WideSearch current_search();
void use_search(WideSearch search);

} // namespace meshtween::search
