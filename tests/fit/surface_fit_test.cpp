#include "meshtween/fit/surface_fit.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/align.h"
#include "meshtween/fit/settle.h"
#include "meshtween/fit/shell.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <map>
#include <numbers>

using namespace meshtween;

namespace {

// A bar whose sides all differ, so that it looks the same in one way only.
Mesh block() {
    return bar({1, 0.4, 0.25}, {16, 6, 4}, 0.05);
}

Points spin(const Points& points) {
    return turn(points, {1, 2, 3}, 2.0);
}

std::vector<Marker> vertex_markers(const Mesh& source, const Points& goals, int count) {
    std::vector<Marker> markers;
    for (int k = 0; k < count; ++k) {
        const auto t = static_cast<int>(k * source.triangles.rows() / count);
        markers.push_back({"m" + std::to_string(k), {t, {1, 0, 0}}, goals.row(source.triangles(t, 0))});
    }
    return markers;
}

double worst(const Points& a, const Points& b) {
    return (a - b).rowwise().norm().maxCoeff();
}

TEST(Align, RecoversASimilarity) {
    const Mesh m = block();
    const Points to = (2.5 * spin(m.positions)).rowwise() + Point(3, -4, 5);
    const Similarity s = align(m.positions, to);
    EXPECT_NEAR(s.scale, 2.5, 1e-12);
    EXPECT_LT(worst(s(m.positions), to), 1e-12);
}

TEST(Align, AMirrorImageIsNotASimilarity) {
    const Mesh m = block();
    Points to = m.positions;
    to.col(0) *= -1;
    EXPECT_NEAR(align(m.positions, to).rotation.determinant(), 1, 1e-12);
}

TEST(Align, OnePointMoves) {
    const Points from = Point(1, 2, 3), to = Point(4, 4, 4);
    EXPECT_LT(worst(align(from, to)(from), to), 1e-12);
}

TEST(Align, AxesFindATurnedCopy) {
    Mesh m = block();
    for (Eigen::Index i = 0; i < m.positions.rows(); ++i)
        if (m.positions(i, 0) > 0.5)
            m.positions.row(i).tail<2>() *= m.positions(i, 1) > 0 ? 2.5 : 1.5; // no symmetry left
    const Points to = (0.5 * spin(m.positions)).rowwise() + Point(1, 1, 1);
    EXPECT_LT(worst(align_axes(m.positions, m.triangles, to, m.triangles)(m.positions), to), 1e-9);
}

// The axes of what is nearly round turn anywhere.
TEST(Align, AxesThatTellNothingLeaveShapesAsTheyStand) {
    const Mesh m = sphere(3);
    Mesh bumpy = m;
    for (auto row : bumpy.positions.rowwise())
        row *= 1 + 0.02 * std::sin(4 * row[0] + 5 * row[1]) * std::cos(3 * row[2]);
    const Similarity s = align_axes(m.positions, m.triangles, bumpy.positions, bumpy.triangles);
    EXPECT_EQ(s.rotation, Eigen::Matrix3d::Identity());
    EXPECT_NEAR(s.scale, 1, 0.02);
}

TEST(Shell, BendingIsBlindToLinearMapsOfAPlaneAndOpenBordersToo) {
    Mesh m = bar({1, 1, 0.5}, {6, 6, 2});
    Triangles top(m.triangles.rows(), 3);
    Eigen::Index count = 0;
    for (Eigen::Index t = 0; t < m.triangles.rows(); ++t)
        if (triangle_normals(m.positions, m.triangles)(t, 2) > 0.9) top.row(count++) = m.triangles.row(t);
    top.conservativeResize(count, 3);
    const Shell s = shell(m.positions, top);
    BlockSystem system{s.pattern, s.bending, std::vector<Eigen::Matrix3d>(s.area.size(), Eigen::Matrix3d::Zero()), {}};
    Eigen::Matrix3d map;
    map << 2, 0.3, 0, -1, 0.5, 0, 0.7, 0.2, 1;
    EXPECT_LT(apply(system, m.positions * map).norm(), 1e-9);
    Points bent = m.positions;
    bent.col(2) += m.positions.col(0).cwiseProduct(m.positions.col(1)); // a saddle, whose Laplacian is nought
    EXPECT_GT(bent.cwiseProduct(apply(system, bent)).sum(), 0.1);
}

TEST(Shell, FramesOfATurnedShapeAreTheTurn) {
    const Mesh m = block();
    const Shell s = shell(m.positions, m.triangles);
    const Eigen::Matrix3d turned = 2 * Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    for (const auto& frame : local_frames(s, 2 * spin(m.positions), 3, true)) EXPECT_LT((frame - turned).norm(), 1e-9);
}

TEST(Shell, CalmedFramesKeepGreatTurnsAndForgetSmallOnes) {
    const auto frame = [](double angle, double scale) {
        return Eigen::Matrix3d(scale *
                               Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix());
    };
    const std::vector<Eigen::Matrix3d> frames{frame(0, 1.2), frame(0.15, 1.2), frame(0.3, 1.2), frame(1, 1.2)};
    const auto calm = calmed(frames, 0.3);
    EXPECT_LT((calm[0] - Eigen::Matrix3d::Identity()).norm(), 1e-12);
    EXPECT_LT((calm[1] - frame(0.075, std::sqrt(1.2))).norm(), 1e-12); // half of the way in the middle
    EXPECT_LT((calm[2] - frames[2]).norm(), 1e-12);
    EXPECT_LT((calm[3] - frames[3]).norm(), 1e-12);
    EXPECT_EQ(calmed(frames, 0)[1], frames[1]);
}

// A flat sheet of n x n squares, 1 x 1, in the plane z = 0.
Mesh sheet(int n) {
    Mesh m;
    m.positions.resize((n + 1) * (n + 1), 3);
    m.triangles.resize(2 * n * n, 3);
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) m.positions.row(i * (n + 1) + j) << 1.0 * i / n, 1.0 * j / n, 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const int a = i * (n + 1) + j, b = a + n + 1;
            m.triangles.row(2 * (i * n + j)) << a, b, a + 1;
            m.triangles.row(2 * (i * n + j) + 1) << b, b + 1, a + 1;
        }
    return m;
}

