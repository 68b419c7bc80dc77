#include "meshtween/solve/laplacian.h"

#include "support/posed.h"

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

namespace meshtween {
namespace {

using test::bar;

TEST(Laplacian, ConstantsAndIsolatedVerticesGiveNought) {
    const Mesh mesh = bar(5, 2);
    const Eigen::Index n = mesh.positions.rows();
    const Lists neighbours = topology(n + 1, mesh.triangles).neighbours; // one vertex of no triangle
    Points constant(n + 1, 3);
    constant.rowwise() = Point(3, -2, 7);
    EXPECT_NEAR(uniform_laplacian(constant, neighbours).norm(), 0, 1e-12);
    Points moved = constant;
    moved.row(n) = Point(9, 9, 9);
    EXPECT_EQ(uniform_laplacian(moved, neighbours).row(n).norm(), 0);
}

TEST(Laplacian, PointsOutwardsWhereConvex) {
    const Mesh mesh = bar(2, 2);
    const Points delta = uniform_laplacian(mesh.positions, topology(mesh.positions.rows(), mesh.triangles).neighbours);
    for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i)
        EXPECT_GE(delta.row(i).dot(mesh.positions.row(i) - Point(1, 0, 0)), -1e-12) << i;
}

TEST(Laplacian, GraphMatrixIsTheDegreeTimesEq8) {
    const Mesh mesh = bar(4, 2);
    const Lists neighbours = topology(mesh.positions.rows(), mesh.triangles).neighbours;
    const SparseMatrix lower = graph_laplacian(neighbours);
    Points expected = uniform_laplacian(mesh.positions, neighbours);
    for (Eigen::Index i = 0; i < expected.rows(); ++i) expected.row(i) *= static_cast<double>(neighbours[i].size());
    const Points product = lower.selfadjointView<Eigen::Lower>() * mesh.positions;
    EXPECT_NEAR((product - expected).norm(), 0, 1e-10);
}

TEST(Laplacian, CotangentsOfARightTriangle) {
    Points p(3, 3);
    p << 0, 0, 0, 1, 0, 0, 0, 1, 0;
    Triangles t(1, 3);
    t << 0, 1, 2;
    const auto half = half_cotangents(edge_lengths(p, t), 0);
    EXPECT_NEAR(half(0, 0), 0.5, 1e-12); // opposite 45 degrees
    EXPECT_NEAR(half(0, 1), 0.0, 1e-12); // opposite the right angle
    EXPECT_NEAR(half(0, 2), 0.5, 1e-12);
}

TEST(Laplacian, LinearFunctionsAreHarmonicInsideAFlatPatch) {
    Mesh mesh;
    mesh.positions.resize(5, 3);
    mesh.positions << 0, 0, 0, 3, 0, 0, 3, 2, 0, 0, 2, 0, 1.2, 0.7, 0;
    mesh.triangles.resize(4, 3);
    mesh.triangles << 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4;
    const auto weights = half_cotangents(edge_lengths(mesh.positions, mesh.triangles), 0);
    const SparseMatrix lower = cotangent_laplacian(5, mesh.triangles, weights);
    const Points product = lower.selfadjointView<Eigen::Lower>() * mesh.positions;
    EXPECT_NEAR(product.row(4).norm(), 0, 1e-12);
    EXPECT_GT(product.row(0).norm(), 0.1);
}

TEST(Laplacian, TrianglesWithoutAreaStayFiniteAndSemidefinite) {
    Mesh mesh = bar(3, 2);
    mesh.positions.row(mesh.triangles(0, 0)) = mesh.positions.row(mesh.triangles(0, 1)); // an edge without length
    mesh.positions.row(7) = mesh.positions.row(8);
    const auto weights = half_cotangents(edge_lengths(mesh.positions, mesh.triangles));
    ASSERT_TRUE(weights.allFinite());
    const SparseMatrix lower = cotangent_laplacian(mesh.positions.rows(), mesh.triangles, weights);
    const Eigen::MatrixXd full = Eigen::MatrixXd(lower);
    const Eigen::VectorXd values = full.selfadjointView<Eigen::Lower>().eigenvalues();
    EXPECT_GT(values.minCoeff(), -1e-9 * values.maxCoeff());
}

} // namespace
} // namespace meshtween
