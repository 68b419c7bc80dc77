#include "meshtween/morph/spline_basis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace meshtween {
namespace {

// Even and uneven knots of every degree in use, and knots that stand `degree` times inside, as at a key.
std::vector<SplineBasis> bases() {
    std::vector<SplineBasis> all{even_basis(0, 1)};
    for (int degree = 1; degree <= 9; ++degree)
        for (const int spans : {1, 2, 5}) {
            SplineBasis even = even_basis(degree, spans);
            all.push_back(even);
            for (double& knot : even.knots) knot = knot * knot;
            all.push_back(even);
            even.knots.insert(std::upper_bound(even.knots.begin(), even.knots.end(), 0.3),
                              static_cast<std::size_t>(degree), 0.3);
            all.push_back(even);
        }
    return all;
}

std::vector<double> moments() {
    std::vector<double> all{0, 1, 0.3, 0.5, 1e-300, 1e-12, 1 - 1e-16};
    std::mt19937 random(1);
    for (int i = 0; i < 300; ++i) all.push_back(random() / 4294967296.0);
    return all;
}

TEST(SplineBasis, WeightsLieInZeroToOneAndAddUp) {
    for (const SplineBasis& basis : bases())
        for (const double u : moments()) {
            const std::vector<double> w = basis.weights(u);
            ASSERT_EQ(w.size(), basis.size());
            EXPECT_GE(*std::min_element(w.begin(), w.end()), 0);
            EXPECT_LE(*std::max_element(w.begin(), w.end()), 1);
            EXPECT_NEAR(std::accumulate(w.begin(), w.end(), 0.0), 1, 1e-14) << basis.degree << " at " << u;
            EXPECT_LE(std::count_if(w.begin(), w.end(), [](double x) { return x > 0; }), basis.degree + 1);
        }
}

TEST(SplineBasis, EndsAndKeysAreOneWeight) {
    for (const SplineBasis& basis : bases()) {
        EXPECT_EQ(basis.weights(0).front(), 1);
        EXPECT_EQ(basis.weights(1).back(), 1);
        EXPECT_EQ(basis.weights(-1), basis.weights(0));
        EXPECT_EQ(basis.weights(2), basis.weights(1));
        if (std::count(basis.knots.begin(), basis.knots.end(), 0.3) != basis.degree) continue;
        const std::vector<double> w = basis.weights(0.3);
        EXPECT_EQ(std::count(w.begin(), w.end(), 1.0), 1);
        EXPECT_EQ(std::count(w.begin(), w.end(), 0.0), std::ssize(w) - 1);
    }
}

// Marsden's identity: with the knots' mean for each weight, the sum is u itself.
TEST(SplineBasis, GivesStraightLinesBack) {
    for (const SplineBasis& basis : bases()) {
        if (basis.degree == 0) continue;
        for (const double u : moments()) {
            const std::vector<double> w = basis.weights(u);
            double sum = 0;
            for (std::size_t k = 0; k < w.size(); ++k)
                for (int j = 1; j <= basis.degree; ++j)
                    sum += w[k] * basis.knots[k + static_cast<std::size_t>(j)] / basis.degree;
            EXPECT_NEAR(sum, u, 1e-14) << basis.degree;
        }
    }
}

TEST(SplineBasis, OneSpanIsBernsteins) {
    const std::vector<double> w = even_basis(4, 1).weights(0.3);
    const double binomial[] = {1, 4, 6, 4, 1};
    for (int k = 0; k <= 4; ++k)
        EXPECT_NEAR(w[static_cast<std::size_t>(k)], binomial[k] * std::pow(0.3, k) * std::pow(0.7, 4 - k), 1e-15) << k;
}

} // namespace
} // namespace meshtween
