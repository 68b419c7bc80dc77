// Between what a screen is sent and the light that it then gives (IEC 61966-2-1, sRGB). Values in 0..1.
#pragma once

#include <cmath>

namespace meshtween {

template <typename Real>
Real linear_from_srgb(Real shown) {
    return shown <= Real(0.04045) ? shown / Real(12.92) : std::pow((shown + Real(0.055)) / Real(1.055), Real(2.4));
}

template <typename Real>
Real srgb_from_linear(Real light) {
    return light <= Real(0.0031308) ? light * Real(12.92) : Real(1.055) * std::pow(light, 1 / Real(2.4)) - Real(0.055);
}

} // namespace meshtween
