// Near-equilateral triangles on an implicit surface, small where it curves.
#pragma once

#include "meshtween/geometry/implicit.h"

namespace meshtween {

struct RemeshOptions {
    double deviation = 0.0005; // how far triangles may lie from the surface; the field's unit
    double shortest = 0.005;   // edge lengths are kept within these two; the field's unit
    double longest = 0.02;
    double growth = 0.2; // how fast edge length may grow with distance
    int rounds = 8;
};

// Edges are split, collapsed and turned, and vertices moved along the surface, until their lengths suit the curvature.
// The mesh must be closed and manifold, near the surface; its genus stays. Runs in order: the same bits every time.
Mesh remesh(const Mesh& mesh, const Field& field, const RemeshOptions& options = {});

} // namespace meshtween
