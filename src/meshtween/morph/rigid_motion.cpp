// Kabsch, A Solution for the Best Rotation to Relate Two Sets of Vectors, 1976.
#include "meshtween/morph/rigid_motion.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

namespace meshtween {

RigidMotion best_rigid_motion(const Points& from, const Points& to, const Eigen::VectorXd& weights) {
    RigidMotion motion;
    if (from.rows() == 0) return motion;
    Eigen::VectorXd w = weights.size() > 0 ? weights : Eigen::VectorXd::Ones(from.rows());
    w /= w.sum();
    motion.from_centre = w.transpose() * from;
    motion.to_centre = w.transpose() * to;
    const Points a = from.rowwise() - motion.from_centre, b = to.rowwise() - motion.to_centre;
    const Eigen::Matrix3d covariance = b.transpose() * w.asDiagonal() * a;
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d sign(1, 1, 1);
    if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) sign[2] = -1; // a turn, never a mirror
    motion.rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
    return motion;
}

Points centred_from(const RigidMotion& motion, const Points& from) {
    return from.rowwise() - motion.from_centre;
}

Points centred_to(const RigidMotion& motion, const Points& to) {
    return (to.rowwise() - motion.to_centre) * motion.rotation; // rows: times the transpose of the inverse
}

Points placed(const RigidMotion& motion, const Points& centred, double u) {
    const Eigen::AngleAxisd whole(motion.rotation);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(u * whole.angle(), whole.axis()).toRotationMatrix();
    const Point centre = (1 - u) * motion.from_centre + u * motion.to_centre;
    return (centred * turn.transpose()).rowwise() + centre;
}

} // namespace meshtween
