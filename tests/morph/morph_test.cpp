// Laws of every method.
#include "meshtween/morph/morph.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "support/errors.h"
#include "support/posed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace meshtween {
namespace {

class EveryMethod : public testing::TestWithParam<MorphMethod> {
protected:
    MorphOptions options() const { return {.method = GetParam(), .c1 = 1.05, .c2 = 0.95}; }
};

TEST_P(EveryMethod, EndsAreExact) {
    const Mesh from = test::bar(20, 3);
    const Points to = test::shaken(test::bent(from.positions, 1.5), 0.1);
    const Morph path = morph(from, to, options());
    // As printed, the ends are solved for like any other shape: they are as good as the solve.
    const double near = (GetParam() == MorphMethod::dual_as_printed ? 1e-5 : 1e-9) * diagonal(from);
    EXPECT_LT(test::distance(path.at(0), from.positions), near);
    EXPECT_LT(test::distance(path.at(1), to), near);
}

TEST_P(EveryMethod, SameShapeStays) {
    const Mesh from = test::bar(10, 3);
    const Morph path = morph(from, from.positions, options());
    EXPECT_LT(test::distance(path.at(0.3), from.positions), 1e-5 * diagonal(from));
}

TEST_P(EveryMethod, SameBitsForAnyNumberOfThreads) {
    const Mesh from = test::bar(40, 8);
    const Points to = test::bent(from.positions, 1);
    set_threads(1);
    const Points one = morph(from, to, options()).at(0.4);
    set_threads(2);
    const Points two = morph(from, to, options()).at(0.4);
    set_threads(0);
    EXPECT_EQ(one, two);
}

TEST_P(EveryMethod, DirtyMeshesGiveNumbers) {
    Mesh from = test::bar(6, 2);
    const auto n = from.positions.rows();
    const auto m = from.triangles.rows();
    from.positions.conservativeResize(n + 5, 3); // a vertex of no triangle, a triangle apart, one without area
    from.positions.bottomRows(5) << 9, 9, 9, 8, 8, 8, 9, 8, 8, 8, 9, 8, 3, 3, 3;
    from.triangles.conservativeResize(m + 3, 3);
    from.triangles.bottomRows(3) << n + 1, n + 2, n + 3, 0, 1, n + 4, 0, 1, 1; // the second makes an edge of three
    from.positions.row(5) = from.positions.row(6);
    Points to = test::bent(from.positions, 1.2);
    to.row(7) = to.row(8);
    const Morph path = morph(from, to, options());
    EXPECT_TRUE(path.at(0.5).allFinite());
    EXPECT_LT(test::distance(path.at(1), to), 1e-4 * diagonal(from));
}

TEST_P(EveryMethod, OnePlaceForAll) { // no extent at all
    Mesh from = test::bar(3, 2);
    from.positions.setConstant(2);
    EXPECT_TRUE(morph(from, from.positions, options()).at(0.5).allFinite());
}

TEST_P(EveryMethod, HasAName) {
    EXPECT_EQ(morph_method(name_of(GetParam())), GetParam());
}

INSTANTIATE_TEST_SUITE_P(Morph, EveryMethod, testing::ValuesIn(morph_methods()), [](const auto& instance) {
    std::string name(name_of(instance.param));
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

TEST(Morph, BadInputIsAnArgumentError) {
    const Mesh from = test::bar(3, 2);
    const auto refused = [](const Mesh& mesh, const Points& to, const MorphOptions& options) {
        return message_of(ErrorKind::argument, [&] { morph(mesh, to, options); });
    };
    EXPECT_THAT(refused(from, from.positions.topRows(4), {}), testing::HasSubstr("fit first"));
    EXPECT_THAT(refused(from, from.positions, {.c1 = 0.9, .c2 = 0.99}), testing::HasSubstr("C1 > C2"));
    EXPECT_THAT(refused(from, from.positions, {.tolerance = 0}), testing::HasSubstr("tolerance"));
    Points to = from.positions;
    to(3, 1) = std::nan("");
    EXPECT_THAT(refused(from, to, {}), testing::HasSubstr("not finite"));
    Mesh broken = from;
    broken.triangles(0, 0) = 1000;
    EXPECT_THAT(refused(broken, from.positions, {}), testing::HasSubstr("triangle 0"));
    EXPECT_THAT(message_of(ErrorKind::argument, [] { morph_method("duel"); }), testing::HasSubstr("dual-as-printed"));
}

} // namespace
} // namespace meshtween
