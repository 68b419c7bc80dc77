#include "meshtween/fit/cut_guard.h"

#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

using namespace meshtween;

namespace {

TEST(CutGuard, AMoveThatCutsGoesBackAndTheOthersStay) {
    const Mesh mesh = sphere(3);
    const Shell rest = shell(mesh.positions, mesh.triangles);
    const FitTarget target = fit_target(mesh.positions, mesh.triangles);
    TangleSearch search{rest, target, {}};
    const int far = mesh.triangles(0, 0), near = mesh.triangles(mesh.triangles.rows() / 3, 0),
              cut = mesh.triangles(mesh.triangles.rows() - 1, 0);
    Points from = mesh.positions;
    from.row(cut) *= -1.1; // a spike all through the ball, before and after
    Points to = from;
    to.row(far) *= -1.2; // another
    to.row(near) *= 1.01;
    const Cuts before = cuts_of(search, from);
    ASSERT_FALSE(before.all.empty());
    ASSERT_GT(cuts_of(search, to).all.size(), before.all.size());
    const Cuts after = take_back_cuts(search, {{far}, {near}}, from, before, to);
    EXPECT_EQ(to.row(far), from.row(far));
    EXPECT_NE(to.row(near), from.row(near));
    EXPECT_EQ(after.all, cuts_of(search, to).all);
    EXPECT_EQ(after.fresh, cuts_of(search, to).fresh);
}

TEST(CutGuard, AMoveThatEndsCutsIsKept) {
    const Mesh mesh = sphere(3);
    const Shell rest = shell(mesh.positions, mesh.triangles);
    const FitTarget target = fit_target(mesh.positions, mesh.triangles);
    TangleSearch search{rest, target, {}};
    const int spike = mesh.triangles(0, 0);
    Points from = mesh.positions, to = mesh.positions;
    from.row(spike) *= -1.1;
    const Cuts after = take_back_cuts(search, {{spike}}, from, cuts_of(search, from), to);
    EXPECT_EQ(to, mesh.positions);
    EXPECT_TRUE(after.all.empty());
}

} // namespace
