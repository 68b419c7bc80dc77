#include "meshtween/morph/curve.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/morph/spline_fit.h"
#include "support/posed.h"
#include "support/twist.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

// A bar that bends: no polynomial in u.
Morph bending(const Points& bar, double angle) {
    return {[=](double u) -> Points { return u * angle < 1e-6 ? bar : test::bent(bar, u * angle); },
            {},
            [] { return SolveReport{}; }};
}

TEST(Curve, PolynomialsTakeTheirDegree) {
    const Mesh from = test::bar(8, 2);
    const Points to = test::bent(from.positions, 2);
    const Curve line = curve(morph(from, to, {.method = MorphMethod::linear}));
    EXPECT_EQ(line.nodes.size(), 2u);
    EXPECT_LT(line.deviation, 1e-14);
    EXPECT_EQ(curve(morph(from, to, {.method = MorphMethod::laplacian})).nodes.size(), 3u);
}

// A spline of degree p holds every polynomial of degree p, whatever its knots.
TEST(Curve, SplinesGivePolynomialsOfTheirDegreeBack) {
    const Points bar = test::bar(6, 2).positions;
    for (int degree = 1; degree <= 8; ++degree)
        for (const int spans : {1, 2, 4}) {
            Interpolant path;
            path.parameters = lobatto_nodes(degree + 1);
            for (const double u : path.parameters) path.nodes.push_back(test::bent(bar, 0.3 + u));
            const SplineBasis basis = even_basis(degree, spans);
            for (const bool velocities : {false, true}) {
                if (velocities && degree < 3) continue;
                const SplineTask task{path, {velocities, velocities}, 0};
                const std::vector<Points> nodes = control_meshes(basis, task);
                EXPECT_EQ(nodes.front(), path.nodes.front());
                EXPECT_EQ(nodes.back(), path.nodes.back());
                for (const double u : {0.0, 0.1, 0.37, 0.5, 0.91, 1.0})
                    EXPECT_LT(test::distance(weighted_sum(nodes, basis.weights(u)), path.at(u)), 1e-11) << degree;
                EXPECT_LT(spline_error(basis, task), 1e-11);
            }
        }
}

// However densely one looks, the curve lies no further from its path than it says.
TEST(Curve, ItsDeviationIsHonest) {
    const Points bar = test::bar(20, 3).positions;
    for (const double angle : {30.0, 270.0, 700.0}) {
        const Morph path = bending(bar, angle * test::degree);
        for (const double tolerance : {1e-2, 1e-3, 1e-5, 1e-8}) {
            const Curve c = curve(path, {.tolerance = tolerance});
            EXPECT_LE(c.deviation, tolerance) << angle;
            double worst = 0;
            for (int k = 0; k <= 500; ++k) worst = std::max(worst, test::distance(c.at(k / 500.0), path.at(k / 500.0)));
            EXPECT_LE(worst, c.deviation * diagonal(bar)) << angle << " " << tolerance;
            EXPECT_GT(worst, 0.05 * c.deviation * diagonal(bar)) << angle << " " << tolerance;
            EXPECT_EQ(c.nodes.front(), path.at(0));
            EXPECT_EQ(c.at(1), path.at(1));
        }
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
        EXPECT_GE(c.deviation, worst / diagonal(bar));
    }
}

// What is known on the path and blended as the nodes are comes back.
TEST(Curve, NormalsAreBlendedAsTheNodesAre) {
    const Mesh mesh = straight_bar(2);
    const Curve c = twist_curve(mesh);
    const std::vector<Points> normals = control_normals(c, mesh.triangles);
    for (const double u : {0.0, 0.2, 0.5, 0.83, 1.0}) {
        const Points blended = weighted_sum(normals, c.weights(u)).rowwise().normalized();
        const Points wanted = vertex_normals(c.at(u), mesh.triangles);
        const double cosine = blended.cwiseProduct(wanted).rowwise().sum().minCoeff();
        EXPECT_LT(std::acos(std::min(1.0, cosine)), u == 0 || u == 1 ? 1e-7 : 0.01) << u;
    }
    const std::vector<bool> on = nodes_on_path(c);
    EXPECT_TRUE(on.front() && on.back());
    EXPECT_EQ(std::count(on.begin(), on.end(), true), 2);
}

TEST(Curve, SameBitsForAnyNumberOfThreads) {
    const Morph path = bending(test::bar(300, 8).positions, 4);
    set_threads(1);
    const Curve one = curve(path);
    set_threads(2);
    const Curve two = curve(path);
    set_threads(0);
    EXPECT_EQ(one.basis.knots, two.basis.knots);
    EXPECT_EQ(one.nodes, two.nodes);
    EXPECT_EQ(one.deviation, two.deviation);
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
