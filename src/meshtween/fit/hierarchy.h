// A mesh and coarser and coarser copies of it, for work that goes from coarse to fine.
#pragma once

#include "meshtween/core/mesh.h"

#include <vector>

namespace meshtween {

// One copy. Its vertices are some of the next finer level's, so that each level's vertices lie on the original surface.
struct Level {
    Points positions;
    Triangles triangles;
    std::vector<int> finer;          // n: this vertex's index in the next finer level (in the mesh itself on level 0)
    std::vector<SurfacePoint> place; // a place on this level for each vertex of the next finer level; empty on level 0
};

struct HierarchyOptions {
    int coarsest = 500; // vertices: where it ends
    double factor = 4;  // vertices of a level over those of the next coarser one; up to twice as many at the last step
};

// Finest first; level 0 is the mesh itself. Edges collapse onto one of their ends about in the order of quadric error
// plus a share of their length, which keeps thin parts such as fingers; boundaries stay on themselves. Places are
// looked for among the neighbours that a vertex collapsed into, never across a gap in space. O(n log n). Works on any
// triangles; what cannot be thinned (many tiny components) is left as it is.
std::vector<Level> hierarchy(const Points& positions, const Triangles& triangles, const HierarchyOptions& options = {});

} // namespace meshtween
