// A human figure whose build and pose are parameters. Every figure is a smooth map of one body at rest, so that the
// place of each of its points is known in all others.
#pragma once

#include "meshtween/geometry/landmarks.h"
#include "meshtween/geometry/remesh.h"

namespace meshtween {

// Proportions; 1 leaves the body at rest as it is, and the bulges are metres added to it.
struct FigureBuild {
    double height = 1;
    double shoulders = 1, chest = 1, waist = 1, hips = 1; // breadth of the shoulders, girth of the others
    double arms = 1, legs = 1, neck = 1;                  // thickness
    double head = 1, jaw = 1;                             // size, breadth
    double arm_length = 1, leg_length = 1;
    double bust = 0, belly = 0, seat = 0;
};

// Degrees.
struct ArmPose {
    double raise = 45; // to the side; 0 hangs, 90 is level
    double swing = 0;  // to the front
    double twist = 0;  // palm to the back
    double elbow = 0, wrist = 0;
};
struct LegPose {
    double spread = 0, swing = 0, knee = 0, ankle = 0; // to the side, to the front, bent back, toes up
};
struct FigurePose {
    double pelvis = 0, spine = 0, neck = 0;               // tilted and bent to the front
    double spine_side = 0, spine_turn = 0, head_turn = 0; // to the figure's left
    ArmPose left_arm, right_arm;
    LegPose left_leg, right_leg;
};

// The pose between two, each angle `u` of the way.
FigurePose mix(const FigurePose& from, const FigurePose& to, double u);

// Where points of the body at rest go. Its feet stay on the ground where the pose lets them.
Points figure(const Points& rest, const FigureBuild& build, const FigurePose& pose);

// The body's surface at rest as a closed mesh: lattice cells of this size, moved by `offset` of a cell (two offsets
// give unrelated meshes).
Mesh figure_at_rest(const RemeshOptions& options, double cell, const Point& offset);

// 40 named places on the body at rest, `_L` on its left.
Landmarks figure_landmarks();

} // namespace meshtween
