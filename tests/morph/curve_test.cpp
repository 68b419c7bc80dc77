#include "meshtween/morph/curve.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/measure.h"
#include "support/posed.h"

#include <gtest/gtest.h>

#include <numeric>

namespace meshtween {
namespace {

// A bar that bends: no polynomial in u.
Morph bending(const Points& bar, double angle) {
    return {[=](double u) -> Points { return u * angle < 1e-6 ? bar : test::bent(bar, u * angle); },
            {},
            [] { return SolveReport{}; }};
}

TEST(Curve, WeightsAddUpAndPickNodes) {
    Curve c;
    c.parameters = lobatto_nodes(9);
    for (const double u : {0.0, 0.01, 0.3, 0.77, 1.0}) {
        const std::vector<double> w = c.weights(u);
        EXPECT_NEAR(std::accumulate(w.begin(), w.end(), 0.0), 1, 1e-12);
    }
    EXPECT_EQ(c.weights(c.parameters[3])[3], 1);
    EXPECT_EQ(c.parameters.front(), 0);
    EXPECT_EQ(c.parameters.back(), 1);
    EXPECT_DOUBLE_EQ(c.parameters[4], 0.5);
}

TEST(Curve, PolynomialsTakeTheirDegree) {
    const Mesh from = test::bar(8, 2);
    const Points to = test::bent(from.positions, 2);
    EXPECT_EQ(curve(morph(from, to, {.method = MorphMethod::linear})).nodes.size(), 2u);
    EXPECT_EQ(curve(morph(from, to, {.method = MorphMethod::laplacian})).nodes.size(), 3u);
}

TEST(Curve, StaysWithinItsToleranceBetweenNodes) {
    const Points bar = test::bar(20, 3).positions;
    const Morph path = bending(bar, 270 * test::degree);
    for (const double tolerance : {1e-3, 1e-5, 1e-8}) {
        const Curve c = curve(path, {.tolerance = tolerance});
        EXPECT_LE(c.deviation, tolerance);
        for (int k = 0; k <= 100; ++k)
            EXPECT_LT(test::distance(c.at(k / 100.0), path.at(k / 100.0)), 3 * tolerance * diagonal(bar)) << k;
        EXPECT_EQ(c.nodes.front(), path.at(0));
        EXPECT_EQ(c.at(1), path.at(1));
    }
}

TEST(Curve, SaysWhatACapCosts) {
    const Points bar = test::bar(20, 3).positions;
    const Morph path = bending(bar, 270 * test::degree);
    for (const int cap : {2, 4, 6}) {
        const Curve c = curve(path, {.tolerance = 1e-9, .max_nodes = cap});
        EXPECT_EQ(static_cast<int>(c.nodes.size()), cap);
        double worst = 0;
        for (int k = 0; k <= 200; ++k) worst = std::max(worst, test::distance(c.at(k / 200.0), path.at(k / 200.0)));
        EXPECT_GT(c.deviation, 1e-9);
        EXPECT_GT(c.deviation, 0.5 * worst / diagonal(bar));
    }
}

TEST(Curve, CancelledAndBadOptions) {
    const Morph path = bending(test::bar(5, 2).positions, 2);
    EXPECT_TRUE(curve(path, {}, [](double, std::string_view) { return false; }).cancelled);
    EXPECT_THROW(curve(path, {.tolerance = 0}), Error);
    EXPECT_THROW(curve(path, {.max_nodes = 1}), Error);
}

TEST(Curve, ProgressNeverFalls) {
    double last = 0;
    curve(bending(test::bar(5, 2).positions, 4), {.tolerance = 1e-8}, [&](double fraction, std::string_view) {
        EXPECT_GE(fraction, last);
        EXPECT_LE(fraction, 1);
        last = fraction;
        return true;
    });
    EXPECT_GT(last, 0);
}

} // namespace
} // namespace meshtween
