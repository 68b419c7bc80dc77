// The figure's body: sections and lengths after the eight-head canon of the drawing schools, softened.
#include "meshtween/geometry/figure_rest.h"

#include <array>

namespace meshtween::figure_rest {
namespace {

// Sections whose `at` is given by a coordinate that begins at `origin`.
std::vector<Section> counted_from(double origin, std::vector<Section> sections) {
    for (Section& s : sections) s.at -= origin;
    return sections;
}

void add_trunk(Sculpture& body) {
    constexpr double bottom = 0.79;
    body.add(loft({{0, bottom, 0},
                   {0, 1.48, 0},
                   {0, 0, 1},
                   counted_from(bottom, {{0.79, 0.040, 0.045, 0.050, -0.004},
                                         {0.83, 0.088, 0.074, 0.082, -0.006},
                                         {0.865, 0.140, 0.091, 0.099, -0.010},
                                         {0.90, 0.165, 0.098, 0.106, -0.012},
                                         {0.97, 0.158, 0.099, 0.098, -0.006},
                                         {1.04, 0.141, 0.093, 0.083, 0.000},
                                         {1.11, 0.127, 0.088, 0.077, 0.005},
                                         {1.18, 0.132, 0.093, 0.086, 0.003},
                                         {1.26, 0.146, 0.102, 0.100, -0.004},
                                         {1.33, 0.150, 0.100, 0.106, -0.012},
                                         {1.39, 0.135, 0.084, 0.096, -0.020},
                                         {1.44, 0.090, 0.062, 0.074, -0.026},
                                         {1.48, 0.055, 0.048, 0.054, -0.026}}),
                   0.03,
                   0.03}),
             0.01);
    body.add_pair(ellipsoid({0.070, 0.895, -0.070}, {0.076, 0.084, 0.058}), 0.07);
    body.add_pair(ellipsoid({0.066, 1.305, 0.056}, {0.070, 0.055, 0.040}), 0.06);
    body.add_pair(round_cone({0.025, 1.478, -0.032}, 0.034, {0.150, 1.413, -0.022}, 0.040), 0.05);
    body.add(round_cone({0, 1.44, -0.030}, 0.053, {0, 1.57, -0.004}, 0.047), 0.05);
}

void add_head(Sculpture& body) {
    body.add(ellipsoid({0, 1.658, -0.006}, {0.074, 0.090, 0.096}), 0.03);
    body.add(ellipsoid({0, 1.600, 0.034}, {0.055, 0.082, 0.060}), 0.04);
    body.add_pair(ellipsoid({0.036, 1.563, 0.020}, {0.018, 0.028, 0.034}, 20), 0.035);
    body.add(ellipsoid({0, 1.532, 0.066}, {0.020, 0.016, 0.020}), 0.035);
    body.add_pair(ellipsoid({0.028, 1.650, 0.070}, {0.024, 0.009, 0.014}), 0.030);
    body.add_pair(ellipsoid({0.038, 1.605, 0.055}, {0.018, 0.016, 0.022}), 0.025);
    body.carve_pair(ellipsoid({0.029, 1.633, 0.100}, {0.017, 0.011, 0.011}), 0.018);
    body.add(round_cone({0, 1.645, 0.083}, 0.007, {0, 1.605, 0.103}, 0.0095), 0.018);
    body.add_pair(ellipsoid({0.008, 1.600, 0.095}, {0.008, 0.007, 0.010}), 0.010);
    body.add(ellipsoid({0, 1.566, 0.080}, {0.028, 0.009, 0.012}), 0.016);
    body.add_pair(ellipsoid({0.070, 1.620, -0.010}, {0.008, 0.030, 0.018}, -14), 0.012);
}

void add_arm(Sculpture& body) {
    body.add_pair(loft({shoulder,
                        on_arm(0.58, 0, 0),
                        {0, 0, 1},
                        {{0.00, 0.049, 0.050, 0.049},
                         {0.06, 0.050, 0.052, 0.050},
                         {0.14, 0.043, 0.045, 0.044},
                         {0.22, 0.039, 0.041, 0.040},
                         {0.29, 0.035, 0.036, 0.036},
                         {0.35, 0.037, 0.040, 0.038},
                         {0.43, 0.031, 0.035, 0.033},
                         {0.50, 0.023, 0.029, 0.028},
                         {0.55, 0.019, 0.027, 0.026},
                         {0.58, 0.018, 0.029, 0.028}},
                        0.05,
                        0.015}),
                  0.05);
    body.add_pair(loft({on_arm(wrist - 0.01, 0, 0),
                        on_arm(knuckles, 0, 0),
                        {0, 0, 1},
                        {{0.00, 0.017, 0.025, 0.024},
                         {0.04, 0.018, 0.035, 0.034},
                         {0.08, 0.016, 0.040, 0.039},
                         {0.10, 0.013, 0.039, 0.038}},
                        0.01,
                        0.012}),
                  0.015);
    struct Finger {
        double front, length, thickness;
    };
    for (const Finger& f : {Finger{0.029, 0.070, 0.0100}, Finger{0.0105, 0.080, 0.0105}, Finger{-0.009, 0.074, 0.0100},
                            Finger{-0.027, 0.056, 0.0090}})
        body.add_pair(round_cone(on_arm(knuckles - 0.01, 0.001, f.front), f.thickness,
                                 on_arm(knuckles + f.length, 0.012, f.front * 0.88), f.thickness * 0.82),
                      0.013);
    body.add_pair(round_cone(on_arm(wrist + 0.025, 0.006, 0.026), 0.0145, on_arm(wrist + 0.085, 0.020, 0.060), 0.0095),
                  0.022);
}

void add_leg(Sculpture& body) {
    body.add_pair(loft({hip,
                        ankle,
                        {0, 0, 1},
                        {{0.00, 0.074, 0.082, 0.084, 0.000},
                         {0.08, 0.085, 0.088, 0.090, 0.000},
                         {0.18, 0.079, 0.083, 0.080, 0.003},
                         {0.30, 0.062, 0.070, 0.062, 0.005},
                         {0.38, 0.051, 0.057, 0.050, 0.003},
                         {0.43, 0.047, 0.053, 0.045, 0.001},
                         {0.50, 0.049, 0.045, 0.056, -0.003},
                         {0.57, 0.049, 0.040, 0.063, -0.006},
                         {0.65, 0.040, 0.036, 0.050, -0.006},
                         {0.73, 0.031, 0.032, 0.036, -0.003},
                         {0.79, 0.028, 0.030, 0.032, 0.001},
                         {0.836, 0.030, 0.035, 0.034, 0.002}},
                        0.11,
                        0.03}),
                  0.07);
    body.add_pair(loft({{0.120, 0.030, -0.062},
                        {0.142, 0.020, 0.150},
                        {0, 1, 0},
                        {{0.00, 0.027, 0.028, 0.035},
                         {0.05, 0.031, 0.048, 0.035},
                         {0.10, 0.034, 0.042, 0.030},
                         {0.15, 0.042, 0.028, 0.030},
                         {0.19, 0.042, 0.020, 0.030},
                         {0.213, 0.036, 0.016, 0.025}},
                        0.022,
                        0.026}),
                  0.03);
    body.floor(0, 0.012);
}

} // namespace

Sculpture body() {
    Sculpture body;
    add_trunk(body);
    add_leg(body);
    add_arm(body);
    add_head(body);
    return body;
}

} // namespace meshtween::figure_rest
