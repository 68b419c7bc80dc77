#include "meshtween/fit/nudge.h"

#include "meshtween/fit/settle.h"
#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

using namespace meshtween;

namespace {

const FitTarget& ball() {
    static const Mesh mesh = sphere(4);
    static const FitTarget target = fit_target(mesh.positions / 2, mesh.triangles);
    return target;
}

// On the ball, with one vertex drawn over an edge of its ring.
struct Folded {
    Mesh mesh = sphere(2);
    Shell rest;
    int vertex = 0;

    Folded() {
        mesh.positions /= 2;
        rest = shell(mesh.positions, mesh.triangles);
        vertex = mesh.triangles(0, 0);
        const Point middle = (mesh.positions.row(mesh.triangles(0, 1)) + mesh.positions.row(mesh.triangles(0, 2))) / 2;
        const Point across = middle + 0.1 * (middle - Point(mesh.positions.row(vertex)));
        mesh.positions.row(vertex) = ball().index.closest(across).position;
    }
};

TEST(Nudge, TurnsWhatIsTurnedOverAndLeavesTheRest) {
    Folded folded;
    TangleSearch search{folded.rest, ball(), {}};
    const Tangles before = tangles(search, folded.mesh.positions);
    ASSERT_FALSE(before.flips.empty());
    const Nudged done = nudge(search, folded.mesh.positions, before);
    EXPECT_LT(done.left.flips.size(), before.flips.size());
    EXPECT_LE(done.left.cuts.size(), before.cuts.size());
    EXPECT_EQ(done.left.flips, flipped_triangles(done.positions, folded.mesh.triangles, ball()));
    for (Eigen::Index i = 0; i < done.positions.rows(); ++i) {
        bool near = false;
        for (const int t : before.flips) near = near || (folded.mesh.triangles.row(t).array() == i).any();
        for (const int t : done.left.flips) near = near || (folded.mesh.triangles.row(t).array() == i).any();
        if (!near) {
            EXPECT_EQ(done.positions.row(i), folded.mesh.positions.row(i)) << i;
        }
        EXPECT_LT(ball().index.closest(Point(done.positions.row(i))).squared_distance, 1e-4) << "on the target";
    }
}

TEST(Nudge, WithoutFlipsNothingMoves) {
    const Mesh mesh = sphere(2);
    const Points on_ball = mesh.positions / 2;
    const Shell rest = shell(on_ball, mesh.triangles);
    TangleSearch search{rest, ball(), {}};
    EXPECT_EQ(nudge(search, on_ball, tangles(search, on_ball)).positions, on_ball);
}

} // namespace
