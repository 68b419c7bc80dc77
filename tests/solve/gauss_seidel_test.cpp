#include "meshtween/solve/gauss_seidel.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "support/posed.h"

#include <gtest/gtest.h>

#include <Eigen/SparseLU>

#include <set>

namespace meshtween {
namespace {

TEST(GaussSeidel, ColoursKeepNeighboursApart) {
    const Mesh mesh = test::bar(10, 3);
    const Lists neighbours = topology(mesh.positions.rows(), mesh.triangles).neighbours;
    const Lists colours = colouring(neighbours);
    std::set<int> seen;
    for (std::ptrdiff_t c = 0; c < colours.size(); ++c) {
        const std::set<int> group(colours[c].begin(), colours[c].end());
        for (const int i : group)
            for (const int j : neighbours[i]) EXPECT_FALSE(group.contains(j));
        seen.insert(group.begin(), group.end());
    }
    EXPECT_EQ(static_cast<Eigen::Index>(seen.size()), mesh.positions.rows());
    EXPECT_LE(colours.size(), 7);
}

TEST(GaussSeidel, EqualsADirectSolve) {
    const Mesh mesh = test::bar(20, 3);
    const auto n = mesh.positions.rows();
    const Lists neighbours = topology(n, mesh.triangles).neighbours;
    const Points d = test::shaken(modified_laplacian(mesh.positions, neighbours, 1.1, 0.9), 0.3);
    Eigen::SparseMatrix<double> matrix(n, n); // Eq. 10 with Eq. 12, written out
    for (int i = 0; i < n; ++i) {
        matrix.coeffRef(i, i) = 1.1;
        for (const int j : neighbours[i]) matrix.coeffRef(i, j) = -0.9 / static_cast<double>(neighbours[i].size());
    }
    matrix.makeCompressed();
    Eigen::SparseLU<Eigen::SparseMatrix<double>> lu(matrix);
    const Eigen::MatrixXd solution = lu.solve(Eigen::MatrixXd(d));
    const Points direct = solution;
    const auto solved = gauss_seidel(d, Points::Zero(n, 3), neighbours, colouring(neighbours), {1.1, 0.9, 1e-12, 500});
    EXPECT_TRUE(solved.report.converged);
    EXPECT_LT(solved.report.residual, 1e-10);
    EXPECT_LT(test::distance(solved.positions, direct), 1e-9);
}

TEST(GaussSeidel, FurtherApartIsFaster) {
    const Mesh mesh = test::bar(20, 3);
    const Lists neighbours = topology(mesh.positions.rows(), mesh.triangles).neighbours;
    int last = 1 << 20;
    for (const auto& [c1, c2] : {std::pair{1.01, 0.99}, {1.05, 0.95}, {1.1, 0.9}}) {
        const Points d = modified_laplacian(mesh.positions, neighbours, c1, c2);
        const auto solved =
            gauss_seidel(d, Points::Zero(d.rows(), 3), neighbours, colouring(neighbours), {c1, c2, 1e-6, 5000});
        EXPECT_TRUE(solved.report.converged);
        EXPECT_LT(solved.report.sweeps, last);
        last = solved.report.sweeps;
    }
}

TEST(GaussSeidel, SameBitsForAnyNumberOfThreads) {
    const Mesh mesh = test::bar(200, 12); // more vertices a colour than a grain of work
    const Lists neighbours = topology(mesh.positions.rows(), mesh.triangles).neighbours;
    const Points d = modified_laplacian(test::bent(mesh.positions, 1), neighbours, 1.1, 0.9);
    const auto solve = [&](int count) {
        set_threads(count);
        return gauss_seidel(d, mesh.positions, neighbours, colouring(neighbours), {1.1, 0.9, 1e-6, 50}).positions;
    };
    const Points one = solve(1), two = solve(2);
    set_threads(0);
    EXPECT_EQ(one, two);
}

TEST(GaussSeidel, TellsWhenItDidNotArrive) {
    const Mesh mesh = test::bar(20, 3);
    const Lists neighbours = topology(mesh.positions.rows(), mesh.triangles).neighbours;
    const Points d = modified_laplacian(mesh.positions, neighbours, 1.01, 0.99);
    const Points start = Points::Zero(d.rows(), 3);
    const auto few = gauss_seidel(d, start, neighbours, colouring(neighbours), {1.01, 0.99, 1e-9, 3});
    EXPECT_FALSE(few.report.converged);
    EXPECT_EQ(few.report.sweeps, 3);
    EXPECT_GT(few.report.residual, 1e-3);
    const auto stopped = gauss_seidel(d, start, neighbours, colouring(neighbours), {1.01, 0.99, 1e-9, 500},
                                      [](double, std::string_view) { return false; });
    EXPECT_FALSE(stopped.report.converged);
    EXPECT_EQ(stopped.report.sweeps, 1);
}

TEST(GaussSeidel, RefusesWhatCannotConverge) {
    const Points p = Points::Zero(1, 3);
    const Lists none = topology(1, Triangles(0, 3)).neighbours;
    EXPECT_THROW(gauss_seidel(p, p, none, colouring(none), {1, 1}), Error);
    EXPECT_THROW(gauss_seidel(p, p, none, colouring(none), {1, -1}), Error);
}

} // namespace
} // namespace meshtween
