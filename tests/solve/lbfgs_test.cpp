#include "meshtween/solve/lbfgs.h"

#include <gtest/gtest.h>

using namespace meshtween;

namespace {

// Sum of (1 - x)^2 + 100 (y - x^2)^2 + z^2 over the points; its minimum is nought at (1, 1, 0).
double valley(const Points& p, Points& gradient) {
    double sum = 0;
    for (Eigen::Index i = 0; i < p.rows(); ++i) {
        const double x = p(i, 0), y = p(i, 1), z = p(i, 2), off = y - x * x;
        sum += (1 - x) * (1 - x) + 100 * off * off + z * z;
        gradient.row(i) << -2 * (1 - x) - 400 * x * off, 200 * off, 2 * z;
    }
    return sum;
}

Points starts() {
    Points p(3, 3);
    p << -1.2, 1, 1, 0, 0, -2, 2, 2, 0.5;
    return p;
}

TEST(Lbfgs, FindsTheMinimumOfACurvedValley) {
    const Points x = lbfgs(starts(), valley, {500, 6, 0.1, 1, 1e-14});
    for (Eigen::Index i = 0; i < x.rows(); ++i) EXPECT_LT((x.row(i) - Point(1, 1, 0)).norm(), 1e-5);
}

TEST(Lbfgs, ValuesNeverRise) {
    Points gradient(3, 3);
    double before = valley(starts(), gradient);
    for (int iterations = 1; iterations < 30; ++iterations) {
        const double now = valley(lbfgs(starts(), valley, {iterations, 6, 0.1, 1, 0}), gradient);
        EXPECT_LE(now, before);
        before = now;
    }
}

TEST(Lbfgs, StaysAtAMinimum) {
    Points x(1, 3);
    x << 1, 1, 0;
    EXPECT_EQ(lbfgs(x, valley), x);
}

} // namespace
