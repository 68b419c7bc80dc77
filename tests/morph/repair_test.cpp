#include "meshtween/morph/repair.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/search/self_intersections.h"
#include "support/posed.h"

#include <gtest/gtest.h>

namespace meshtween {
namespace {

// Two fingers side by side, of which the second changes sides on straight lines: right through the first.
struct Fingers {
    Mesh mesh;
    Points to;

    explicit Fingers(double lift = 0) {
        const Mesh finger = test::bar(16, 2);
        const Eigen::Index n = finger.positions.rows(), m = finger.triangles.rows();
        mesh.positions.resize(2 * n, 3);
        mesh.positions << finger.positions, finger.positions.rowwise() + Point(0.3, -5, lift);
        mesh.triangles.resize(2 * m, 3);
        mesh.triangles << finger.triangles, finger.triangles.array() + static_cast<int>(n);
        to = mesh.positions;
        to.bottomRows(n).rowwise() += Point(0, 10, 0);
    }
    Interpolant path() const { return interpolant(morph(mesh, to, {.method = MorphMethod::linear}), 1e-5); }
};

std::size_t cuts_along(const Interpolant& path, const Triangles& triangles, int frames) {
    std::size_t count = 0;
    for (int f = 1; f < frames; ++f)
        count += self_intersections(path.at(static_cast<double>(f) / frames), triangles).size();
    return count;
}

TEST(Repair, PartsGoAroundEachOther) {
    for (const double lift : {0.0, 1.0}) {
        const Fingers fingers(lift);
        const Interpolant before = fingers.path();
        ASSERT_GT(cuts_along(before, fingers.mesh.triangles, 20), 100u);
        const Repaired after = repaired(before, fingers.mesh.triangles);
        EXPECT_GT(after.report.cuts_before, 50u);
        EXPECT_EQ(after.report.cuts_after, 0u);
        EXPECT_EQ(after.report.left, 0);
        EXPECT_EQ(after.report.contacts, 1);
        EXPECT_EQ(cuts_along(after.path, fingers.mesh.triangles, 20), 0u); // at most of these none was looked at
        EXPECT_LT(after.report.moved, RepairOptions{}.reach);
    }
}

TEST(Repair, EndsAndTheVelocitiesThereStay) {
    const Fingers fingers;
    const Interpolant before = fingers.path(), after = repaired(before, fingers.mesh.triangles).path;
    EXPECT_EQ(after.at(0), before.at(0));
    EXPECT_EQ(after.at(1), before.at(1));
    for (const double u : {1e-4, 1 - 1e-4})
        EXPECT_LT(test::distance(after.at(u), before.at(u)), 1e-5 * diagonal(fingers.to)) << u;
}

TEST(Repair, TurningOnTheWayChangesNothing) {
    const Fingers fingers(0.37); // and 8 frames: no face lies exactly in another's plane, where rounding decides
    const RepairOptions options{.frames = 8};
    const Eigen::Vector3d axis(1, 2, 0.5);
    Morph turning;
    turning.at = [&, path = fingers.path()](double u) { return test::turned(path.at(u), 2 * u, axis, {3 * u, 0, 0}); };
    const Repaired one = repaired(fingers.path(), fingers.mesh.triangles, options);
    const Repaired other = repaired(interpolant(turning, 1e-7), fingers.mesh.triangles, options);
    ASSERT_EQ(one.report.cuts_after, 0u);
    EXPECT_EQ(other.report.cuts_after, 0u);
    for (const double u : {0.3, 0.5}) {
        const Points wanted = test::turned(one.path.at(u), 2 * u, axis, {3 * u, 0, 0});
        EXPECT_LT(test::distance(other.path.at(u), wanted), 1e-3 * diagonal(fingers.to)) << u;
    }
}

TEST(Repair, WhatDoesNotCutStays) {
    const Fingers fingers(3);
    const Interpolant before = fingers.path();
    const Repaired after = repaired(before, fingers.mesh.triangles);
    EXPECT_EQ(after.report.cuts_before, 0u);
    EXPECT_EQ(after.report.trials, 0);
    EXPECT_EQ(after.path.nodes, before.nodes);
}

TEST(Repair, SaysWhatIsLeft) {
    const Fingers fingers;
    const Repaired counted = repaired(fingers.path(), fingers.mesh.triangles, {.rounds = 0});
    EXPECT_EQ(counted.report.cuts_after, counted.report.cuts_before);
    EXPECT_EQ(counted.report.left, 1);
    EXPECT_EQ(counted.report.moved, 0);
    const Repaired short_of_it = repaired(fingers.path(), fingers.mesh.triangles, {.reach = 0.01});
    EXPECT_GT(short_of_it.report.cuts_after, 0u);
    EXPECT_LE(short_of_it.report.moved, 0.0101);
    EXPECT_EQ(short_of_it.report.left, 1);
    const Repaired hurried = repaired(fingers.path(), fingers.mesh.triangles, {.trials = 30});
    EXPECT_LT(hurried.report.trials, 60);
}

TEST(Repair, LeavesPlacesWhereAnEndIsCut) {
    Fingers fingers;
    const Eigen::Index n = fingers.to.rows() / 2;
    fingers.to.bottomRows(n).rowwise() += Point(0, -4.2, 0); // stops inside
    ASSERT_FALSE(self_intersections(fingers.to, fingers.mesh.triangles).empty());
    const Repaired result = repaired(fingers.path(), fingers.mesh.triangles);
    EXPECT_EQ(result.report.contacts, 0);
    EXPECT_EQ(result.report.moved, 0);
    EXPECT_EQ(result.report.left, 1);
}

TEST(Repair, SameBitsForAnyNumberOfThreads) {
    const Fingers fingers;
    set_threads(1);
    const Interpolant one = repaired(fingers.path(), fingers.mesh.triangles).path;
    set_threads(2);
    const Interpolant two = repaired(fingers.path(), fingers.mesh.triangles).path;
    set_threads(0);
    EXPECT_EQ(one.nodes, two.nodes);
}

TEST(Repair, CancelledAndBadOptions) {
    const Fingers fingers;
    const Interpolant path = fingers.path();
    const Repaired stopped =
        repaired(path, fingers.mesh.triangles, {}, [](double fraction, std::string_view) { return fraction < 0.2; });
    EXPECT_TRUE(stopped.cancelled);
    EXPECT_EQ(stopped.path.nodes, path.nodes);
    EXPECT_THROW(repaired(path, fingers.mesh.triangles, {.frames = 0}), Error);
    EXPECT_THROW(repaired(path, fingers.mesh.triangles, {.reach = 0}), Error);
    EXPECT_THROW(repaired(path, fingers.mesh.triangles, {.rounds = -1}), Error);
}

} // namespace
} // namespace meshtween