TEST(Settle, WhatAPinNamesGoesOnWhicheverWayItLooks) {
    Mesh wall = sheet(4);
    wall.positions = turn(wall.positions, {0, 1, 0}, std::numbers::pi / 2).rowwise() + Point(0.5, 0, 0.5);
    const FitTarget target = fit_target(wall.positions, wall.triangles);
    const Mesh floor = sheet(10);
    Points x = floor.positions;
    const int named = 5 * 11 + 5, other = 5 * 11 + 6;
    for (const int v : {named, other}) x(v, 0) += 0.005; // beside the wall, which stands at a right angle
    int t = 0;
    while (floor.triangles(t, 0) != named) ++t;
    const Pin pin{{t, {1, 0, 0}}, {0, 0, 0}, floor.positions.row(named), 1, 0};
    const Settled settled = settle(shell(floor.positions, floor.triangles), x, target, std::span(&pin, 1));
    EXPECT_LT((settled.positions.row(named) - floor.positions.row(named)).norm(), 1e-12);
    EXPECT_EQ(settled.positions.row(other), x.row(other));
}

TEST(SurfaceFit, WhatNoMarkerNamesIsCoveredToo) {
    const Mesh m = sphere(4);
    Mesh target = sphere(4);
    Eigen::Index tip = 0;
    target.positions.col(2).maxCoeff(&tip);
    for (Eigen::Index i = 0; i < target.positions.rows(); ++i) { // a horn as long as the ball
        const double away = (target.positions.row(i) - Point(0, 0, 1)).norm();
        target.positions.row(i) *= 1 + 2 * std::exp(-std::pow(away / 0.2, 2));
    }
    std::vector<Marker> markers;
    for (Marker& marker : vertex_markers(m, m.positions, 40))
        if (marker.target[2] < 0.3) markers.push_back(marker);
    ASSERT_GE(markers.size(), 4u);
    const FitResult r = surface_fit(m, target, markers);
    const ClosestPointIndex fitted(r.positions, m.triangles);
    for (Eigen::Index i = 0; i < target.positions.rows(); ++i)
        EXPECT_LT(fitted.closest(Point(target.positions.row(i))).squared_distance,
                  std::pow(0.02 * diagonal(target), 2))
            << target.positions.row(i);
}

