#include "meshtween/morph/interpolant.h"

#include "meshtween/geometry/measure.h"
#include "support/posed.h"

#include <gtest/gtest.h>

#include <numeric>

namespace meshtween {
namespace {

TEST(Interpolant, WeightsAddUpAndPickNodes) {
    const std::vector<double> nodes = lobatto_nodes(9);
    for (const double u : {0.0, 0.01, 0.3, 0.77, 1.0}) {
        const std::vector<double> w = lagrange_weights(nodes, u);
        EXPECT_NEAR(std::accumulate(w.begin(), w.end(), 0.0), 1, 1e-12);
    }
    EXPECT_EQ(lagrange_weights(nodes, nodes[3])[3], 1);
    EXPECT_EQ(nodes.front(), 0);
    EXPECT_EQ(nodes.back(), 1);
    EXPECT_DOUBLE_EQ(nodes[4], 0.5);
}

TEST(Interpolant, DerivativesAtTheEndsAreThoseOfPolynomials) {
    const std::vector<double> nodes = lobatto_nodes(6);
    for (const bool last : {false, true}) {
        const std::vector<double> w = end_derivative_weights(nodes, last);
        for (int power = 0; power <= 5; ++power) {
            double slope = 0;
            for (std::size_t k = 0; k < nodes.size(); ++k) slope += w[k] * std::pow(nodes[k], power);
            EXPECT_NEAR(slope, last ? power : power == 1, 1e-11) << power;
        }
    }
}

TEST(Interpolant, ItsErrorIsNoSmallerThanWhatIsFound) {
    const Points bar = test::bar(20, 3).positions;
    Morph bending;
    bending.at = [&](double u) -> Points { return u < 1e-9 ? bar : test::bent(bar, u * 4.7); };
    for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
        const Interpolant path = interpolant(bending, tolerance);
        EXPECT_LE(path.error, tolerance * diagonal(bar));
        EXPECT_EQ(path.nodes.front(), bar);
        EXPECT_EQ(path.nodes.back(), bending.at(1));
        for (int k = 0; k <= 100; ++k) EXPECT_LE(test::distance(path.at(k / 100.0), bending.at(k / 100.0)), path.error);
    }
    EXPECT_EQ(interpolant(bending, 1e-12, 9).nodes.size(), 9u);
}

} // namespace
} // namespace meshtween
