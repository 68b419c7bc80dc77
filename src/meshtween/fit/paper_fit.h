// The paper's fit: marker warp, then rounds of smoothing and projection (Eq. 1-7).
#pragma once

#include "meshtween/fit/fit.h"

namespace meshtween {

// As fit() for FitMethod::paper; the input is checked already.
FitResult paper_fit(const Mesh& source, const Mesh& target, std::span<const Marker> markers, const FitOptions& options,
                    const Progress& progress);

} // namespace meshtween
