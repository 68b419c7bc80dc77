// Marker pairs, points in space, put onto the source's surface.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/io/markers.h"

#include <span>
#include <vector>

namespace meshtween {

// Each pair's source point moves to the closest point of the source's surface; targets stay where they are.
std::vector<Marker> place_markers(std::span<const MarkerPair> pairs, const Mesh& source);

} // namespace meshtween
