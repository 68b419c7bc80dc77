#include "meshtween/fit/sample_pulls.h"

#include "meshtween/fit/back_pulls.h"
#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

using namespace meshtween;

namespace {

struct Pulled {
    Shell shell;
    Points positions;
    std::vector<SamplePull> pulls;
    std::vector<double> shares;
};

// Random pulls of a ball, one of whose triangles has a vertex twice.
Pulled pulled() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(0.1, 1);
    std::normal_distribution<double> normal;
    const auto vector = [&] { return Point(normal(random), normal(random), normal(random)); };
    Mesh m = sphere(2);
    m.triangles.conservativeResize(m.triangles.rows() + 1, 3);
    m.triangles.bottomRows(1) << m.triangles(0, 0), m.triangles(0, 0), m.triangles(0, 1);
    Pulled p{shell(m.positions, m.triangles), m.positions, {}, {}};
    for (Eigen::Index v = 0; v < m.positions.rows(); ++v) p.shares.push_back(share(random));
    for (int k = 0; k < 500; ++k) {
        Eigen::RowVector3d at(share(random), share(random), share(random));
        at /= at.sum();
        const auto t = static_cast<int>((k * 7) % m.triangles.rows());
        p.pulls.push_back({{t, at}, 0.01 * vector(), vector().normalized(), share(random)});
    }
    p.pulls[3].where.triangle = -1; // none
    return p;
}

// Half of the gradient at x of the sum of what pulls cost, as points (`together`) or corner by corner.
Points gradient(const Pulled& p, const Points& x, bool together) {
    Points result = Points::Zero(x.rows(), 3);
    const Points moved = x - p.positions;
    for (const SamplePull& pull : p.pulls) {
        if (pull.where.triangle < 0) continue;
        const auto corners = p.shell.triangles.row(pull.where.triangle);
        double least = 1;
        for (const int v : corners) least = std::min(least, p.shares[static_cast<std::size_t>(v)]);
        for (int c = 0; c < 3; ++c) {
            const Point by = together ? position(moved, p.shell.triangles, pull.where) : Point(moved.row(corners[c]));
            const double share = together ? least : p.shares[static_cast<std::size_t>(corners[c])];
            result.row(corners[c]) +=
                share * pull.strength * pull.where.barycentric[c] * pull.direction.dot(by - pull.way) * pull.direction;
        }
    }
    return result;
}

TEST(SamplePulls, AreTheGradientOfWhatTheyCost) {
    Pulled p = pulled();
    for (const bool together : {false, true}) {
        if (together) // all but the triangle without a size
            for (SamplePull& pull : p.pulls)
                if (pull.where.triangle + 1 == p.shell.triangles.rows()) pull.where.triangle = -1;
        BlockSystem system;
        system.pattern = p.shell.pattern;
        system.values.assign(p.shell.bending.size(), 0);
        system.blocks.assign(p.shell.area.size(), Eigen::Matrix3d::Zero());
        Points right = Points::Zero(p.positions.rows(), 3);
        add_pulls(p.pulls, p.shares, together ? 1 : 0, p.shell, p.positions, system, right);
        EXPECT_EQ(system.couplings.empty(), !together);
        const Points x = (1.1 * p.positions).rowwise() + Point(0.05, 0.1, -0.02);
        const Points wanted = gradient(p, x, together);
        EXPECT_LT((apply(system, x) - right - wanted).norm(), 1e-6 * wanted.norm()) << together;
    }
}

TEST(BackPulls, OneOfSeveralNeighboursPullsForAllOfThem) {
    const Mesh m = sphere(2);
    const Mesh fine = sphere(5);
    const FitTarget target = fit_target(fine.positions, fine.triangles);
    const Shell coarse = shell(m.positions, m.triangles);
    ASSERT_GE(fine.positions.rows(), 8 * m.triangles.rows());
    const auto strengths = [&](int round) {
        RelaxMemory memory;
        bring_mesh(memory, coarse, m.positions);
        std::vector<double> list;
        for (const SamplePull& pull : back_pulls(coarse, m.positions, target, 1, 1, round, memory))
            list.push_back(pull.strength);
        return list;
    };
    const std::vector<double> one = strengths(0), other = strengths(1);
    EXPECT_LT(one.size(), 3 * static_cast<double>(m.triangles.rows()));
    EXPECT_NEAR(std::accumulate(one.begin(), one.end(), 0.0), 1, 0.05); // normals differ a little
    EXPECT_NE(one, other);
}

} // namespace
