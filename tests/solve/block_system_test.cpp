#include "meshtween/solve/block_system.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <random>

using namespace meshtween;

namespace {

constexpr int count = 60;

// A chain with springs and blocks, and squares of means of triples along it.
struct Chain {
    Lists neighbours;
    BlockSystem system; // set its couplings' neighbours where this stays
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(3 * count, 3 * count); // the same, x y z of each point in turn
    Points right = Points::Zero(count, 3);
};

Chain chain() {
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    Chain c;
    Lists rows;
    rows.first = {0};
    for (int i = 0; i < count; ++i) {
        for (int j = std::max(0, i - 1); j <= std::min(count - 1, i + 1); ++j) rows.items.push_back(j);
        rows.first.push_back(static_cast<int>(rows.items.size()));
    }
    c.system.pattern = std::make_shared<const Pattern>(pattern(std::move(rows)));
    for (int i = 0; i < count; ++i)
        for (int j = std::max(0, i - 1); j <= std::min(count - 1, i + 1); ++j) {
            const double value = i == j ? 2.1 : -1;
            c.system.values.push_back(value);
            c.dense.block<3, 3>(3 * i, 3 * j) += value * Eigen::Matrix3d::Identity();
        }
    c.neighbours.first = {0};
    for (int i = 0; i < count; ++i) {
        for (const int step : {-7, -4, -3, 3, 4, 7})
            if (i + step >= 0 && i + step < count) c.neighbours.items.push_back(i + step);
        c.neighbours.first.push_back(static_cast<int>(c.neighbours.items.size()));
    }
    Eigen::MatrixXd coupled = Eigen::MatrixXd::Zero(3 * count, 3 * count);
    for (int i = 0; i < count; ++i) {
        const Point d = Point(normal(random), normal(random), normal(random));
        c.system.blocks.push_back(0.1 * d.transpose() * d);
        c.right.row(i) << normal(random), normal(random), normal(random);
        if (i + 7 >= count) continue;
        const Point along = 2 * Point(normal(random), normal(random), normal(random));
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(3 * count);
        row.segment<3>(3 * i) = 0.2 * along;
        row.segment<3>(3 * (i + 3)) = 0.3 * along;
        row.segment<3>(3 * (i + 7)) = 0.5 * along;
        coupled += row.transpose() * row;
    }
    for (int i = 0; i < count; ++i) {
        c.system.blocks[static_cast<std::size_t>(i)] += coupled.block<3, 3>(3 * i, 3 * i);
        c.dense.block<3, 3>(3 * i, 3 * i) += c.system.blocks[static_cast<std::size_t>(i)];
        for (const int j : c.neighbours[i]) {
            c.system.couplings.blocks.push_back(rounded(coupled.block<3, 3>(3 * i, 3 * j)));
            c.dense.block<3, 3>(3 * i, 3 * j) += coupled.block<3, 3>(3 * i, 3 * j);
        }
    }
    return c;
}

Eigen::VectorXd flat(const Points& x) {
    return Eigen::Map<const Eigen::VectorXd>(x.data(), x.size());
}

TEST(BlockSystem, IsWhatItsPartsSay) {
    Chain c = chain();
    c.system.couplings.neighbours = &c.neighbours;
    EXPECT_LT((flat(apply(c.system, c.right)) - c.dense * flat(c.right)).norm(), 1e-7 * c.dense.norm());
}

TEST(BlockSystem, LumpedItIsNeverLess) {
    Chain c = chain();
    c.system.couplings.neighbours = &c.neighbours;
    Eigen::MatrixXd lumped = Eigen::MatrixXd::Zero(3 * count, 3 * count);
    for (int i = 0; i < count; ++i) {
        for (const int j : {i - 1, i, i + 1})
            if (j >= 0 && j < count)
                lumped.block<3, 3>(3 * i, 3 * j) += (i == j ? 2.1 : -1) * Eigen::Matrix3d::Identity();
        lumped.block<3, 3>(3 * i, 3 * i) += lumped_block(c.system, i);
    }
    const Eigen::VectorXd least =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(lumped - c.dense, Eigen::EigenvaluesOnly).eigenvalues();
    EXPECT_GT(least[0], -1e-7 * c.dense.norm());
    EXPECT_GT(least[3 * count - 1], 1e-3);
}

TEST(Multigrid, SolvesWithCouplingsOnOneGridAndOnTwo) {
    Chain c = chain();
    c.system.couplings.neighbours = &c.neighbours;
    const Eigen::VectorXd wanted = c.dense.ldlt().solve(flat(c.right));
    std::vector<std::array<int, 3>> corners;
    std::vector<Eigen::RowVector3d> weights;
    for (int i = 0; i < count; ++i) { // every other point
        corners.push_back({i / 2, std::min((i + 1) / 2, count / 2 - 1), 0});
        weights.emplace_back(0.5, 0.5, 0);
    }
    const std::vector<Interpolation> up{interpolation(count / 2, corners, weights)};
    BlockSystem coarse;
    Lists rows;
    rows.first = {0};
    for (int i = 0; i < count / 2; ++i) rows.items.push_back(i), rows.first.push_back(i + 1);
    coarse.pattern = std::make_shared<const Pattern>(pattern(std::move(rows)));
    coarse.values.assign(count / 2, 0.1);
    coarse.blocks = to_coarse(up[0], c.system);
    for (const bool two : {false, true}) {
        std::vector<BlockSystem> systems{c.system};
        if (two) systems.push_back(coarse);
        Points x = Points::Zero(count, 3);
        const auto factor = factor_pattern(systems.back().pattern);
        Points same = x;
        Multigrid(systems, up, 0, factor).solve(c.right, same, 200, 1e-7);
        Multigrid(std::move(systems), up, 0).solve(c.right, x, 200, 1e-7);
        EXPECT_EQ(x, same);
        EXPECT_LT((flat(x) - wanted).norm(), 1e-5 * wanted.norm()) << two;
    }
}

} // namespace
