#include "meshtween/fit/rbf.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace meshtween {
namespace {

Points scattered(int count, unsigned seed, double size = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> within(-size, size);
    Points points(count, 3);
    for (double& c : points.reshaped()) c = within(random);
    return points;
}

double largest(const Points& difference) {
    return difference.rowwise().norm().maxCoeff();
}

std::string message_of(const Points& from, const Points& to, const std::vector<std::string>& names = {},
                       const RbfOptions& options = {}) {
    try {
        warp(from, to, options, names);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

class Warp : public testing::TestWithParam<Kernel> {
protected:
    RbfOptions options{GetParam(), 0};
};
INSTANTIATE_TEST_SUITE_P(Kernels, Warp, testing::Values(Kernel::thin_plate, Kernel::linear));

TEST_P(Warp, MeetsTheMarkers) { // 1e-9 of the diagonal, however many and in whatever unit
    for (const int count : {3, 4, 5, 40, 600})
        for (const double unit : {1e-3, 1.0, 1e4}) {
            const Points from = scattered(count, 1, unit);
            const Points to = from + scattered(count, 2, 0.3 * unit);
            EXPECT_LT(largest(warp(from, to, options)(from) - to), 1e-9 * unit) << count << " in " << unit;
        }
}

TEST_P(Warp, TwoThousandMarkersFarFromTheOrigin) {
    const Points from = scattered(2000, 1).rowwise() + Point(500, -300, 1000);
    const Points to = from + scattered(2000, 2, 0.05);
    EXPECT_LT(largest(warp(from, to, options)(from) - to), 1e-9);
}

TEST_P(Warp, AffineMapsAreMetEverywhere) {
    const Points from = scattered(30, 3), asked = scattered(200, 4, 5);
    const Eigen::Matrix3d A = Eigen::Matrix3d::Identity() + 0.4 * Eigen::Matrix3d(scattered(3, 5));
    const auto affine = [&](const Points& p) { return Points((p * A).rowwise() + Point(3, -1, 2)); };
    EXPECT_LT(largest(warp(from, affine(from), options)(asked) - affine(asked)), 1e-11);
}

TEST_P(Warp, TurnsAndScalesWithItsMarkers) {
    const Points from = scattered(25, 6), to = from + scattered(25, 7, 0.2), asked = scattered(100, 8);
    const Eigen::Matrix3d R = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
    const auto moved = [&](const Points& p) { return Points((7 * p * R).rowwise() + Point(10, 20, -5)); };
    const Points before = warp(from, to, options)(asked);
    const Points after = warp(moved(from), moved(to), options)(moved(asked));
    EXPECT_LT(largest(after - moved(before)), 1e-10);
}

TEST_P(Warp, FollowsItsFormula) { // Eq. 1 and 2 by the standard library's own logarithm
    const Points from = scattered(20, 9), to = from + scattered(20, 10, 0.2);
    Points asked = scattered(131, 11, 3); // not a whole number of blocks
    asked.row(0) = from.row(4);           // r = 0
    asked.row(1) = Point(1e5, 0, 0);
    const RbfWarp w = warp(from, to, options);
    const Points got = w(asked);
    for (Eigen::Index i = 0; i < asked.rows(); ++i) {
        const Point x = (asked.row(i) - w.origin) * w.scale;
        Point f = w.polynomial.row(0) + x * w.polynomial.bottomRows<3>();
        double size = 1;
        for (Eigen::Index j = 0; j < w.centres.rows(); ++j) {
            const double r = (x - w.centres.row(j)).norm();
            const double phi = w.kernel == Kernel::linear ? r : r > 0 ? r * r * std::log(r) : 0;
            f += phi * w.lambda.row(j);
            size += std::abs(phi) * w.lambda.row(j).norm();
        }
        EXPECT_LT((got.row(i) - asked.row(i) - f / w.scale).norm(), 1e-14 * size) << i;
    }
}

TEST_P(Warp, WeightsAreOrthogonalToThePolynomials) { // Eq. 4
    const RbfWarp w = warp(scattered(50, 12), scattered(50, 13), options);
    EXPECT_LT(w.lambda.colwise().sum().norm(), 1e-10 * w.lambda.norm());
    EXPECT_LT((w.centres.transpose() * w.lambda).norm(), 1e-10 * w.lambda.norm());
}

TEST_P(Warp, ThreeMarkersOfASimilarTriangleAreASimilarity) {
    const Points from = scattered(3, 14), asked = scattered(20, 15);
    const Eigen::Matrix3d R = Eigen::AngleAxisd(2, Eigen::Vector3d(0, 1, 1).normalized()).toRotationMatrix();
    const auto similar = [&](const Points& p) { return Points((0.3 * p * R).rowwise() + Point(1, 2, 3)); };
    EXPECT_LT(largest(warp(from, similar(from), options)(asked) - similar(asked)), 1e-12);
}

TEST_P(Warp, MarkersOnAPlane) { // are met, and the normal direction goes rigidly with the scale
    Points from = scattered(12, 16);
    from.col(2).setZero();
    const Points to = 2 * from;
    EXPECT_LT(largest(warp(from, to, options)(scattered(20, 17)) - 2 * scattered(20, 17)), 1e-11);
    const Points bent = from + scattered(12, 18, 0.2);
    const RbfWarp w = warp(from, bent, options);
    EXPECT_LT(largest(w(from) - bent), 1e-9);
    const Points up = w(Point(0, 0, 0.1)) - w(Point(0, 0, -0.1));
    EXPECT_NEAR(up.norm(), 0.2, 0.1);
    EXPECT_GT(up(0, 2), 0.1);
}

TEST_P(Warp, SameMarkerTwiceCountsOnce) {
    const Points from = scattered(10, 19), to = from + scattered(10, 20, 0.1), asked = scattered(10, 21);
    const Points from_twice = from({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 3, 3}, Eigen::all);
    const Points to_twice = to({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 3, 3}, Eigen::all);
    EXPECT_EQ(warp(from_twice, to_twice, options)(asked), warp(from, to, options)(asked));
}

TEST_P(Warp, SmoothingGoesFromTheMarkersToTheBestAffineMap) {
    const Points from = scattered(30, 22), to = from + scattered(30, 23, 0.2);
    const auto miss = [&](double smoothing) {
        return (warp(from, to, {GetParam(), smoothing})(from) - to).squaredNorm();
    };
    EXPECT_LT(miss(0), 1e-20);
    EXPECT_LT(miss(0), miss(0.01));
    EXPECT_LT(miss(0.01), miss(1));
    Eigen::MatrixXd B(30, 4);
    B << Eigen::VectorXd::Ones(30), from;
    const Points affine = B * B.colPivHouseholderQr().solve(to);
    EXPECT_LT(largest(warp(from, to, {GetParam(), 1e9})(from) - affine), 1e-6);
}

TEST_P(Warp, SameBitsForAnyThreadsAndAnyCompany) {
    const RbfWarp w = warp(scattered(40, 24), scattered(40, 25), options);
    const Points asked = scattered(5000, 26);
    const Points all = w(asked);
    set_threads(1);
    EXPECT_EQ(w(asked), all);
    set_threads(2);
    EXPECT_EQ(w(asked), all);
    set_threads(0);
    EXPECT_EQ(w(asked.middleRows(777, 3)), all.middleRows(777, 3));
    EXPECT_EQ(w(Points(0, 3)).rows(), 0);
}

TEST(WarpErrors, NameTheMarkersAndTheRemedy) {
    Points from = scattered(6, 27), to = scattered(6, 28);
    const std::vector<std::string> names{"nose", "chin", "left ear", "right ear", "brow", "crown"};
    from.row(4) = from.row(1);
    EXPECT_EQ(message_of(from, to, names), "markers 'chin' and 'brow' lie on the same point of the source but on "
                                           "different points of the target: move or remove one");
    from.row(4) += Point(1e-8, 0, 0);
    EXPECT_NE(message_of(from, to, names).find("'chin' and 'brow'"), std::string::npos);

    Points line(4, 3);
    for (int i = 0; i < 4; ++i) line.row(i) = Point(1, 2, 3) * i;
    EXPECT_NE(message_of(line, scattered(4, 29), names).find("lie on one line ('nose' to 'right ear')"),
              std::string::npos);
    EXPECT_NE(message_of(Points::Ones(4, 3), Points::Ones(4, 3)).find("lie on one line"), std::string::npos);

    EXPECT_NE(message_of(from.topRows(2), to.topRows(2)).find("at least 3"), std::string::npos);
    EXPECT_NE(message_of(from, to.topRows(5)).find("6 markers on the source but 5"), std::string::npos);
    from(2, 1) = std::nan("");
    EXPECT_NE(message_of(from, to, names).find("'left ear'"), std::string::npos);
    EXPECT_NE(message_of(to, to, {}, {Kernel::linear, -1}).find("smoothing"), std::string::npos);
}

} // namespace
} // namespace meshtween
