#include "meshtween/fit/quality.h"

#include "meshtween/core/error.h"
#include "meshtween/fit/markers.h"
#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

namespace meshtween {
namespace {

Mesh scaled(Mesh mesh, double factor) {
    mesh.positions *= factor;
    return mesh;
}

TEST(Quality, AMeshOnItself) {
    const Mesh ball = sphere(3);
    const MarkerPair pole{"pole", ball.positions.row(0), ball.positions.row(0)};
    const Quality q = measure(ball, ball, ball, ball.positions, place_markers(std::span(&pole, 1), ball));
    EXPECT_LT(q.fitted_to_target.max, 1e-9);
    EXPECT_LT(q.target_to_fitted.max, 1e-9);
    EXPECT_LT(q.eq7, 1e-20);
    EXPECT_EQ(std::ssize(q.flipped) + q.degenerate + std::ssize(q.cuts) + q.cuts_source + q.cuts_target, 0);
    EXPECT_NEAR(q.symmetric_dirichlet.max, 4, 1e-9);
    EXPECT_EQ(q.truth_error->max, 0);
    EXPECT_LT(q.marker_error->max, 1e-9);
}

TEST(Quality, ASphereInALargerOne) { // radii 1 and 1.1: 0.1 apart everywhere, on a diagonal of 2.2 sqrt(3)
    const Mesh inner = sphere(4), outer = scaled(inner, 1.1);
    const Quality q = measure(inner, inner, outer);
    const double want = 100 * 0.1 / (2.2 * std::sqrt(3.0));
    EXPECT_NEAR(q.fitted_to_target.mean, want, 0.02 * want);
    EXPECT_NEAR(q.target_to_fitted.mean, want, 0.02 * want);
    EXPECT_FALSE(q.truth_error || q.marker_error);
}

TEST(Quality, StretchIsInTheDirichletEnergy) {
    const Mesh ball = sphere(3), twice = scaled(ball, 2);
    EXPECT_NEAR(measure(ball, twice, twice).symmetric_dirichlet.mean, 4 + 4 + 0.25 + 0.25, 1e-9);
}

TEST(Quality, InsideOutIsFlippedEverywhere) {
    const Mesh ball = sphere(2);
    Mesh inside_out = ball;
    inside_out.triangles.col(0).swap(inside_out.triangles.col(1));
    const Quality q = measure(inside_out, inside_out, ball);
    EXPECT_EQ(std::ssize(q.flipped), ball.triangles.rows());
    EXPECT_NEAR(q.flipped_area_percent, 100, 1e-9);
}

TEST(Quality, ACollapsedFaceIsCountedAndFinite) {
    const Mesh ball = sphere(2);
    Mesh dented = ball;
    dented.positions.row(ball.triangles(0, 1)) = dented.positions.row(ball.triangles(0, 0));
    const Quality q = measure(ball, dented, ball);
    EXPECT_GE(q.degenerate, 1);
    EXPECT_TRUE(std::isfinite(q.symmetric_dirichlet.max));
}

TEST(Quality, MeshesMustBelongTogether) {
    const Mesh coarse = sphere(2), fine = sphere(3);
    EXPECT_THROW(measure(coarse, fine, fine), Error);
    EXPECT_THROW(measure(coarse, coarse, fine, Points::Zero(3, 3)), Error);
}

TEST(Statistics, OfAFewNumbers) {
    const Statistics s = statistics({4, 1, 3, 2});
    EXPECT_DOUBLE_EQ(s.mean, 2.5);
    EXPECT_DOUBLE_EQ(s.rms, std::sqrt(7.5));
    EXPECT_DOUBLE_EQ(s.median, 2);
    EXPECT_DOUBLE_EQ(s.max, 4);
    EXPECT_EQ(statistics({}).max, 0);
}

} // namespace
} // namespace meshtween
