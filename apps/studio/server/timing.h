// When each part of the surface moves, as a person painted it on the source.
#pragma once

#include "events.h"

#include "meshtween/morph/timing.h"

#include <optional>

namespace meshtween::studio {

// {"dabs": [{"at": [x, y, z], "radius": parts of the diagonal, "start": 0..1, "end": 0..1}, ...]}: of several dabs on a
// vertex the last one counts, what none touches moves all the time. Nothing where there are no dabs. Throws
// Error(argument) naming the dab.
std::optional<RegionTiming> painted_timing(const Json& timing, const Mesh& source);

} // namespace meshtween::studio
