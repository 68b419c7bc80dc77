// The default fit: a thin shell that turns as its markers ask, then closes onto the surface from coarse to fine.
#pragma once

#include "meshtween/fit/fit.h"

namespace meshtween {

// The stages one after the other: renumbered, align, fit_sides (shell_levels, marker_goals), relax with the markers
// alone, relax level by level, settle, untangle, crease, lift. Any number of markers; with none the start is a guess
// from the principal axes, which a note tells. Same arguments and errors as fit(). `cut_off` are vertices of the
// source's border where more of the shape follows, which is not fitted: nothing draws them to the target's border.
FitResult surface_fit(const Mesh& source, const Mesh& target, std::span<const Marker> markers,
                      const FitOptions& options = {}, const Progress& progress = {}, std::span<const int> cut_off = {});

} // namespace meshtween
