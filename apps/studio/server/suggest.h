// Where a marker might go: the guess on the other model, and the next place worth one.
#pragma once

#include "meshes.h"

#include "meshtween/fit/align.h"

namespace meshtween::studio {

// How the models lie to each other before there are markers: their boxes laid onto each other, or their principal axes
// where that brings the surfaces clearly closer.
struct Pose {
    Similarity forward, back; // from the source to the target, and from the target to the source
};
Pose pose_of(const OpenMesh& source, const OpenMesh& target);

// Where `point` of the model `from` probably lies on the other one, `to`: carried by the warp through the complete
// pairs, by their similarity where they are few, by the pose where they are fewer than three; then the closest point of
// the surface.
Point guess(const OpenMesh& to, const Pose& pose, const std::vector<MarkerPair>& pairs, Side from, const Point& point);

// Places on the source, the most useful first, with a reason each and, where a fit knows it, their place on the target:
// [{at, why, target}, ...]. After a fit those that its report names and that have no marker near yet; before one, the
// vertices furthest from all markers.
Json next_places(const OpenMesh& source, const std::vector<PlacedMarker>& markers, const Json& fit);

} // namespace meshtween::studio
