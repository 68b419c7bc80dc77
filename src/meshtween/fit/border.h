// Where an open surface ends.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/geometry/topology.h"

#include <vector>

namespace meshtween {

// Border edges as triangles without area (a, b, b), the surface to their left.
Triangles border_edges(const Triangles& triangles, const Topology& topology);

// Unit directions of the border at its vertices, the surface to their left; zero elsewhere. n x 3.
Points border_directions(const Points& positions, const Triangles& border);

// How large the border is that a vertex lies on: the diagonal of its bounding box, in the positions' unit; 0 inside. n,
// or none where there is no border. A hole in a scan is not the rim of a face.
std::vector<double> border_sizes(const Points& positions, const Triangles& border);

} // namespace meshtween
