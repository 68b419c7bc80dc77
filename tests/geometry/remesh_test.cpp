#include "meshtween/geometry/remesh.h"

#include "meshtween/geometry/halfedges.h"
#include "meshtween/geometry/isosurface.h"
#include "meshtween/geometry/measure.h"

#include "support/closed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meshtween {
namespace {

constexpr double pi = std::numbers::pi;

double ball(const Point& p) {
    return p.norm() - 1;
}
double ring(const Point& p) {
    return std::hypot(std::hypot(p[0], p[2]) - 1, p[1]) - 0.3;
}

double smallest_angle(const Mesh& mesh) {
    double least = pi;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Point a = mesh.positions.row(mesh.triangles(t, k)),
                        b = mesh.positions.row(mesh.triangles(t, (k + 1) % 3)),
                        c = mesh.positions.row(mesh.triangles(t, (k + 2) % 3));
            least = std::min(least, std::acos((b - a).normalized().dot((c - a).normalized())));
        }
    return least * 180 / pi;
}

TEST(Isosurface, BallIsClosedAndRound) {
    const Mesh mesh = isosurface(ball, {{-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}}, 0.1);
    EXPECT_TRUE(closed(mesh));
    EXPECT_EQ(euler(mesh), 2);
    EXPECT_NEAR(volume(mesh.positions, mesh.triangles), 4 * pi / 3, 0.03); // positive: outwards
    EXPECT_LT((mesh.positions.rowwise().norm().array() - 1).abs().maxCoeff(), 0.01);
}

TEST(Isosurface, EmptyWhereTheFieldHasOneSign) {
    EXPECT_EQ(isosurface([](const Point&) { return 1.0; }, {}, 0.2).triangles.rows(), 0);
}

TEST(Remesh, RingKeepsItsHandleAndItsShape) {
    const Mesh rough = isosurface(ring, {{-1.4, -0.4, -1.4}, {1.4, 0.4, 1.4}}, 0.06);
    ASSERT_EQ(euler(rough), 0);
    const RemeshOptions options{.deviation = 0.002, .shortest = 0.03, .longest = 0.12};
    const Mesh fine = remesh(rough, ring, options);
    EXPECT_TRUE(closed(fine));
    EXPECT_EQ(euler(fine), 0);
    EXPECT_LT(fine.positions.rows(), rough.positions.rows());
    double off = 0;
    for (Eigen::Index v = 0; v < fine.positions.rows(); ++v) off = std::max(off, std::abs(ring(fine.positions.row(v))));
    EXPECT_LT(off, 1e-6);
    EXPECT_GT(smallest_angle(fine), 20);
    EXPECT_NEAR(volume(fine.positions, fine.triangles), 2 * pi * pi * 0.09, 0.02);
}

TEST(Remesh, SameBitsTwice) {
    const Mesh rough = isosurface(ball, {{-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}}, 0.1);
    const RemeshOptions options{.deviation = 0.002, .shortest = 0.05, .longest = 0.2};
    const Mesh a = remesh(rough, ball, options), b = remesh(rough, ball, options);
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.triangles, b.triangles);
}

TEST(Halfedges, FlipAndBackSplitAndCollapse) {
    const Mesh rough = isosurface(ball, {{-1.2, -1.2, -1.2}, {1.2, 1.2, 1.2}}, 0.3);
    Halfedges s = halfedges(rough);
    const auto sound = [&] {
        for (int h = 0; h < s.count(); ++h)
            if (s.alive(h) && (s.other(s.other(h)) != h || s.origin(s.other(h)) != s.to(h))) return false;
        return true;
    };
    ASSERT_TRUE(sound());
    const int before = s.valence(s.origin(0)), a = s.origin(0), c = s.opposite(0), d = s.opposite(s.other(0));
    s.flip(0);
    EXPECT_TRUE(sound());
    EXPECT_EQ(s.valence(a), before - 1);
    EXPECT_TRUE(s.neighbours(c, d));
    const int middle = s.split(0, (s.at(c) + s.at(d)) / 2);
    EXPECT_TRUE(sound());
    EXPECT_EQ(s.valence(middle), 4);
    EXPECT_EQ(euler(compact(s)), 2);
    const int out = s.out[static_cast<std::size_t>(middle)];
    ASSERT_TRUE(s.may_collapse(out));
    s.collapse(out);
    EXPECT_TRUE(sound());
    EXPECT_EQ(euler(compact(s)), 2);
    EXPECT_EQ(compact(s).positions.rows(), rough.positions.rows());
}

} // namespace
} // namespace meshtween
