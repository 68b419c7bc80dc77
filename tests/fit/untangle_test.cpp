#include "meshtween/fit/untangle.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace meshtween;

namespace {

struct Ball {
    Mesh mesh = sphere(4);
    Shell shell;
    FitTarget target;
    Ball() : target(make()) { shell = meshtween::shell(mesh.positions, mesh.triangles); }
    FitTarget make() {
        mesh.positions /= diagonal(mesh);
        const Mesh finer = sphere(5);
        return fit_target(finer.positions / diagonal(finer), finer.triangles);
    }
    TangleSearch search() const { return {shell, target, {}}; }
};

// What lies around the north pole slid to one side until it lies over its surroundings, in three layers.
Points folded_over(const Points& positions, double how_far, double wide = 0.5) {
    Points x = positions;
    const double radius = positions.row(0).norm();
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        const double angle = std::acos(std::clamp(x(i, 2) / radius, -1.0, 1.0));
        const double share = std::max(0.0, 1 - angle / wide);
        Point moved = x.row(i);
        moved[0] += how_far * radius * share;
        x.row(i) = moved.normalized() * radius;
    }
    return x;
}

TEST(Untangle, ACleanMeshComesBackBitForBit) {
    const Ball ball;
    TangleSearch search = ball.search();
    const Untangled result = untangle(search, ball.mesh.positions, tangles(search, ball.mesh.positions), {});
    EXPECT_EQ(result.positions, ball.mesh.positions);
    EXPECT_EQ(result.left.count(), 0u);
    EXPECT_EQ(result.patches, 0);
    EXPECT_EQ(held_back(search, ball.mesh.positions, folded_over(ball.mesh.positions, 0.1)),
              folded_over(ball.mesh.positions, 0.1));
}

TEST(Untangle, AFoldIsUndoneAndTheRestIsHeld) {
    const Ball ball;
    TangleSearch search = ball.search();
    const Points folded = folded_over(ball.mesh.positions, 1.0);
    const Tangles before = tangles(search, folded);
    EXPECT_GT(before.flips.size(), 10u);
    EXPECT_GT(before.cuts.size(), 10u);
    const Untangled result = untangle(search, folded, before, {});
    EXPECT_EQ(result.left.count(), 0u);
    EXPECT_GE(result.patches, 1);
    const double radius = ball.mesh.positions.row(0).norm();
    for (Eigen::Index i = 0; i < folded.rows(); ++i) {
        EXPECT_NEAR(result.positions.row(i).norm(), radius, 0.01 * radius); // on the ball
        if (folded(i, 2) < -0.5 * radius) {
            EXPECT_EQ(result.positions.row(i), folded.row(i));
        }
    }
    EXPECT_EQ(tangles(search, result.positions).count(), 0u);
}

// A ball with a tail of rings of three vertices, drawn out of a triangle at the north pole to the ball's radius.
struct TailedBall : Ball {
    Mesh tailed;
    Eigen::Index first = mesh.positions.rows(); // of the tail's vertices
    double radius = mesh.positions.row(0).norm();
    Shell tailed_shell;

    explicit TailedBall(int rings) {
        Eigen::Index base = 0;
        const auto height = [&](int k) { return mesh.positions.col(2)(mesh.triangles.col(k)); };
        (height(0) + height(1) + height(2)).maxCoeff(&base);
        tailed = mesh;
        tailed.positions.conservativeResize(first + 3 * rings, 3);
        tailed.triangles.conservativeResize(mesh.triangles.rows() + 6 * rings, 3);
        const Eigen::RowVector3i root = mesh.triangles.row(base);
        Eigen::RowVector3i below = root;
        for (int ring = 0; ring < rings; ++ring) {
            const auto start = static_cast<int>(first) + 3 * ring;
            const Eigen::RowVector3i above(start, start + 1, start + 2);
            for (int k = 0, t = static_cast<int>(mesh.triangles.rows()) + 6 * ring; k < 3; ++k, t += 2) {
                const int next = (k + 1) % 3;
                tailed.positions.row(above[k]) = mesh.positions.row(root[k]) + Point(0, 0, radius * (ring + 1) / rings);
                tailed.triangles.row(t) << below[k], below[next], above[next];
                tailed.triangles.row(t + 1) << below[k], above[next], above[k];
            }
            below = above;
        }
        tailed.triangles.row(base) = below;
        tailed_shell = meshtween::shell(tailed.positions, tailed.triangles);
    }

