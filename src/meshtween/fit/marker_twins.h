// What symmetry says of markers: each has a twin on the other side.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/search/closest_point.h"

#include <vector>

namespace meshtween {

// A marker's mirror image on both shapes: a guess.
struct MarkerTwin {
    SurfacePoint source;
    Point target{0, 0, 0};
    double weight = 0; // 0..1: falls to nothing where either shape is far from its own mirror image
    double slack = 0;  // how far the guess may be off: twice the misfits of both shapes, and what pairs of markers tell
};

// The twins of markers, places on the source and on the target, k x 3, in the order of the markers. None where either
// shape has no plane of symmetry, or where the markers do not lie alike beside both planes; none of a marker whose
// image another marker, or itself, is near: within 0.02 on the source, or four times the slack on either shape. Lengths
// are parts of the target's diagonal, and the source is aligned to it: the caller scales and turns.
std::vector<MarkerTwin> marker_twins(const Points& source, const Triangles& source_triangles, const Points& target,
                                     const Triangles& target_triangles, const ClosestPointIndex& target_index,
                                     const Points& on_source, const Points& on_target);

} // namespace meshtween
