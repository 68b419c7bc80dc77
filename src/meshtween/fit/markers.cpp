#include "meshtween/fit/markers.h"

#include "meshtween/search/closest_point.h"

namespace meshtween {

std::vector<Marker> place_markers(std::span<const MarkerPair> pairs, const Mesh& source) {
    if (pairs.empty()) return {};
    const ClosestPointIndex index(source.positions, source.triangles, MeshIs::moving); // sooner made: few ask
    std::vector<Marker> markers;
    markers.reserve(pairs.size());
    for (const MarkerPair& pair : pairs) markers.push_back({pair.name, index.closest(pair.source).where, pair.target});
    return markers;
}

} // namespace meshtween