// Without vertices on them, a cube's edges are missed by about a fifteenth of the template's.
TEST(SurfaceFit, SharpEdgesGetVertices) {
    const Mesh ball = sphere(4);
    const Mesh cube = bar({1, 1, 1}, {20, 20, 20});
    std::vector<Marker> markers;
    std::vector<Point> along;
    const ClosestPointIndex on_ball(ball);
    for (int k = 0; k < 8; ++k) {
        const Point corner(k & 1, (k >> 1 & 1) - 0.5, (k >> 2 & 1) - 0.5);
        const Points direction = spin(Points(corner - Point(0.5, 0, 0)));
        markers.push_back(
            {"corner " + std::to_string(k), on_ball.closest(Point(direction.row(0).normalized())).where, corner});
        for (int axis = 0; axis < 3; ++axis)
            if ((k >> axis & 1) == 0)
                for (double t = 0.01; t < 1; t += 0.02) along.push_back(corner + t * Point::Unit(axis));
    }
    const FitResult fitted = surface_fit(ball, cube, markers);
    const ClosestPointIndex surface(fitted.positions, ball.triangles);
    double mean = 0;
    for (const Point& place : along)
        mean += std::sqrt(surface.closest(place).squared_distance) / static_cast<double>(along.size());
    constexpr double edge = 0.05; // of 5120 even triangles on six squares
    EXPECT_LT(mean, edge / 150);
    EXPECT_TRUE(fitted.notes.empty()) << fitted.notes[0];
}

// Each triangle cut into four of its plane.
Mesh quartered(const Mesh& mesh) {
    Mesh result;
    const Eigen::Index n = mesh.positions.rows(), m = mesh.triangles.rows();
    const Topology t = topology(n, mesh.triangles);
    result.positions.resize(n + std::ssize(t.edges), 3);
    result.positions.topRows(n) = mesh.positions;
    std::map<std::array<int, 2>, int> middle;
    for (const Edge& edge : t.edges) {
        const auto [a, b] = edge.vertices;
        const int at = static_cast<int>(n) + static_cast<int>(middle.size());
        result.positions.row(at) = (mesh.positions.row(a) + mesh.positions.row(b)) / 2;
        middle[{std::min(a, b), std::max(a, b)}] = at;
    }
    result.triangles.resize(4 * m, 3);
    for (Eigen::Index f = 0; f < m; ++f) {
        std::array<int, 3> v{}, e{};
        for (int k = 0; k < 3; ++k) v[static_cast<std::size_t>(k)] = mesh.triangles(f, k);
        for (std::size_t k = 0; k < 3; ++k) {
            const int a = v[k], b = v[(k + 1) % 3];
            e[k] = middle.at({std::min(a, b), std::max(a, b)});
            result.triangles.row(4 * f + static_cast<Eigen::Index>(k)) << a, e[k], -1;
        }
        for (std::size_t k = 0; k < 3; ++k) result.triangles(4 * f + static_cast<Eigen::Index>(k), 2) = e[(k + 2) % 3];
        result.triangles.row(4 * f + 3) << e[0], e[1], e[2];
    }
    return result;
}

// Where vertices alone cling, bending leaves them a thirteenth of an edge beside their places.
TEST(SurfaceFit, FacetsTellWhereAlongThemVerticesBelong) {
    Mesh m = sphere(4);
    m.positions.col(1) *= 0.7;
    Mesh moved = m;
    for (auto row : moved.positions.rowwise()) {
        const Point p = row;
        row += 0.03 * Point(std::sin(3 * p[1]), std::sin(3 * p[2]), std::sin(3 * p[0]));
    }
    const FitResult fitted = surface_fit(m, quartered(moved), vertex_markers(m, moved.positions, 12));
    const double mean = (fitted.positions - moved.positions).rowwise().norm().mean();
    constexpr double edge = 0.06;
    EXPECT_LT(mean, edge / 40);
}

// Two legs below a ball, so long; markers on the ball alone.
Mesh legged(double length) {
    Mesh mesh = sphere(4);
    const std::array<Point, 2> legs{Point(0.5, -1, 0.2).normalized(), Point(-0.5, -1, 0).normalized()};
    for (auto row : mesh.positions.rowwise()) {
        double grown = 1;
        for (const Point& leg : legs)
            grown += length * std::exp(-std::pow(std::acos(std::min(1.0, row.dot(leg))) / 0.25, 4));
        row *= grown;
    }
    return mesh;
}

TEST(SurfaceFit, LegsWithoutMarkersReachTheGround) {
    const Mesh source = legged(0.4);
    Mesh target = legged(2);
    std::vector<Marker> markers;
    for (int t = 0; t < source.triangles.rows(); t += 157) {
        const int vertex = source.triangles(t, 0);
        if (source.positions.row(vertex).norm() < 1.01)
            markers.push_back({"m" + std::to_string(t), {t, {1, 0, 0}}, target.positions.row(vertex)});
    }
    const FitResult fitted = surface_fit(source, target, markers);
    const ClosestPointIndex surface(fitted.positions, source.triangles);
    double farthest = 0;
    for (const auto& row : target.positions.rowwise())
        farthest = std::max(farthest, std::sqrt(surface.closest(Point(row)).squared_distance));
    EXPECT_LT(farthest, 0.0075 * diagonal(target));
}

