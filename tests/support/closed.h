// What the tests of closed meshes ask again and again.
#pragma once

#include "meshtween/geometry/topology.h"

#include <algorithm>

namespace meshtween {

// V - E + F: 2 less twice the genus for a closed mesh of one component.
inline long euler(const Mesh& mesh) {
    const auto edges = static_cast<long>(topology(mesh.positions.rows(), mesh.triangles).edges.size());
    return mesh.positions.rows() - edges + mesh.triangles.rows();
}

inline bool closed(const Mesh& mesh) {
    const Topology t = topology(mesh.positions.rows(), mesh.triangles);
    return std::all_of(t.edges.begin(), t.edges.end(), [](const Edge& e) { return e.count == 2; });
}

} // namespace meshtween
