// The figure's mesh at rest and its named places: rays from inside the body, so that each place means what it says.
#include "meshtween/geometry/figure.h"
#include "meshtween/geometry/figure_rest.h"
#include "meshtween/geometry/isosurface.h"

namespace meshtween {
namespace {

using namespace figure_rest;

std::vector<LandmarkSpot> places() {
    const Point up(0, 1, 0), down(0, -1, 0), ahead(0, 0, 1), back(0, 0, -1), out(1, 0, 0);
    const Point palm = on_arm(0, 1, 0) - on_arm(0, 0, 0), leg = (ankle - hip).normalized();
    const Point knee_centre = hip + knee * leg;
    return {
        {"head_top", {0, 1.66, 0}, up, false},
        {"forehead", {0, 1.685, 0}, ahead, false},
        {"nose_tip", {0, 1.603, 0.05}, ahead, false},
        {"chin", {0, 1.55, 0.05}, {0, -0.6, 1}, false},
        {"ear", {0.02, 1.622, -0.010}, out, true},
        {"nape", {0, 1.51, -0.02}, back, false},
        {"throat", {0, 1.43, -0.02}, ahead, false},
        {"shoulder", shoulder, {0.35, 1, 0}, true},
        {"armpit_front", {0.11, 1.33, -0.01}, {0.5, 0, 1}, true},
        {"chest", {0.070, 1.285, 0.0}, ahead, true},
        {"navel", {0, 1.05, 0}, ahead, false},
        {"back_upper", {0, 1.30, 0}, back, false},
        {"back_lower", {0, 1.08, 0}, back, false},
        {"waist", {0, 1.11, 0}, out, true},
        {"hip", {0.06, 0.89, 0}, out, true},
        {"seat", {0.075, 0.89, 0}, back, true},
        {"crotch", {0, 0.87, 0}, down, false},
        {"elbow", on_arm(elbow, 0, 0), back, true},
        {"wrist", on_arm(wrist, 0, 0), -palm, true},
        {"thumb_tip", on_arm(wrist + 0.05, 0.012, 0.040), on_arm(0.060, 0.014, 0.034) - shoulder, true},
        {"finger_tip", on_arm(knuckles + 0.03, 0.006, 0.010), arm_axis, true},
        {"knee", knee_centre, ahead, true},
        {"ankle", ankle, out, true},
        {"heel", {0.122, 0.035, -0.04}, back, true},
        {"toe", {0.137, 0.020, 0.10}, {0.09, 0, 1}, true},
    };
}

} // namespace

Mesh figure_at_rest(const RemeshOptions& options, double cell, const Point& offset) {
    const Field field = body();
    const Point low = Point(-0.80, -0.06, -0.24) + cell * offset;
    return remesh(isosurface(field, {low, {0.80, 1.84, 0.24}}, cell), field, options);
}

Landmarks figure_landmarks() {
    return landmarks(body(), places(), 0.3);
}

} // namespace meshtween
