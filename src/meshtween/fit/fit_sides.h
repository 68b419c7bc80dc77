// What the default fit works on: the target to be asked, the source's levels, and the markers between them.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/refine.h"
#include "meshtween/fit/renumber.h"

#include <optional>
#include <span>
#include <vector>

namespace meshtween {

struct FitSides {
    std::optional<FitTarget> target;
    ShellLevels shells;
    double marker_noise = 0; // MarkerGoals
};

// `goals`, a row a marker, become those of marker_goals. `cut_off` are vertices of the source's border that end_borders
// takes for none.
FitSides fit_sides(const Points& rest, const Triangles& triangles, const Renumbered& target,
                   std::span<const Marker> markers, Points& goals, bool with_twins, const std::vector<int>& cut_off);

std::vector<Pin> pins_of(std::span<const Marker> markers, const Points& goals);

// The markers' pins and those of their twins.
void set_all_pins(const Points& rest, const Triangles& triangles, std::vector<Pin> pins, bool with_twins,
                  FitSides& sides);

// Where noisy markers' points belong, as far as they tell: `free` has been fitted nearly without them, and goes part of
// the way back to them.
Points without_noise(const Points& rest, const Triangles& triangles, const Points& free, std::span<const Pin> pins,
                     const FitSides& sides);

} // namespace meshtween