TEST(SurfaceFit, ABorderNearTheTargetsMeetsIt) {
    const Mesh m = sheet(12);
    Mesh target = sheet(17);
    target.positions.col(0) = 1.06 * target.positions.col(0).array() - 0.03;
    const std::vector<Marker> markers{{"a", {130, {1, 0, 0}}, m.positions.row(m.triangles(130, 0))},
                                      {"b", {150, {1, 0, 0}}, m.positions.row(m.triangles(150, 0))},
                                      {"c", {180, {1, 0, 0}}, m.positions.row(m.triangles(180, 0))}};
    const FitResult r = surface_fit(m, target, markers);
    for (int j = 0; j <= 12; ++j) {
        EXPECT_NEAR(r.positions(j, 0), -0.03, 1e-3);
        EXPECT_NEAR(r.positions(12 * 13 + j, 0), 1.03, 1e-3);
    }
}

TEST(SurfaceFit, ABorderFarFromTheTargetsIsNotDrawnToIt) {
    const Mesh m = sheet(12);
    Mesh target = sheet(30);
    target.positions = (2 * target.positions).rowwise() - Point(0.5, 0.5, 0);
    const FitResult r = surface_fit(m, target, vertex_markers(m, m.positions, 7));
    EXPECT_LT(worst(r.positions, m.positions), 1e-3);
}

TEST(SurfaceFit, AHoleBesideTheBorderDoesNotDrawIt) {
    const Mesh m = sheet(12);
    Mesh target = sheet(30);
    target.positions = (2 * target.positions).rowwise() - Point(0.5, 0.5, 0);
    std::vector<int> kept; // all but a slit of 0.4 x 0.07 just beyond the mesh's border at x = 0
    for (int t = 0; t < target.triangles.rows(); ++t) {
        Point centre(0, 0, 0);
        for (int k = 0; k < 3; ++k) centre += target.positions.row(target.triangles(t, k)) / 3;
        if (!(centre[0] < -0.03 && centre[0] > -0.1 && std::abs(centre[1] - 0.5) < 0.2)) kept.push_back(t);
    }
    target.triangles = Triangles(target.triangles(kept, Eigen::all));
    const FitResult r = surface_fit(m, target, vertex_markers(m, m.positions, 7));
    for (int j = 0; j <= 12; ++j) EXPECT_NEAR(r.positions(j, 0), 0, 0.005);
}

TEST(BorderSizes, AreThoseOfTheWholeBorder) {
    Mesh m = sheet(8);
    const Triangles hole = m.triangles.middleRows(2 * (3 * 8 + 3), 2); // of one square
    const Triangles before = m.triangles.topRows(2 * (3 * 8 + 3)), after = m.triangles.bottomRows(2 * (4 * 8 + 4));
    m.triangles.resize(before.rows() + after.rows(), 3);
    m.triangles << before, after;
    const std::vector<double> sizes =
        border_sizes(m.positions, border_edges(m.triangles, topology(m.positions.rows(), m.triangles)));
    EXPECT_NEAR(sizes[0], std::numbers::sqrt2, 1e-12);
    EXPECT_NEAR(sizes[static_cast<std::size_t>(hole(0, 0))], std::numbers::sqrt2 / 8, 1e-12);
    EXPECT_EQ(sizes[2 * 9 + 2], 0);
}

TEST(SurfaceFit, AMeshOnItselfStays) {
    const Mesh m = block();
    const FitResult r = surface_fit(m, m, vertex_markers(m, m.positions, 8));
    EXPECT_LT(worst(r.positions, m.positions), 1e-6);
}

TEST(SurfaceFit, FindsATurnedAndScaledCopy) {
    const Mesh m = block();
    Mesh target = m;
    target.positions = (3 * spin(m.positions)).rowwise() + Point(10, 0, -5);
    const FitResult r = surface_fit(m, target, vertex_markers(m, target.positions, 6));
    EXPECT_LT(worst(r.positions, target.positions), 1e-6 * diagonal(target));
}

