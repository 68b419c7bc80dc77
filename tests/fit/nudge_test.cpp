#include "meshtween/fit/nudge.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/facing.h"
#include "meshtween/fit/settle.h"
#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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
    const Nudged done = nudge(search, folded.mesh.positions, before, {});
    EXPECT_TRUE(done.left.flips.empty());
    EXPECT_LE(done.left.cuts.size(), before.cuts.size());
    std::vector<char> near(static_cast<std::size_t>(done.positions.rows()), 0);
    for (const int t : before.flips)
        for (int k = 0; k < 3; ++k) near[static_cast<std::size_t>(folded.mesh.triangles(t, k))] = 1;
    constexpr int rings = 2; // beside a flip, then beside one that comes of it
    for (int ring = 0; ring < rings; ++ring) {
        std::vector<char> wider = near;
        for (Eigen::Index i = 0; i < done.positions.rows(); ++i)
            for (const int j : folded.rest.topology.neighbours[i])
                wider[static_cast<std::size_t>(i)] |= near[static_cast<std::size_t>(j)];
        near.swap(wider);
    }
    for (Eigen::Index i = 0; i < done.positions.rows(); ++i) {
        if (!near[static_cast<std::size_t>(i)]) {
            EXPECT_EQ(done.positions.row(i), folded.mesh.positions.row(i)) << i;
        }
        EXPECT_LT(ball().index.closest(Point(done.positions.row(i))).squared_distance, 1e-4) << "on the target";
    }
}

// A lens as thin as a fiftieth of its width, with its topmost vertex pressed through to the other side.
TEST(Nudge, TakesApartWhatCutsThoughNothingIsTurnedOver) {
    Mesh lens = sphere(3);
    lens.positions *= Eigen::Vector3d(0.5, 0.5, 0.01).asDiagonal();
    const FitTarget target = fit_target(lens.positions, lens.triangles);
    const Shell rest = shell(lens.positions, lens.triangles);
    TangleSearch search{rest, target, {}};
    Points x = lens.positions;
    Eigen::Index top = 0;
    x.col(2).maxCoeff(&top);
    x(top, 2) = -0.0105;
    const Tangles before = tangles(search, x);
    ASSERT_TRUE(before.flips.empty());
    ASSERT_FALSE(before.cuts.empty());
    set_threads(1);
    const Nudged done = nudge(search, x, before, {});
    set_threads(3);
    EXPECT_EQ(nudge(search, x, before, {}).positions, done.positions) << "both sides move, in any company";
    set_threads(0);
    EXPECT_EQ(done.left.count(), 0U);
    EXPECT_EQ(tangles(search, done.positions).count(), 0U);
}

TEST(Nudge, MarkersComeNoFurtherOff) {
    Folded folded;
    TangleSearch search{folded.rest, ball(), {}};
    const Tangles before = tangles(search, folded.mesh.positions);
    const Point held = folded.mesh.positions.row(folded.vertex);
    const Pin pin{{0, {1, 0, 0}}, {0, 0, 0}, held, 1, 0};
    EXPECT_NE(Point(nudge(search, folded.mesh.positions, before, {}).positions.row(folded.vertex)), held);
    EXPECT_EQ(Point(nudge(search, folded.mesh.positions, before, {&pin, 1}).positions.row(folded.vertex)), held);
}

// A bowl as thin as a hundredth of its width: flat triangles between points of one side reach beyond the other side.
Points bowl(const Points& ball) {
    Points x = ball / 2;
    x.col(2) = 0.01 * x.col(2) + x.leftCols(2).rowwise().squaredNorm();
    return x;
}

// A coarse one on a fine one.
struct Bowls {
    Mesh fine = sphere(5), mesh = sphere(2);
    FitTarget target = fit_target(bowl(fine.positions), fine.triangles);
    Points x = bowl(mesh.positions);
    Shell rest = shell(x, mesh.triangles);
};

TEST(Nudge, VerticesThatMayLeaveTheTargetTurnWhatSpansAThinSheet) {
    const Bowls bowls;
    const auto& [fine, mesh, target, x, rest] = bowls;
    TangleSearch search{rest, target, {}};
    const Tangles before = tangles(search, x);
    const Nudged on = nudge(search, x, before, {}), off = nudge(search, x, before, {}, true);
    EXPECT_GT(on.left.flips.size(), 100U);
    EXPECT_LT(off.left.flips.size(), 5U);
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        double longest = 0;
        for (const int j : rest.topology.neighbours[i])
            longest = std::max(longest, (off.positions.row(i) - off.positions.row(j)).norm());
        EXPECT_LE(std::sqrt(target.index.closest(Point(off.positions.row(i))).squared_distance), 0.2 * longest) << i;
    }
}

TEST(Nudge, StopsBetweenRoundsWithTheBestSoFar) {
    const Bowls bowls;
    const auto& [fine, mesh, target, x, rest] = bowls;
    TangleSearch search{rest, target, {}};
    const Tangles before = tangles(search, x);
    int asked = 0;
    const Nudged once = nudge(search, x, before, {}, true, {}, [&](double, std::string_view) { return ++asked < 2; });
    EXPECT_EQ(asked, 2);
    EXPECT_TRUE(once.cancelled);
    EXPECT_LT(once.left.flips.size(), before.flips.size());
    const Nudged never = nudge(search, x, before, {}, true, {}, [](double, std::string_view) { return false; });
    EXPECT_TRUE(never.cancelled);
    EXPECT_EQ(never.positions, x);
}

TEST(Nudge, WhereAFitHasFailedNothingMoves) {
    const Mesh mesh = sphere(5);
    Points x = mesh.positions / 2;
    for (Eigen::Index i = 0; i < x.rows(); i += 20) x.row(i) *= -1; // a vertex in twenty on the other side
    const Shell rest = shell(mesh.positions / 2, mesh.triangles);
    TangleSearch search{rest, ball(), {}};
    ASSERT_GT(facing_into(x, mesh.triangles, ball()).size(), 2000U);
    EXPECT_EQ(nudge(search, x, {}, {}).positions, x);
}

TEST(Nudge, WithoutFlipsNothingMoves) {
    const Mesh mesh = sphere(2);
    const Points on_ball = mesh.positions / 2;
    const Shell rest = shell(on_ball, mesh.triangles);
    TangleSearch search{rest, ball(), {}};
    EXPECT_EQ(nudge(search, on_ball, tangles(search, on_ball), {}).positions, on_ball);
}

} // namespace
