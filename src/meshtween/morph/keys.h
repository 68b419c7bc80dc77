// Several key shapes in a row, passed with continuous velocity; and blends of several shapes.
#pragma once

#include "meshtween/morph/curve.h"
#include "meshtween/morph/repair.h"
#include "meshtween/morph/timing.h"

#include <optional>

namespace meshtween {

struct KeyOptions {
    MorphOptions morph;
    CurveOptions curve;                  // of each piece; with several pieces max_nodes counts as 4 at least
    std::vector<double> times;           // one a shape, ascending from 0 to 1; empty for equal steps
    bool closed = false;                 // the last shape goes on to the first: one more piece, and one more time
    std::optional<RegionTiming> timing;  // regions with times of their own, within each piece
    std::optional<RepairOptions> repair; // bend pieces where they cut themselves; none: leave them as they are
};

struct KeyPath {
    Curve curve;         // a piece from key to key; cancelled where the progress said so: then it has no nodes
    SolveReport report;  // of the most laborious solve
    RepairReport repair; // of all pieces together
};

// A path through shapes of one mesh, curve.at(times[k]) being shapes[k], with continuous velocity. Between neighbours
// it is the method's own path; near a key pieces slow down or hurry to a common speed, and stop there where they part
// in direction by 30 degrees or more. What still differs is made up for by cubics. Throws Error(argument) for fewer
// than two shapes or bad times.
KeyPath key_path(const Mesh& mesh, const std::vector<Points>& shapes, const KeyOptions& options = {},
                 const Progress& progress = {});

// The shape that is weights[k] of shapes[k]; weights add up to 1, and may be negative or above 1 (a caricature). With
// `linear` the weighted sum; with other methods in-betweens of in-betweens, the heaviest shapes first. Throws
// Error(argument) where weights do not add up to 1 or their number differs.
Points blend(const Mesh& mesh, const std::vector<Points>& shapes, const std::vector<double>& weights,
             const MorphOptions& options = {});

} // namespace meshtween
