#include "meshtween/morph/keys.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/measure.h"
#include "support/posed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace meshtween {
namespace {

const Mesh bar = test::bar(20, 3);

std::vector<Points> three_shapes() {
    return {bar.positions, test::bent(bar.positions, 1.5), test::twisted(bar.positions, 2)};
}

Points velocity(const Curve& path, double t, double step) {
    return (path.at(t + step) - path.at(t)) / step;
}

TEST(Keys, PassTheirShapesAtTheirTimes) {
    const std::vector<Points> shapes = three_shapes();
    KeyOptions options;
    options.times = {0, 0.3, 1};
    const Curve path = key_path(bar, shapes, options).curve;
    for (std::size_t k = 0; k < shapes.size(); ++k)
        EXPECT_LT(test::distance(path.at(options.times[k]), shapes[k]), 1e-9) << k;
}

TEST(Keys, VelocityIsContinuous) {
    KeyOptions options;
    options.closed = true;
    const Curve path = key_path(bar, three_shapes(), options).curve;
    const double h = 1e-5;
    for (const double t : {1.0 / 3, 2.0 / 3}) {
        const Points before = velocity(path, t - h, h), after = velocity(path, t, h);
        EXPECT_LT(test::distance(before, after), 0.01 * diagonal(bar)) << t; // which it goes in a piece
    }
    EXPECT_LT(test::distance(velocity(path, 0, h), velocity(path, 1 - h, h)), 0.1);
    EXPECT_LT(test::distance(path.at(0), path.at(1)), 1e-9);
}

TEST(Keys, TwoShapesAreTheMethodsOwnPath) {
    const Points to = test::bent(bar.positions, 1.5);
    EXPECT_LT(test::distance(key_path(bar, {bar.positions, to}).curve.at(0.4), morph(bar, to).at(0.4)),
              1e-4 * diagonal(to));
}

TEST(Keys, AreNodesAndOnePieceHasWeightAtATime) {
    const std::vector<Points> shapes = three_shapes();
    const Curve path = key_path(bar, shapes).curve;
    EXPECT_EQ(path.keys, (std::vector<double>{0, 0.5, 1}));
    EXPECT_EQ(path.at(0), shapes[0]);
    EXPECT_EQ(path.at(0.5), shapes[1]);
    EXPECT_EQ(path.at(1), shapes[2]);
    EXPECT_EQ(nodes_on_path(path).size(), path.nodes.size());
    const std::vector<double> before = path.weights(0.3), after = path.weights(0.7);
    for (std::size_t k = 0; k < before.size(); ++k)
        EXPECT_TRUE(before[k] == 0 || after[k] == 0 || path.weights(0.5)[k] == 1) << k;
}

// The derivatives of both pieces at a key, from the nodes beside it: exactly one velocity, to rounding.
TEST(Keys, TheFirstDerivativeIsOneOnBothSides) {
    KeyOptions options;
    options.times = {0, 0.3, 1};
    const Curve path = key_path(bar, three_shapes(), options).curve;
    const std::vector<double> at = path.weights(0.3);
    const auto key = static_cast<std::size_t>(std::max_element(at.begin(), at.end()) - at.begin());
    const std::vector<double>& knots = path.basis.knots;
    const double before = 0.3 - knots[key], after = knots[key + static_cast<std::size_t>(path.basis.degree) + 1] - 0.3;
    const Points first = (path.nodes[key] - path.nodes[key - 1]) / before;
    const Points second = (path.nodes[key + 1] - path.nodes[key]) / after;
    EXPECT_LT(test::distance(first, second), 1e-9 * diagonal(bar));
}

TEST(Keys, ATurnOfTheWayKeepsVolume) { // a bend, then a twist: no corner is cut across turns
    const std::vector<Points> shapes{bar.positions, test::bent(bar.positions, 1.5), test::twisted(bar.positions, 3)};
    const Curve path = key_path(bar, shapes).curve;
    for (const double t : {0.1, 0.3, 0.45, 0.5, 0.55, 0.7, 0.9})
        EXPECT_NEAR(volume(path.at(t), bar.triangles), volume(bar.positions, bar.triangles), 4) << t; // of 180
}

TEST(Keys, AMotionThatGoesOnDoesNotStop) {
    const std::vector<Points> shapes{bar.positions, test::bent(bar.positions, 0.4), test::bent(bar.positions, 0.8)};
    KeyOptions options;
    options.times = {0, 0.7, 1}; // slow, then fast
    const Curve path = key_path(bar, shapes, options).curve;
    const double h = 1e-4, mean = test::distance(shapes[2], shapes[0]);
    EXPECT_GT(velocity(path, 0.7, h).rowwise().norm().maxCoeff(), 0.5 * mean);
    EXPECT_LT(test::distance(velocity(path, 0.7 - h, h), velocity(path, 0.7, h)), 0.01 * mean);
}

TEST(Keys, RegionsKeepTheirTimesInEveryPiece) {
    Points spread = bar.positions; // no turn, and the centre stays
    for (Eigen::Index i = 0; i < spread.rows(); ++i) spread(i, 1) *= 1.5;
    KeyOptions options;
    options.timing = RegionTiming{Eigen::VectorXd::Zero(spread.rows()), Eigen::VectorXd::Constant(spread.rows(), 0.5)};
    const Curve path = key_path(bar, {bar.positions, spread, bar.positions}, options).curve;
    for (const double t : {0.3, 0.45}) // all have arrived by half of the piece
        EXPECT_LT(test::distance(path.at(t), spread), 0.01 * diagonal(spread)) << t;
}

TEST(Keys, CancellingIsAResult) {
    const KeyPath path = key_path(bar, three_shapes(), {}, [](double, std::string_view) { return false; });
    EXPECT_TRUE(path.curve.cancelled);
    EXPECT_TRUE(path.curve.nodes.empty());
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
