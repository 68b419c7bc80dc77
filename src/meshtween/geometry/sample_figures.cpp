#include "meshtween/geometry/figure.h"
#include "meshtween/geometry/sample_makers.h"
#include "meshtween/geometry/subdivide.h"

namespace meshtween {
namespace {

FigureBuild woman() {
    FigureBuild b;
    b.height = 0.96, b.shoulders = 0.93, b.chest = 0.94, b.waist = 0.94, b.hips = 1.05;
    b.arms = 0.90, b.neck = 0.90, b.jaw = 0.94, b.bust = 0.026, b.seat = 0.008;
    return b;
}

FigureBuild man() {
    FigureBuild b;
    b.height = 1.03, b.shoulders = 1.13, b.chest = 1.07, b.waist = 1.09, b.hips = 0.97;
    b.arms = 1.15, b.legs = 1.03, b.neck = 1.07, b.head = 0.99, b.jaw = 1.05;
    b.bust = -0.004, b.belly = 0.008, b.seat = -0.008;
    return b;
}

FigurePose standing() {
    FigurePose p;
    p.left_arm.raise = 16, p.left_arm.swing = 4, p.left_arm.elbow = 14, p.left_arm.wrist = 6;
    p.right_arm = p.left_arm;
    return p;
}

FigurePose bowing() {
    FigurePose p;
    p.pelvis = 52, p.spine = 34, p.neck = 4;
    p.left_arm.raise = 58, p.left_arm.swing = 52, p.left_arm.elbow = 18;
    p.left_leg.swing = 59, p.left_leg.knee = 5, p.left_leg.ankle = -2;
    p.right_arm = p.left_arm, p.right_leg = p.left_leg;
    return p;
}

FigurePose arms_out() {
    FigurePose p;
    p.left_arm.raise = 104, p.left_arm.elbow = 10;
    p.right_arm = p.left_arm;
    return p;
}

// The two meshes of the body at rest: the source's, and a finer one whose lattice lies elsewhere.
Mesh source_mesh() {
    RemeshOptions options;
    options.deviation = 0.0007, options.shortest = 0.0052, options.longest = 0.024;
    return figure_at_rest(options, 0.011, {0, 0, 0});
}

Mesh target_mesh() {
    RemeshOptions options;
    options.deviation = 0.0004, options.shortest = 0.0045, options.longest = 0.020;
    return figure_at_rest(options, 0.0115, {0.37, 0.61, 0.23});
}

Sample figures(const FigureBuild& build_a, const FigurePose& pose_a, const FigureBuild& build_b,
               const FigurePose& pose_b, int subdivisions) {
    const Landmarks marks = figure_landmarks();
    return pair_of({source_mesh(), target_mesh(), [=](const Points& p) { return figure(p, build_a, pose_a); },
                    [=](const Points& p) { return figure(p, build_b, pose_b); }, marks.names, marks.points},
                   subdivisions);
}

} // namespace

Sample bow_sample(int subdivisions) {
    return figures(woman(), standing(), man(), bowing(), subdivisions);
}
Sample build_sample(int subdivisions) {
    return figures(woman(), standing(), man(), standing(), subdivisions);
}
Sample arms_sample(int subdivisions) {
    return figures(woman(), standing(), woman(), arms_out(), subdivisions);
}

Sample bow_pose_sample(int subdivisions) {
    Sample sample;
    sample.source = sample.target = subdivide(source_mesh(), subdivisions);
    sample.same_connectivity = true;
    const Points rest = sample.source.positions;
    sample.source.positions = figure(rest, woman(), standing());
    sample.truth = sample.target.positions = figure(rest, woman(), bowing());
    sample.middle = figure(rest, woman(), mix(standing(), bowing(), 0.5));
    return sample;
}

} // namespace meshtween
