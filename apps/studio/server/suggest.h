// Where a marker might go: the guess on the other model, and the next place worth one.
#pragma once

#include "meshes.h"

namespace meshtween::studio {

// Where `point` on the one model probably lies on the other: the warp through the complete pairs (with fewer than three
// of them, the boxes laid onto each other), then the closest point of the surface.
Point guess(const OpenMesh& from, const OpenMesh& to, const std::vector<MarkerPair>& pairs, Side side,
            const Point& point);

// Places on the source, the most useful first, with a reason each: [{at, why}, ...]. After a fit the worst places of it
// that have no marker near; before one, the vertices furthest from all markers.
Json next_places(const OpenMesh& source, const std::vector<PlacedMarker>& markers, const Json& fit);

} // namespace meshtween::studio