    // The tail shrunk to a fiftieth of its length and wound.
    Points shrunk(double wound) const {
        Points x = tailed.positions;
        for (Eigen::Index i = first; i < x.rows(); ++i) {
            const double share = (x(i, 2) - radius) / radius; // of the length
            x(i, 2) = radius * (1 + 0.02 * share);
            x.row(i) += wound * radius * Point(std::sin(51 * share), std::sin(39 * share), std::sin(30 * share));
        }
        return x;
    }

    std::size_t left_of(const Points& positions) const {
        TangleSearch search{tailed_shell, target, {}};
        return untangle(search, positions, tangles(search, positions), {}).left.count();
    }
};

TEST(Untangle, ATailThatTheTargetHasNotIsLaidOut) {
    const TailedBall ball(20);
    const Points shrunk = ball.shrunk(0);
    TangleSearch search{ball.tailed_shell, ball.target, {}};
    ASSERT_GT(tangles(search, shrunk).flips.size(), 70U); // its walls
    EXPECT_EQ(ball.left_of(shrunk), 0U);
}

// No patch of it as it lies comes undone.
TEST(Untangle, ACrumpledTailIsLaidFlat) {
    const TailedBall ball(60);
    const Points crumpled = ball.shrunk(0.1);
    TangleSearch search{ball.tailed_shell, ball.target, {}};
    ASSERT_GT(tangles(search, crumpled).cuts.size(), 500U);
    EXPECT_EQ(ball.left_of(crumpled), 0U);
}

TEST(Untangle, TheSameBitsForAnyNumberOfThreads) {
    const Ball ball;
    const Points folded = folded_over(ball.mesh.positions, 1.0);
    TangleSearch one = ball.search(), two = ball.search();
    set_threads(1);
    const Points alone = untangle(one, folded, tangles(one, folded), {}).positions;
    set_threads(3);
    EXPECT_EQ(untangle(two, folded, tangles(two, folded), {}).positions, alone);
    set_threads(0);
}

TEST(Untangle, WhatCannotBeMendedIsToldAndLeftAsItIs) {
    // A strip without inner vertices, which crosses itself: none of it may move.
    Mesh strip;
    strip.positions.resize(8, 3);
    strip.positions << 0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 1, 0.3, 0.5, 1, 0.6, 0.5, 0.5, 0.3, -0.5, 0.5, 0.6, -0.5;
    strip.triangles.resize(6, 3);
    strip.triangles << 0, 2, 1, 1, 2, 3, 2, 4, 3, 3, 4, 5, 4, 6, 5, 5, 6, 7;
    Points flat = strip.positions;
    for (Eigen::Index i = 0; i < 8; ++i) { // not cut at rest
        const Eigen::Index across = i % 2, along = i / 2;
        flat.row(i) = Eigen::RowVector<Eigen::Index, 3>(along, across, 0).cast<double>();
    }
    const Shell rest = shell(flat / diagonal(flat), strip.triangles);
    const Mesh ball = sphere(3);
    const FitTarget target = fit_target(ball.positions, ball.triangles);
    TangleSearch search{rest, target, {}};
    const Untangled result = untangle(search, strip.positions, tangles(search, strip.positions), {});
    EXPECT_FALSE(result.left.cuts.empty());
    EXPECT_EQ(result.left.cuts, tangles(search, strip.positions).cuts);
    EXPECT_EQ(result.positions, strip.positions);
    EXPECT_EQ(result.patches, 0);
}

TEST(Untangle, CutsOfTheShapesThemselvesAreNoFault) {
    const Ball ball;
    const Points folded = folded_over(ball.mesh.positions, 1.0);
    const Shell own = shell(folded, ball.mesh.triangles); // the source is folded: so may be the fit
    TangleSearch in_source{own, ball.target, {}};
    EXPECT_TRUE(tangles(in_source, folded).cuts.empty());
    const FitTarget target = fit_target(folded, ball.mesh.triangles); // or the target
    TangleSearch in_target{ball.shell, target, {}};
    EXPECT_TRUE(tangles(in_target, folded).cuts.empty());
}

