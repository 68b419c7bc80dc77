// The rigid motion between two shapes, taken out before a morph and put back in steps.
#pragma once

#include "meshtween/core/mesh.h"

namespace meshtween {

// Takes `from` to where it fits `to` best: x -> rotation (x - from_centre) + to_centre, x as a column.
struct RigidMotion {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Point from_centre{0, 0, 0}, to_centre{0, 0, 0};
};

// Least squares over corresponding rows (Kabsch 1976), a weight a row, or none for equal ones. The motion back is the
// inverse of the motion there, unless the best one is not unique.
RigidMotion best_rigid_motion(const Points& from, const Points& to, const Eigen::VectorXd& weights = {});

// Both shapes about the origin, the second turned back: what remains between them is no rigid motion.
Points centred_from(const RigidMotion& motion, const Points& from);
Points centred_to(const RigidMotion& motion, const Points& to);

// Places a centred shape where it belongs at u: turned by u times the motion's angle about its axis, its centre on the
// straight line between the centres. At 0 centred_from comes back to `from`, at 1 centred_to to `to`.
Points placed(const RigidMotion& motion, const Points& centred, double u);

} // namespace meshtween
