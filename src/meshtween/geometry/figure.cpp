// Build: displacements of the space around the body at rest, by section, by limb and by bulge. Pose: joint by joint
// from the hands and feet to the pelvis, each point turned about a joint by its share of the joint's angle, which rises
// smoothly across the joint; so every piece keeps its size as with dual quaternions (Kavan et al. 2007).
#include "meshtween/geometry/figure.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/figure_rest.h"

#include <Eigen/Geometry>

#include <cmath>

namespace meshtween {
namespace {

using namespace figure_rest;

Point blend(const Point& a, const Point& b, double part) {
    return a + part * (b - a);
}
double radians(double degrees) {
    return degrees * std::numbers::pi / 180;
}
double bell(double x, double middle, double reach) {
    return std::exp(-(x - middle) * (x - middle) / (reach * reach));
}
double blend(double a, double b, double part) {
    return a + part * (b - a);
}
Point mirrored(const Point& p) {
    return {-p[0], p[1], p[2]};
}

// How much a point of the body at rest goes with each joint; `p` on the joint's own side, its x counted outwards.
double along_arm(const Point& p) {
    return (p - shoulder).dot(arm_axis);
}
double along_leg(const Point& p) {
    return (p - hip).dot(ankle - hip) / (ankle - hip).norm();
}

double arm_share(const Point& p) {
    const double t = along_arm(p), away = (p - shoulder - t * arm_axis).norm(), far = std::max(t, 0.0);
    return smooth_step(-0.055, 0.095, t) * (1 - smooth_step(0.056, 0.098 + 0.22 * far, away));
}
double collar_share(const Point& p, double arm) {
    const double trunk = smooth_step(0.02, 0.16, p[0]) * smooth_step(1.30, 1.43, p[1]) *
                         (1 - smooth_step(1.44, 1.52, p[1] - 0.3 * p[0]));
    return 1 - (1 - arm) * (1 - trunk);
}
double leg_share(const Point& p, double arm) {
    // From the crotch up to the hips, without a crease in the middle.
    const double fold = 0.80 + 1.1 * (std::min(std::hypot(p[0], 0.05), 0.21) - 0.05);
    return (1 - smooth_step(fold - 0.10, fold + 0.09, p[1])) * smooth_step(-0.03, 0.03, p[0]) * (1 - arm);
}

// The share of each joint along the spine, for a point at this height; arms hang from the chest whatever their height.
double spine_share(const Point& p, double arm, double from, double to) {
    return smooth_step(from, to, blend(p[1], shoulder[1], arm));
}
double neck_share(const Point& p) {
    return smooth_step(1.415, 1.515, p[1] - 0.6 * std::max(std::abs(p[0]) - 0.05, 0.0));
}
double head_share(const Point& p) {
    return smooth_step(1.525, 1.615, p[1]);
}

Point built_half(const Point& p, const FigureBuild& b) { // p[0] counted outwards
    const double arm = arm_share(p), trunk = 1 - arm, leg = 1 - smooth_step(0.70, 0.88, p[1]);
    const auto girth = [&](double y) {
        return (b.chest - 1) * bell(y, 1.27, 0.10) + (b.waist - 1) * bell(y, 1.10, 0.09) +
               (b.hips - 1) * bell(y, 0.90, 0.11);
    };
    const auto breadth = [&](double y) { return girth(y) + (b.shoulders - 1) * bell(y, 1.42, 0.10); };
    Point d(0, 0, 0);
    d[0] += blend(p[0] * breadth(p[1]), shoulder[0] * breadth(shoulder[1]), arm);
    d[2] += trunk * p[2] * girth(p[1]);
    // Limbs: thickness about their axis, then length along it.
    const double t = along_arm(p);
    const double hand = smooth_step(0.46, 0.58, t);
    d += arm * (b.arms - 1) * (1 - 0.6 * hand) * (p - shoulder - t * arm_axis);
    d += arm * (b.arm_length - 1) * std::max(t, 0.0) * arm_axis;
    const double l = along_leg(p), foot = 1 - smooth_step(0.03, 0.14, p[1]);
    const double inner = smooth_step(0, 0.06, p[0]); // both sides meet at x = 0
    const Point leg_axis = (ankle - hip).normalized();
    d += inner * trunk * leg * (b.legs - 1) * (1 - foot) * (p - hip - l * leg_axis);
    d[1] += (b.leg_length - 1) * blend(smooth_min(p[1], 0.80, 0.2), 0.80, arm);
    // Neck, head and jaw.
    const double nape = bell(p[1], 1.50, 0.05) * (1 - smooth_step(0.06, 0.14, p[0])), jaw = bell(p[1], 1.55, 0.035);
    d += nape * (b.neck - 1) * Point(p[0], 0, p[2] + 0.015);
    d += smooth_step(1.50, 1.60, p[1]) * (b.head - 1) * (p - Point(0, 1.56, 0));
    d += jaw * (b.jaw - 1) * Point(p[0], 0, 0.3 * (p[2] - 0.02));
    // Bulges.
    const auto bulge = [&](const Point& middle, double reach) {
        return trunk * std::exp(-(p - middle).squaredNorm() / (reach * reach));
    };
    d += b.bust * bulge({0.070, 1.275, 0.095}, 0.062) * Point(0.15 * inner, -0.12, 1);
    d += b.belly * (bulge({0.04, 1.03, 0.09}, 0.09)) * Point(0, -0.1, 1);
    d += b.seat * bulge({0.075, 0.895, -0.12}, 0.085) * Point(0.1 * inner, 0, -1);
    return b.height * (p + d);
}

Point built(const Point& p, const FigureBuild& b) {
    return p[0] < 0 ? mirrored(built_half(mirrored(p), b)) : built_half(p, b);
}

struct Joint {
    Point centre{0, 0, 0};
    Eigen::AngleAxisd turn;
    // On the straight way, not the arc: for the shoulders, about which the armpits would swing out.
    Point drawn(const Point& p, double share) const { return blend(p, turned(p, 1), share); }
    Point turned(const Point& p, double share) const {
        const Eigen::AngleAxisd part(share * turn.angle(), turn.axis());
        return centre + (part * Eigen::Vector3d((p - centre).transpose())).transpose();
    }
};

Eigen::AngleAxisd about(const Point& axis, double degrees) {
    return {radians(degrees), Eigen::Vector3d(axis.transpose().normalized())};
}

const Point across(1, 0, 0), up(0, 1, 0), ahead(0, 0, 1);

// The joints of one side, in its own coordinates (x outwards), from the tips inwards.
struct Side {
    Joint wrist, elbow, shoulder, collar, ankle, knee, hip;

