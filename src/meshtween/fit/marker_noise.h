// Markers as people place them: beside the surface, and not quite where they belong along it.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/refine.h"

namespace meshtween {

// Where markers point to on the target.
struct MarkerGoals {
    Points places;    // k x 3
    double noise = 0; // standard deviation in each coordinate, as the distances from the surface tell it; parts of the
                      // target's diagonal
};

// The points given, k x 3, taken to the closest places on the target: a fitted mesh lies on it. Those stay that are
// closest to the target's border, where the surface may be missing, or further off than 0.05 of the diagonal, which no
// slip of the hand explains. How much the signed distances scatter is the noise, 1.48 times the median of their
// deviations: people err along the surface as they do across it, while markers that all float at one height err by that
// height alone. Less than 0.003 of the diagonal, and fewer than 8 markers, count as none: 0.
MarkerGoals marker_goals(const Points& given, const FitTarget& target);

// What is left of markers' misfits, k x 3 vectors at these places, when noise of that standard deviation has been taken
// out: the mean of a Gaussian process whose variance and correlation length are the likeliest ones (Rasmussen,
// Williams: Gaussian Processes for Machine Learning, 2006, Eq. 2.25 and 5.8, Matern's kernel of 3/2). Misfits that
// neighbours share stay, those of single markers go.
Points smooth_misfits(const Points& places, const Points& misfits, double noise);

} // namespace meshtween
