#include "meshtween/morph/rigid_motion.h"

#include "support/posed.h"

#include <gtest/gtest.h>

namespace meshtween {
namespace {

const Eigen::Vector3d axis(1, 2, 0.5);

TEST(RigidMotion, FindsTheTurnAndComesBack) {
    const Points from = test::shaken(test::bar(6, 3).positions, 0.3);
    for (const double angle : {0.0, 0.3, 2.0, 3.1}) {
        const Points to = test::turned(from, angle, axis, {5, -3, 2});
        const RigidMotion motion = best_rigid_motion(from, to);
        EXPECT_LT(test::distance(centred_from(motion, from), centred_to(motion, to)), 1e-12);
        EXPECT_LT(test::distance(placed(motion, centred_from(motion, from), 0), from), 1e-12);
        EXPECT_LT(test::distance(placed(motion, centred_to(motion, to), 1), to), 1e-12);
        EXPECT_NEAR(motion.rotation.determinant(), 1, 1e-12);
    }
}

TEST(RigidMotion, NeverMirrors) {
    const Points from = test::shaken(test::bar(6, 3).positions, 0.3);
    Points mirrored = from;
    mirrored.col(0) *= -1;
    EXPECT_NEAR(best_rigid_motion(from, mirrored).rotation.determinant(), 1, 1e-12);
}

TEST(RigidMotion, FlatAndSinglePoints) {
    Points flat = test::bar(6, 3).positions;
    flat.col(2).setZero();
    const RigidMotion motion = best_rigid_motion(flat, test::turned(flat, 1, axis));
    EXPECT_LT(test::distance(placed(motion, flat.rowwise() - motion.from_centre, 1), test::turned(flat, 1, axis)),
              1e-12);
    const Points one = Points::Constant(1, 3, 2);
    EXPECT_TRUE(best_rigid_motion(one, one).rotation.allFinite());
}

TEST(RigidMotion, WeightsSayWhatCounts) {
    const Points from = test::bar(6, 3).positions;
    Points to = test::turned(from, 1, axis);
    to.row(0) += Point(50, 0, 0);
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(from.rows());
    weights[0] = 0;
    const RigidMotion motion = best_rigid_motion(from, to, weights);
    EXPECT_LT((centred_from(motion, from) - centred_to(motion, to)).bottomRows(from.rows() - 1).norm(), 1e-12);
}

} // namespace
} // namespace meshtween
