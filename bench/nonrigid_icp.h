// A peer of the surface fit: an affine map a vertex, which stay alike between neighbours.
#pragma once

#include "meshtween/core/mesh.h"

#include <span>

namespace meshtween {

// The source's positions on the target, after as many rounds as its usual settings ask for.
Points nonrigid_icp(const Mesh& source, const Mesh& target, std::span<const Marker> markers);

} // namespace meshtween
