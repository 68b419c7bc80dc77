// An open target may show a part of what the mesh does: a scan of a face, a body cut off at the waist. What lies beyond
// its border has no counterpart there, and must not be drawn to whatever is nearest.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/search/closest_point.h"

#include <vector>

namespace meshtween {

// What is asked for closest places.
struct OpenSurface {
    const Triangles& triangles;
    const std::vector<char>& on_boundary; // a vertex
    const ClosestPointIndex& index;
};

// True where a point lies on an edge or a corner of the border, to within rounding.
bool at_border(const SurfacePoint& point, const Triangles& triangles, const std::vector<char>& on_boundary);

// How far each vertex of a mesh has a counterpart in its place on an open surface, 0..1: `places` are the closest that
// look its way and lie no further than `reach`, an entry a vertex. Where both show the same part, the mesh comes about
// as near to the place as the vertex is: 1 from half of its distance on. Where another part of the mesh lies there
// already, it comes much nearer: 0 up to a quarter, and where nothing was found. What has none is connected with a
// vertex that is out of reach or nearest to the border; elsewhere, as in a furrow that the surface does not have,
// a vertex may be hidden but belongs there: 1.
std::vector<double> counterparts(const Points& positions, const Lists& neighbours,
                                 const std::vector<ClosestPoint>& places, const OpenSurface& surface,
                                 const ClosestPointIndex& mesh, double reach);

// Of `flips`, triangles that look into the target, those that do not lie beyond its border with all their corners:
// nothing tells which way these should look. `beyond` has a flag a vertex, or none.
std::vector<int> without_beyond(const Triangles& triangles, const std::vector<char>& beyond, std::vector<int> flips);

} // namespace meshtween
