// Where a fit is worst, and where another marker would help it most.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/correspondence.h"

#include <span>
#include <string_view>
#include <vector>

namespace meshtween {

enum class PlaceFault {
    off_target,  // the vertex lies off the target
    uncovered,   // a part of the target has nothing of the mesh on it
    facing_away, // the mesh looks into the target here
    beyond,      // the target ends before this vertex (a hole, a border)
    stretched,   // triangles here are drawn out or pressed together
};
std::string_view name_of(PlaceFault fault); // "off target", "uncovered", ...

struct WorstPlace {
    int vertex = 0;
    PlaceFault fault = PlaceFault::off_target;
    double badness = 0; // 1: worth a look; the larger the worse, over all faults
    double value = 0; // off_target, uncovered, beyond: parts of the diagonal; facing_away: the cosine between normals;
                      // stretched: the largest change of a length, as a factor of at least 1
};

// A fault an entry, the worst for its vertex; badness is 1 at 0.5 % of the diagonal, at a cosine of 0.5, at a factor of
// 3. What lies beyond the target is no fault of the fit, and never worse than 1. n.
std::vector<WorstPlace> place_faults(const Mesh& source, const Mesh& fitted, const Correspondence& map);

// The worst first, no two nearer than `apart` (parts of the fitted mesh's diagonal) to each other, none with a badness
// under 0.2; at most `count`.
std::vector<WorstPlace> worst_places(const Mesh& fitted, const std::vector<WorstPlace>& faults, std::size_t count = 20,
                                     double apart = 0.03);

struct MarkerSuggestion {
    WorstPlace place; // its vertex on the source; badness under 0.2: nothing is wrong here but markers are far
    Point target{0, 0,
                 0};  // a guess to correct: where the fit took the vertex, on the target, or what is uncovered there
    double alone = 0; // how far the nearest marker is, parts of the source's diagonal; infinite without markers
};

// "Place your next marker here", the most useful first: bad places far from markers, then places far from all markers.
// None is nearer than 3 % of the diagonal to a marker or than 5 % to another suggestion, and none beyond the target.
std::vector<MarkerSuggestion> suggest_markers(const Mesh& source, const Mesh& target, const Correspondence& map,
                                              const std::vector<WorstPlace>& faults, std::span<const Marker> markers,
                                              std::size_t count = 5);

} // namespace meshtween
