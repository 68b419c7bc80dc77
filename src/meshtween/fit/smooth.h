// Relaxing a mesh by the centres of the triangles around each vertex (the paper's Eq. 6).
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/geometry/topology.h"

namespace meshtween {

// What smoothing walks over, made once a mesh.
struct Surroundings {
    Topology topology;
    Lists rim; // a list a vertex: its neighbours along boundary edges, ascending; empty inside
};
Surroundings surroundings(Eigen::Index vertex_count, const Triangles& triangles);

// Moves each vertex the part `strength` (0..1) of the way to the mean of the centres of its triangles, weighted by
// their areas (Eq. 6). A vertex on the boundary moves along it only: towards the mean of its boundary edges' middles,
// weighted by their lengths, in the direction of its two rim neighbours; it stays where the boundary forks. Vertices
// without area around them move to the plain mean of their neighbours; vertices of no triangle stay. All read the old
// positions. n x 3 to n x 3.
Points smooth(const Points& positions, const Triangles& triangles, const Surroundings& around, double strength = 1);

} // namespace meshtween
