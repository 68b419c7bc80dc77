// When what moves: eased time, loops, and regions with times of their own.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/morph/morph.h"

#include <string_view>
#include <vector>

namespace meshtween {

enum class Ease { linear, in, out, in_out };

// "linear", "in", "out", "in-out"; throws Error(argument) naming those that exist.
Ease ease_named(std::string_view name);
std::string_view name_of(Ease kind);

// Takes 0..1 to 0..1, the ends to themselves, never falling: slow at the start (in), at the end (out) or at both.
double ease(Ease kind, double t);

// There and back: 0..1..0 over a period of 1. Any t.
double ping_pong(double t);

// Each vertex goes its way between two moments of the whole, 0 <= start < end <= 1. n each.
struct RegionTiming {
    Eigen::VectorXd start, end;
};

// Regions with times of their own: `start` and `end` of some vertices (markers, or all that a painted attribute names),
// spread over the surface so that times change smoothly: the harmonic function with those values, smoothed again over
// `width` (parts of the diagonal, 0 for no smoothing). Throws Error(argument) for a bad index or times.
struct TimedVertex {
    int vertex = 0;
    double start = 0, end = 1;
};
RegionTiming region_timing(const Mesh& mesh, const std::vector<TimedVertex>& given, double width = 0.05);

// The vertices' own parameters when the whole is at u; each eased in and out. n.
Eigen::VectorXd own_times(const RegionTiming& timing, double u);

// The same path with regions moving at times of their own. With the rigid method turns and edges are interpolated at
// their own times, so that what moves early takes along what it carries; other methods move vertices one by one.
Morph retimed(const Morph& morph, const RegionTiming& timing);

} // namespace meshtween
