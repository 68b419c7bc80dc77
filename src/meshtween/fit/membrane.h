// The surface that springs along a mesh's edges span over what is held.
#pragma once

#include "meshtween/core/mesh.h"

namespace meshtween {

// Vertices 0 .. free go to the mean of their neighbours, all at once; the others hold. Over a flat convex rim no
// triangle is turned over (Tutte: How to draw a graph, 1963). What hangs together without anything held stays as it is.
Points membrane(const Points& positions, const Triangles& triangles, Eigen::Index free);

} // namespace meshtween
