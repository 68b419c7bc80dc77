// A morph whose look fades with its shape, as one GLB.
#pragma once

#include "meshtween/morph/curve.h"

#include <span>
#include <string>
#include <vector>

namespace meshtween {

enum class Fading {
    colors, // vertex colours become morph targets, as positions are
    cover,  // the second look lies over the first as a mesh of its own, whose opacity is a morph target
};

// `from` and `to` are GLBs of the same morph with two looks, as mesh_glb writes them; for colours, both have them.
// share[k] is how far the look has faded at the base (k = 0) and each morph target, blended as positions are. What both
// files hold is stored once.
std::string fading_glb(const std::string& from, const std::string& to, std::span<const double> share, Fading fading);

// What u itself is at the curve's nodes: blended as they are, the shares give u.
std::vector<double> shares_of_u(const Curve& curve);

} // namespace meshtween
