// What a fit's last shape still gets, once it lies on the target.
#pragma once

#include "meshtween/fit/fit.h"

namespace meshtween {

// Lifts the vertices of a surface fit (lift.h) unless they are to stay on the target, and meets markers exactly where
// that is asked for (meet_markers.h); markers that it misses are named in the notes.
void finish_fit(FitResult& result, const Mesh& source, const Mesh& target, std::span<const Marker> markers,
                const FitOptions& options);

} // namespace meshtween