TEST(Untangle, ProgressIsToldAndCancellingIsAResult) {
    const Ball ball;
    TangleSearch search = ball.search();
    const Points folded = folded_over(ball.mesh.positions, 1.0);
    std::string stage;
    const Untangled result = untangle(search, folded, tangles(search, folded), {}, [&](double, std::string_view name) {
        stage = name;
        return false;
    });
    EXPECT_TRUE(result.cancelled);
    EXPECT_EQ(stage, "untangling");
    EXPECT_EQ(result.positions, folded);
    EXPECT_EQ(result.left.count(), tangles(search, folded).count());
}

TEST(HeldBack, OnlyWhatWouldFoldWaits) {
    const Ball ball;
    TangleSearch search = ball.search();
    const Points before = ball.mesh.positions, now = folded_over(before, 1.0) * 1.01;
    const Points result = held_back(search, before, now);
    EXPECT_TRUE(new_cuts(search, result).empty());
    EXPECT_FALSE(new_cuts(search, now).empty());
    for (Eigen::Index i = 0; i < before.rows(); ++i)
        if (before(i, 2) < 0) {
            EXPECT_EQ(result.row(i), now.row(i));
        }
}

TEST(HeldBack, WhatWasCutAlreadyGoesOn) {
    const Ball ball;
    TangleSearch search = ball.search();
    const Points before = folded_over(ball.mesh.positions, 1.0), now = before * 1.01;
    EXPECT_EQ(held_back(search, before, now), now);
}

TEST(Eased, ASmallFoldGoesAndTheRestStays) {
    const Ball ball;
    TangleSearch search = ball.search();
    EXPECT_EQ(eased(search, ball.mesh.positions), ball.mesh.positions);
    const Points x = folded_over(ball.mesh.positions, 0.3, 0.2);
    ASSERT_FALSE(new_cuts(search, x).empty());
    const Points result = eased(search, x);
    EXPECT_TRUE(new_cuts(search, result).empty());
    for (Eigen::Index i = 0; i < x.rows(); ++i)
        if (x(i, 2) < 0) {
            EXPECT_EQ(result.row(i), x.row(i));
        }
}

TEST(Tangles, TheChosenAloneFindWhatAllDo) {
    const Ball ball;
    TangleSearch search = ball.search();
    const Points folded = folded_over(ball.mesh.positions, 1.0);
    const auto all = new_cuts(search, folded);
    ASSERT_FALSE(all.empty());
    std::vector<char> chosen(static_cast<std::size_t>(ball.mesh.triangles.rows()), 0);
    for (const auto& pair : all) chosen[static_cast<std::size_t>(pair[0])] = 1;
    EXPECT_EQ(new_cuts(search, folded, chosen), all);
    const Tangles none = tangles(search, ball.mesh.positions);
    const Tangles after = tangles(search, folded, none, chosen);
    EXPECT_EQ(after.cuts, all);
    const std::vector<char> every(chosen.size(), 1);
    EXPECT_EQ(tangles(search, folded, none, every).flips, tangles(search, folded).flips);
}

TEST(Tangles, NewCutsBesideKnownOnesAreTakenBack) {
    const Ball ball;
    TangleSearch search = ball.search();
    const Points folded = folded_over(ball.mesh.positions, 1.0);
    const Tangles none;
    EXPECT_EQ(without_new_cuts(search, ball.mesh.positions, none, folded), folded) << "no known cuts";
    const auto cuts = new_cuts(search, folded);
    ASSERT_GT(cuts.size(), 10U);
    search.known->source = {cuts.front()};
    std::vector<char> chosen(static_cast<std::size_t>(ball.mesh.triangles.rows()), 0);
    for (const int t : cuts.front()) chosen[static_cast<std::size_t>(t)] = 1;
    EXPECT_FALSE(new_cuts(search, folded, chosen).empty());
    const Points result = without_new_cuts(search, ball.mesh.positions, none, folded);
    EXPECT_TRUE(new_cuts(search, result, chosen).empty());
    EXPECT_NE(result, ball.mesh.positions) << "the rest moves on";
    const Tangles left{{}, new_cuts(search, folded)};
    EXPECT_EQ(without_new_cuts(search, ball.mesh.positions, left, folded), folded) << "cut before";
}

} // namespace
