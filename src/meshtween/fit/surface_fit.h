// The default fit: a thin shell that turns as its markers ask, then closes onto the surface from coarse to fine.
#pragma once

#include "meshtween/fit/fit.h"

namespace meshtween {

// The stages one after the other: renumbered, align, shell_levels, relax with the markers alone, relax level by level,
// settle, untangle, crease, lift. Any number of markers; with none the start is a guess from the principal axes, which
// a note tells. Same arguments and errors as fit().
FitResult surface_fit(const Mesh& source, const Mesh& target, std::span<const Marker> markers,
                      const FitOptions& options = {}, const Progress& progress = {});

} // namespace meshtween
