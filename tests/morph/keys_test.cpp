#include "meshtween/morph/keys.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/measure.h"
#include "support/posed.h"

#include <gtest/gtest.h>

namespace meshtween {
namespace {

const Mesh bar = test::bar(20, 3);

std::vector<Points> three_shapes() {
    return {bar.positions, test::bent(bar.positions, 1.5), test::twisted(bar.positions, 2)};
}

Points velocity(const KeyPath& path, double t, double step) {
    return (path.at(t + step) - path.at(t)) / step;
}

TEST(Keys, PassTheirShapesAtTheirTimes) {
    const std::vector<Points> shapes = three_shapes();
    KeyOptions options;
    options.times = {0, 0.3, 1};
    const KeyPath path = key_path(bar, shapes, options);
    for (std::size_t k = 0; k < shapes.size(); ++k)
        EXPECT_LT(test::distance(path.at(options.times[k]), shapes[k]), 1e-9) << k;
}

TEST(Keys, VelocityIsContinuous) {
    KeyOptions options;
    options.closed = true;
    const KeyPath path = key_path(bar, three_shapes(), options);
    const double h = 1e-5;
    for (const double t : {1.0 / 3, 2.0 / 3}) {
        const Points before = velocity(path, t - h, h), after = velocity(path, t, h);
        EXPECT_LT(test::distance(before, after), 0.01 * after.rowwise().norm().maxCoeff()) << t;
    }
    EXPECT_LT(test::distance(velocity(path, 0, h), velocity(path, 1 - h, h)), 0.1);
    EXPECT_LT(test::distance(path.at(0), path.at(1)), 1e-9);
}

TEST(Keys, TwoShapesAreTheMethodsOwnPath) {
    const Points to = test::bent(bar.positions, 1.5);
    EXPECT_LT(test::distance(key_path(bar, {bar.positions, to}).at(0.4), morph(bar, to).at(0.4)), 1e-4 * diagonal(to));
}

TEST(Keys, BadKeysAreErrors) {
    KeyOptions options;
    EXPECT_THROW(key_path(bar, {bar.positions}), Error);
    options.times = {0, 1};
    EXPECT_THROW(key_path(bar, three_shapes(), options), Error);
    options.times = {0, 0, 1};
    EXPECT_THROW(key_path(bar, three_shapes(), options), Error);
}

TEST(Blend, OneShapeAndStraightLines) {
    const std::vector<Points> shapes = three_shapes();
    EXPECT_LT(test::distance(blend(bar, shapes, {0, 1, 0}), shapes[1]), 1e-9);
    const Points sum = blend(bar, shapes, {0.2, 0.5, 0.3}, {.method = MorphMethod::linear});
    EXPECT_LT(test::distance(sum, 0.2 * shapes[0] + 0.5 * shapes[1] + 0.3 * shapes[2]), 1e-9);
    const Points beyond = blend(bar, shapes, {-0.5, 1.5, 0}, {.method = MorphMethod::linear});
    EXPECT_LT(test::distance(beyond, 1.5 * shapes[1] - 0.5 * shapes[0]), 1e-9);
}

TEST(Blend, RigidKeepsShapesAndGoesBeyond) {
    const Points bent = test::bent(bar.positions, 1), more = test::bent(bar.positions, 1.5);
    const Points half = blend(bar, {bar.positions, bent}, {0.5, 0.5});
    EXPECT_LT(test::edge_error(bar.triangles, bar.positions, bent, half), 0.005);
    const Points caricature = blend(bar, {bar.positions, bent}, {-0.5, 1.5});
    EXPECT_LT(test::edge_error(bar.triangles, more, more, caricature), 0.02);
}

TEST(Blend, BadWeightsAreErrors) {
    EXPECT_THROW(blend(bar, three_shapes(), {0.5, 0.5}), Error);
    EXPECT_THROW(blend(bar, three_shapes(), {0.5, 0.5, 0.5}), Error);
    EXPECT_THROW(blend(bar, {}, {}), Error);
}

} // namespace
} // namespace meshtween
