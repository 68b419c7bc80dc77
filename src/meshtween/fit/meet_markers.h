// Markers met exactly, after a fit that met them nearly.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/fit.h"

#include <span>
#include <vector>

namespace meshtween {

struct MetMarkers {
    Points positions;                // n x 3
    std::vector<std::size_t> missed; // markers further than 1e-9 of the target's diagonal from their places, ascending
};

// Moves a fitted mesh so that each marker's point, inside a triangle or on a corner, lies on the marker's target. What
// is missing is spread smoothly over the vertices around, wider where it is large, and these are set down on the target
// again; the last small step leaves the target where it must: a flat triangle whose marker lies on a curved surface
// has its corners a little off it. Of several widths the one that turns over fewest triangles is taken. Markers are
// missed where more of them than the corners allow share a triangle, or two ask different places of one point.
MetMarkers meet_markers(const Mesh& fitted, const Mesh& target, std::span<const Marker> markers);

// The same for a fit of the source; markers that it misses are named in the notes.
void meet_markers(FitResult& fit, const Mesh& source, const Mesh& target, std::span<const Marker> markers);

} // namespace meshtween
