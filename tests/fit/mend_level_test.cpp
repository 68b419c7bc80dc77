#include "meshtween/fit/mend_level.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace meshtween;

namespace {

struct Ball {
    Mesh mesh = sphere(3);
    Shell rest = shell(mesh.positions, mesh.triangles);
    FitTarget target = make();

    // What lies around a pole slid to one side until it lies over its surroundings.
    Points folded(double how_far, double wide) const {
        Points x = mesh.positions;
        for (Eigen::Index i = 0; i < x.rows(); ++i) {
            const double share = std::max(0.0, 1 - std::acos(std::clamp(x(i, 2), -1.0, 1.0)) / wide);
            Point moved = x.row(i);
            moved[0] += how_far * share;
            x.row(i) = moved.normalized();
        }
        return x;
    }

private:
    static FitTarget make() {
        const Mesh finer = sphere(4);
        return fit_target(finer.positions, finer.triangles);
    }
};

TEST(MendLevel, WhereLittleIsCutNothingIsDoneUnlessAllIsAsked) {
    const Ball ball;
    TangleSearch search{ball.rest, ball.target, {}};
    EXPECT_FALSE(mended_level(search, ball.mesh.positions, {}, Mending::much));
    EXPECT_FALSE(mended_level(search, ball.mesh.positions, {}, Mending::all)) << "nothing to gain";
    Points dented = ball.mesh.positions;
    const int vertex = ball.mesh.triangles(0, 0);
    dented.row(vertex) = -1.2 * dented.row(vertex); // a spike all through the ball
    const std::size_t cuts = new_cuts(search, dented).size();
    ASSERT_GT(cuts, 0U);
    ASSERT_LT(50 * cuts, static_cast<std::size_t>(ball.mesh.triangles.rows()));
    EXPECT_FALSE(mended_level(search, dented, {}, Mending::much));
    EXPECT_TRUE(mended_level(search, dented, {}, Mending::all));
}

TEST(MendLevel, ACrumpleIsLaidOut) {
    const Ball ball;
    TangleSearch search{ball.rest, ball.target, {}};
    const Points folded = ball.folded(1.5, 1);
    const std::size_t cuts = new_cuts(search, folded).size();
    ASSERT_GT(50 * cuts, static_cast<std::size_t>(ball.mesh.triangles.rows()));
    const auto mended = mended_level(search, folded, {}, Mending::much);
    ASSERT_TRUE(mended);
    EXPECT_LT(4 * new_cuts(search, *mended).size(), cuts);
    EXPECT_NEAR(volume(*mended, ball.mesh.triangles), volume(ball.mesh.positions, ball.mesh.triangles), 0.1);
}

} // namespace
