#include "meshtween/morph/timing.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/measure.h"
#include "support/posed.h"

#include <gtest/gtest.h>

namespace meshtween {
namespace {

TEST(Timing, EasesKeepTheEndsAndNeverFall) {
    for (const char* name : {"linear", "in", "out", "in-out"}) {
        const Ease kind = ease_named(name);
        EXPECT_EQ(ease(kind, 0), 0) << name;
        EXPECT_EQ(ease(kind, 1), 1) << name;
        for (int k = 0; k < 100; ++k) EXPECT_LE(ease(kind, k / 100.0), ease(kind, (k + 1) / 100.0)) << name;
    }
    EXPECT_LT(ease(Ease::in, 0.1), 0.1);
    EXPECT_GT(ease(Ease::out, 0.1), 0.1);
    EXPECT_THROW(ease_named("bounce"), Error);
}

TEST(Timing, PingPongComesBack) {
    EXPECT_EQ(ping_pong(0), 0);
    EXPECT_DOUBLE_EQ(ping_pong(0.25), 0.5);
    EXPECT_DOUBLE_EQ(ping_pong(0.5), 1);
    EXPECT_DOUBLE_EQ(ping_pong(1.75), 0.5);
    EXPECT_DOUBLE_EQ(ping_pong(-0.25), 0.5);
}

std::vector<TimedVertex> early_left_late_right(const Points& p) {
    std::vector<TimedVertex> given;
    for (int i = 0; i < p.rows(); ++i) {
        if (p(i, 0) < 1) given.push_back({i, 0, 0.5});
        if (p(i, 0) > p.col(0).maxCoeff() - 1) given.push_back({i, 0.5, 1});
    }
    return given;
}

TEST(Timing, RegionsGetTheirTimesAndTheRestIsSmooth) {
    const Mesh bar = test::bar(40, 3);
    const RegionTiming timing = region_timing(bar, early_left_late_right(bar.positions), 0);
    for (Eigen::Index i = 0; i < bar.positions.rows(); ++i) {
        const double x = bar.positions(i, 0) / 40;
        EXPECT_NEAR(timing.start[i], 0.5 * x, 0.03) << x; // harmonic: straight along a bar
        EXPECT_NEAR(timing.end[i], 0.5 + 0.5 * x, 0.03) << x;
    }
}

TEST(Timing, WithoutRegionsAllMoveTogether) {
    const Mesh bar = test::bar(10, 3);
    const RegionTiming timing = region_timing(bar, {});
    EXPECT_NEAR(timing.start.cwiseAbs().maxCoeff(), 0, 1e-6);
    EXPECT_NEAR(timing.end.minCoeff(), 1, 1e-6);
}

TEST(Timing, BadTimesAreErrors) {
    const Mesh bar = test::bar(5, 2);
    EXPECT_THROW(region_timing(bar, {{-1, 0, 1}}), Error);
    EXPECT_THROW(region_timing(bar, {{0, 0.7, 0.2}}), Error);
    EXPECT_THROW(region_timing(bar, {{0, 0, 1.5}}), Error);
    EXPECT_THROW(region_timing(bar, {}, -1), Error);
}

class Retimed : public testing::TestWithParam<MorphMethod> {};

TEST_P(Retimed, KeepsTheEndsAndMovesOneSideFirst) {
    const Mesh bar = test::bar(40, 3);
    const Points to = test::bent(bar.positions, 2);
    const Morph path = morph(bar, to, {.method = GetParam(), .c1 = 1.1, .c2 = 0.9});
    const Morph late = retimed(path, region_timing(bar, early_left_late_right(bar.positions)));
    const double near = 1e-4 * diagonal(to);
    EXPECT_LT(test::distance(late.at(0), bar.positions), near);
    EXPECT_LT(test::distance(late.at(1), to), near);
    EXPECT_GT(test::distance(late.at(0.5), path.at(0.5)), 10 * near);
}

INSTANTIATE_TEST_SUITE_P(Timing, Retimed, testing::ValuesIn(morph_methods()), [](const auto& instance) {
    std::string name(name_of(instance.param));
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

TEST(Timing, RigidCarriesWhatMovesLater) {
    const Mesh bar = test::bar(40, 3);
    const Points to = test::bent(bar.positions, 180 * test::degree);
    const Morph late = retimed(morph(bar, to), region_timing(bar, early_left_late_right(bar.positions)));
    EXPECT_LT(test::edge_error(bar.triangles, bar.positions, to, late.at(0.5)), 0.03);
}

} // namespace
} // namespace meshtween
