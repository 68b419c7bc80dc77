// A curve's weights over time, on straight lines between keys: what glTF, USD and game engines play.
#pragma once

#include "meshtween/morph/curve.h"
#include "meshtween/morph/timing.h"

#include <string>
#include <vector>

namespace meshtween {

// The tolerance's parts for the curve and for the straight lines between an animation's keys; what is left is for
// floats.
constexpr double curve_part = 0.9, chord_part = 0.08;

struct PlayOptions {
    double seconds = 2;       // from one end to the other
    bool ping_pong = true;    // and back again
    Ease ease = Ease::linear; // of the time from one end to the other
    std::string title;        // shown by the page
    double tolerance = 8e-6;  // how far straight lines between keys may leave the curve, parts of the diagonal
};

struct WeightKeys {
    std::vector<float> times;   // T seconds, ascending from 0
    std::vector<float> weights; // T x (K - 1), a row a time: those of nodes 1, 2, ...; node 0 takes the rest
    double chords = 0;          // how far the straight lines leave the curve, parts of the diagonal
    double floats = 0;          // what is lost where a viewer keeps offsets and weights in float and adds them up so
};

// As many keys as the tolerance takes, a key at every knot. Each weight lies in 0..1, and no row adds up to more
// than 1. Throws Error(argument) for seconds out of range or a curve without shapes.
WeightKeys weight_keys(const Curve& curve, const PlayOptions& options = {});

// The weights of nodes 1, 2, ... at u as floats, each in 0..1, adding up to 1 at most.
std::vector<float> float_weights(const Curve& curve, double u);

} // namespace meshtween
