// A level that has crumpled, laid out anew before it is refined, or before it moves.
#pragma once

#include "meshtween/core/progress.h"
#include "meshtween/fit/refine.h"
#include "meshtween/fit/tangles.h"

#include <optional>
#include <span>

namespace meshtween {

enum class Mending { much, all };

// Where shapes are unlike, a part of a coarse level may crumple for which the target has no room, such as the shoulders
// of a bust on a head without any: there a fold is a few triangles, that finer levels make thousands of. Where much is
// cut, more than one triangle in fifty, or with `all` in any case, what is turned over or cut is untangled, unless more
// of the target would be left uncovered: a tail may not go for its folds. Nothing where nothing is gained.
std::optional<Points> mended_level(TangleSearch& search, const Points& positions, std::span<const Pin> pins,
                                   Mending mending, const Progress& progress = {});

} // namespace meshtween
