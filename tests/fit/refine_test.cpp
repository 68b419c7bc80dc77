#include "meshtween/fit/refine.h"

#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

using namespace meshtween;

namespace {

struct Ball {
    Mesh mesh = sphere(4);
    ShellLevels shells = shell_levels(mesh.positions, mesh.triangles);
    const Points& coarse() const { return shells.levels[1].positions; }
};

TEST(RefinePositions, ASimilarityIsCarriedOn) {
    const Ball ball;
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    const auto moved = [&](const Points& x, double scale) {
        return Points((scale * x * turn.transpose()).rowwise() + Point(1, 2, 3));
    };
    for (const double crushed : {0.0, 0.2}) {
        const Points scaled = refine_positions(ball.shells, 1, moved(ball.coarse(), 1.5), true, crushed);
        EXPECT_LT((scaled - moved(ball.mesh.positions, 1.5)).cwiseAbs().maxCoeff(), 1e-12);
        const Points turned = refine_positions(ball.shells, 1, moved(ball.coarse(), 1), false, crushed);
        EXPECT_LT((turned - moved(ball.mesh.positions, 1)).cwiseAbs().maxCoeff(), 1e-12);
    }
}

// The northern half shrunk to a speck on the plane through the middle.
Points speck(Points x) {
    for (Eigen::Index i = 0; i < x.rows(); ++i)
        if (x(i, 2) > 0) x.row(i) = Point(1e-3 * x(i, 0), 1e-3 * x(i, 1), 0);
    return x;
}

// How far from the middle what is north of `from` comes to lie.
double farthest(const Points& rest, const Points& x, double from) {
    double most = 0;
    for (Eigen::Index i = 0; i < x.rows(); ++i)
        if (rest(i, 2) > from) most = std::max(most, x.row(i).norm());
    return most;
}

TEST(RefinePositions, OnCrushedTrianglesNothingIsCarriedBeyondThem) {
    const Ball ball;
    const Points flat = speck(ball.coarse());
    const Points guarded = refine_positions(ball.shells, 1, flat, false, 0.2);
    const Points free = refine_positions(ball.shells, 1, flat, false);
    EXPECT_LT(farthest(ball.mesh.positions, guarded, 0.5), 2e-3);
    EXPECT_GT(farthest(ball.mesh.positions, free, 0.5), 1e-2);
    for (Eigen::Index i = 0; i < free.rows(); ++i) // elsewhere it makes no difference
        if (ball.mesh.positions(i, 2) < -0.5) {
            EXPECT_EQ(guarded.row(i), free.row(i));
        }
}

} // namespace
