#include "meshtween/solve/cholesky.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/solve/laplacian.h"
#include "support/posed.h"

#include <gtest/gtest.h>

namespace meshtween {
namespace {

SparseMatrix held_laplacian(const Mesh& mesh) {
    SparseMatrix lower = graph_laplacian(topology(mesh.positions.rows(), mesh.triangles).neighbours);
    lower.coeffRef(0, 0) += 1;
    return lower;
}

TEST(Cholesky, SolvesWhatItWasGiven) {
    const Mesh mesh = test::bar(30, 6);
    const SparseMatrix lower = held_laplacian(mesh);
    const Points wanted = test::shaken(mesh.positions, 2);
    const Points right = lower.selfadjointView<Eigen::Lower>() * wanted;
    EXPECT_LT(test::distance(SparseCholesky(lower).solve(right), wanted), 1e-9);
}

TEST(Cholesky, APatternServesAllMatricesOfIt) {
    const Mesh mesh = test::bar(30, 6);
    const SparseMatrix other = held_laplacian(mesh);
    const auto pattern = factor_pattern(other);
    SparseMatrix lower = 3 * other;
    lower.diagonal().array() += 0.1;
    const Points wanted = test::shaken(mesh.positions, 2);
    const Points right = lower.selfadjointView<Eigen::Lower>() * wanted;
    const SparseCholesky factor(lower, pattern);
    EXPECT_EQ(factor.solve(right), SparseCholesky(lower).solve(right));
    EXPECT_LT((factor.solve_vector(right.col(1)) - wanted.col(1)).norm(), 1e-9);
}

TEST(Cholesky, SmallestSystems) {
    SparseMatrix one(1, 1);
    one.insert(0, 0) = 4;
    EXPECT_NEAR(SparseCholesky(one).solve(Points::Constant(1, 3, 2))(0, 1), 0.5, 1e-15);
    SparseMatrix diagonal(3, 3); // no neighbours at all
    for (int i = 0; i < 3; ++i) diagonal.insert(i, i) = i + 1;
    EXPECT_NEAR(SparseCholesky(diagonal).solve(Points::Constant(3, 3, 6))(2, 0), 2, 1e-15);
}

TEST(Cholesky, SameBitsForAnyNumberOfThreads) {
    const Mesh mesh = test::bar(60, 12);
    const SparseMatrix lower = held_laplacian(mesh);
    set_threads(1);
    const Points one = SparseCholesky(lower).solve(mesh.positions);
    set_threads(2);
    const Points two = SparseCholesky(lower).solve(mesh.positions);
    set_threads(0);
    EXPECT_EQ(one, two);
}

TEST(Cholesky, SingularIsAnError) {
    const Mesh mesh = test::bar(5, 2);
    const SparseMatrix lower = graph_laplacian(topology(mesh.positions.rows() + 1, mesh.triangles).neighbours);
    EXPECT_THROW(SparseCholesky{lower}, Error); // the last vertex has no equation
}

} // namespace
} // namespace meshtween