    Side(const FigureBuild& b, const ArmPose& a, const LegPose& l) {
        const Point hinge = arm_axis.cross(ahead), palm = on_arm(0, 1, 0) - on_arm(0, 0, 0);
        wrist = {built(on_arm(figure_rest::wrist, 0, 0), b), about(arm_axis.cross(palm), a.wrist)};
        elbow = {built(on_arm(figure_rest::elbow, 0, 0), b), about(hinge, a.elbow)};
        const double rise = a.raise - 45, lifted = 0.3 * rise;
        shoulder = {
            built(figure_rest::shoulder, b),
            Eigen::AngleAxisd(about(across, -a.swing) * about(ahead, rise - lifted) * about(arm_axis, a.twist))};
        collar = {built({0.03, 1.41, -0.03}, b), about(ahead, lifted)};
        ankle = {built(figure_rest::ankle, b), about(across, -l.ankle)};
        knee = {built(figure_rest::hip + figure_rest::knee * (figure_rest::ankle - figure_rest::hip).normalized(), b),
                about(across, l.knee)};
        hip = {built(figure_rest::hip, b), Eigen::AngleAxisd(about(across, -l.swing) * about(ahead, l.spread))};
    }

    // `rest` tells the shares, `p` is moved.
    Point moved(const Point& rest, Point p, double arm) const {
        const double t = along_arm(rest), leg = leg_share(rest, arm);
        if (arm > 0) {
            p = wrist.turned(p, arm * smooth_step(figure_rest::wrist - 0.04, figure_rest::wrist + 0.04, t));
            p = elbow.turned(p, arm * smooth_step(figure_rest::elbow - 0.07, figure_rest::elbow + 0.07, t));
            p = shoulder.drawn(p, arm);
        }
        if (rest[0] > 0) p = collar.turned(p, collar_share(rest, arm));
        if (leg > 0) {
            p = ankle.turned(p, leg * (1 - smooth_step(0.04, 0.13, rest[1])));
            p = knee.turned(p, leg * smooth_step(figure_rest::knee - 0.08, figure_rest::knee + 0.08, along_leg(rest)));
            p = hip.turned(p, leg);
        }
        return p;
    }
};

class Posed {
public:
    Posed(const FigureBuild& build, const FigurePose& pose)
        : build_(build), left_(build, pose.left_arm, pose.left_leg), right_(build, pose.right_arm, pose.right_leg) {
        const auto part = [&](double share) {
            return Eigen::AngleAxisd(about(up, share * pose.spine_turn) * about(ahead, -share * pose.spine_side) *
                                     about(across, share * pose.spine));
        };
        lower_ = {built({0, 1.02, -0.02}, build), part(0.35)};
        middle_ = {built({0, 1.16, -0.02}, build), part(0.35)};
        upper_ = {built({0, 1.30, -0.03}, build), part(0.30)};
        neck_ = {built({0, 1.46, -0.03}, build),
                 Eigen::AngleAxisd(about(up, 0.4 * pose.head_turn) * about(across, 0.5 * pose.neck))};
        head_ = {built({0, 1.57, -0.01}, build),
                 Eigen::AngleAxisd(about(up, 0.6 * pose.head_turn) * about(across, 0.5 * pose.neck))};
        pelvis_ = {built({0, hip[1], hip[2]}, build), about(across, pose.pelvis)};
        const Point before = built(ankle, build), left = moved(ankle), right = moved(mirrored(ankle));
        const Point after = (left + right) / 2;
        step_ = Point(-after[0], before[1] - std::min(left[1], right[1]), before[2] - after[2]);
    }