TEST(SurfaceFit, PosesABentBar) {
    const Mesh m = bar({1, 0.2, 0.15}, {30, 6, 5}, 0.03), finer = bar({1, 0.2, 0.15}, {45, 8, 6}, 0.03);
    Mesh target = finer;
    target.positions = bend(finer.positions, 1, std::numbers::pi / 2);
    const Points truth = bend(m.positions, 1, std::numbers::pi / 2);
    const FitResult r = surface_fit(m, target, vertex_markers(m, truth, 24));
    EXPECT_LT((r.positions - truth).rowwise().norm().mean(), 0.01 * diagonal(target));
    EXPECT_TRUE(flipped_triangles(r.positions, m.triangles, fit_target(target.positions, target.triangles)).empty());
}

TEST(SurfaceFit, ATurnedTargetGivesTheSameShape) {
    const Mesh straight = bar({4, 1, 1}, {24, 6, 6}, 0.15);
    Mesh bent = bar({4, 1, 1}, {26, 7, 7}, 0.15); // another mesh, so that closest places are not corners
    bent.positions = bend(bent.positions, 4, 1.2);
    Mesh turned = bent;
    turned.positions = spin(bent.positions).rowwise() + Point(5, -3, 2);
    const Points goals = bend(straight.positions, 4, 1.2);
    const Points turned_goals = spin(goals).rowwise() + Point(5, -3, 2);
    const FitResult plain = surface_fit(straight, bent, vertex_markers(straight, goals, 12), {}, {});
    const FitResult other = surface_fit(straight, turned, vertex_markers(straight, turned_goals, 12), {}, {});
    EXPECT_LT(worst(spin(plain.positions).rowwise() + Point(5, -3, 2), other.positions), 1e-9);
}

TEST(SurfaceFit, TheSameBitsWithAnyNumberOfThreads) {
    const Mesh m = sphere(4);
    Mesh target = sphere(4);
    target.positions.col(0) *= 1.3;
    target.positions.col(1) += 0.1 * target.positions.col(0).cwiseAbs2();
    const auto markers = vertex_markers(m, target.positions, 10);
    set_threads(1);
    const FitResult one = surface_fit(m, target, markers);
    set_threads(2);
    const FitResult two = surface_fit(m, target, markers);
    set_threads(0);
    EXPECT_EQ(one.positions, two.positions);
}

TEST(SurfaceFit, CancelledAtAnyMomentItReturnsAWholeMesh) {
    const Mesh m = sphere(4);
    for (const int calls : {0, 3, 12}) {
        int left = calls;
        const FitResult r = surface_fit(m, m, vertex_markers(m, m.positions, 5), {},
                                        [&](double, std::string_view) { return left-- > 0; });
        EXPECT_EQ(r.end, FitEnd::cancelled);
        EXPECT_EQ(r.positions.rows(), m.positions.rows());
        EXPECT_TRUE(r.positions.allFinite());
    }
}

TEST(SurfaceFit, WithoutMarkersItSaysThatTheStartIsAGuess) {
    const Mesh m = block();
    const FitResult r = surface_fit(m, m, {});
    ASSERT_FALSE(r.notes.empty());
    EXPECT_NE(r.notes.front().find("guess"), std::string::npos);
    EXPECT_TRUE(r.positions.allFinite());
}

TEST(SurfaceFit, WatchSeesTheWholeMeshEachRound) {
    const Mesh m = sphere(4);
    Mesh target = m;
    target.positions.col(0) *= 1.4;
    int seen = 0;
    Points last;
    FitOptions options;
    options.watch = [&](const Points& x) {
        EXPECT_EQ(x.rows(), m.positions.rows());
        EXPECT_TRUE(x.allFinite());
        last = x;
        ++seen;
    };
    const FitResult r = surface_fit(m, target, vertex_markers(m, target.positions, 6), options);
    EXPECT_EQ(seen, r.rounds);
    EXPECT_LT(worst(last, r.positions), 0.01 * diagonal(target)); // settling alone comes after the last
}

TEST(SurfaceFit, MarkersPullAsHardAsTheirWeightSays) {
    const Mesh m = bar({1, 0.4, 0.25}, {32, 12, 8}, 0.05);
    std::vector<Marker> markers = vertex_markers(m, m.positions, 12);
    markers[5].target += Point(0.05, 0, 0); // what the others and the shape itself do not ask
    const auto miss = [&](double weight) {
        FitOptions options;
        options.marker_weight = weight;
        return (position(surface_fit(m, m, markers, options).positions, m.triangles, markers[5].source) -
                markers[5].target)
            .norm();
    };
    EXPECT_LT(miss(1), 0.2 * miss(0));
}

} // namespace
