// Several key shapes in a row, passed with continuous velocity; and blends of several shapes.
#pragma once

#include "meshtween/morph/curve.h"

namespace meshtween {

struct KeyPath {
    std::vector<double> times;   // m + 1, ascending, the first 0, the last 1
    std::vector<Curve> segments; // m
    Points at(double t) const;   // t in 0..1
};

struct KeyOptions {
    MorphOptions morph;
    CurveOptions curve;
    std::vector<double> times; // one a shape, ascending from 0 to 1; empty for equal steps
    bool closed = false;       // the last shape goes on to the first: one more segment, and one more time
};

// A path through shapes of one mesh, at(times[k]) being shapes[k]. Between neighbours it is the method's own path with
// a cubic correction that makes the velocity at each key the mean of what the segments on both sides want, weighted by
// their length in time as in Catmull and Rom's splines. Throws Error(argument) for fewer than two shapes or bad times.
KeyPath key_path(const Mesh& mesh, const std::vector<Points>& shapes, const KeyOptions& options = {},
                 const Progress& progress = {});

// The shape that is weights[k] of shapes[k]; weights add up to 1, and may be negative or above 1 (a caricature). With
// `linear` the weighted sum; with other methods in-betweens of in-betweens, the heaviest shapes first. Throws
// Error(argument) where weights do not add up to 1 or their number differs.
Points blend(const Mesh& mesh, const std::vector<Points>& shapes, const std::vector<double>& weights,
             const MorphOptions& options = {});

} // namespace meshtween
