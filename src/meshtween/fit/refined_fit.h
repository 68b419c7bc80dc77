// A fit whose template is cut finer where it is too coarse for the target.
#pragma once

#include "meshtween/fit/fit.h"
#include "meshtween/geometry/topology.h"

namespace meshtween {

struct RefineOptions {
    double tolerance = 2e-4;        // parts of the target's diagonal: how far the surfaces may part between vertices
    int rounds = 3;                 // of cutting; each halves the edges that it cuts
    long most_vertices = 2'000'000; // no round starts that could end above this
};

// Edges of the fitted mesh that are too long, a flag an edge of the topology: both ends lie on the target within the
// tolerance and the middle does not, or the target rises that far over a triangle whose corners lie on it. What no
// vertex reaches, and what looks away, is not a question of how fine the triangles are.
std::vector<char> too_coarse(const Mesh& fitted, const Topology& topology, const Mesh& target, double tolerance);

struct RefinedFit {
    Mesh source;             // the source, cut finer: its vertices come first, in their order
    FitResult fit;           // of that mesh
    std::vector<long> added; // vertices, a round each; empty where nothing was too coarse
    long left = 0;           // edges still too coarse
};

// Fits, cuts what is too coarse (subdivide.h) and fits again, until nothing is or the rounds are up. Same errors as
// fit(), and Error(argument) for options out of range. Cancelled, it returns the last whole fit or the first,
// unfinished.
RefinedFit refined_fit(const Mesh& source, const Mesh& target, std::span<const Marker> markers,
                       const FitOptions& options = {}, const RefineOptions& refine = {}, const Progress& progress = {});

} // namespace meshtween