    Point operator()(const Point& rest) const { return moved(rest) + step_; }

private:
    Point moved(const Point& rest) const {
        const Point other = mirrored(rest);
        const double left_arm = arm_share(rest), right_arm = arm_share(other), arm = left_arm + right_arm;
        Point p = left_.moved(rest, built(rest, build_), left_arm);
        p = mirrored(right_.moved(other, mirrored(p), right_arm));
        p = head_.turned(p, head_share(rest) * (1 - arm));
        p = neck_.turned(p, neck_share(rest) * (1 - arm));
        p = upper_.turned(p, spine_share(rest, arm, 1.20, 1.40));
        p = middle_.turned(p, spine_share(rest, arm, 1.05, 1.27));
        p = lower_.turned(p, spine_share(rest, arm, 0.91, 1.13));
        return pelvis_.turned(p, 1);
    }

    FigureBuild build_;
    Side left_, right_;
    Joint lower_, middle_, upper_, neck_, head_, pelvis_;
    Point step_{0, 0, 0};
};

} // namespace

FigurePose mix(const FigurePose& from, const FigurePose& to, double u) {
    const auto arm = [&](const ArmPose& a, const ArmPose& b) {
        return ArmPose{blend(a.raise, b.raise, u), blend(a.swing, b.swing, u), blend(a.twist, b.twist, u),
                       blend(a.elbow, b.elbow, u), blend(a.wrist, b.wrist, u)};
    };
    const auto leg = [&](const LegPose& a, const LegPose& b) {
        return LegPose{blend(a.spread, b.spread, u), blend(a.swing, b.swing, u), blend(a.knee, b.knee, u),
                       blend(a.ankle, b.ankle, u)};
    };
    return {blend(from.pelvis, to.pelvis, u),
            blend(from.spine, to.spine, u),
            blend(from.neck, to.neck, u),
            blend(from.spine_side, to.spine_side, u),
            blend(from.spine_turn, to.spine_turn, u),
            blend(from.head_turn, to.head_turn, u),
            arm(from.left_arm, to.left_arm),
            arm(from.right_arm, to.right_arm),
            leg(from.left_leg, to.left_leg),
            leg(from.right_leg, to.right_leg)};
}

Points figure(const Points& rest, const FigureBuild& build, const FigurePose& pose) {
    const Posed posed(build, pose);
    Points points(rest.rows(), 3);
    parallel_for(rest.rows(), [&](Eigen::Index i) { points.row(i) = posed(rest.row(i)); });
    return points;
}

} // namespace meshtween
