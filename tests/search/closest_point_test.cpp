#include "meshtween/search/closest_point.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/search/wide_build.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <random>

namespace meshtween {
namespace {

// Ericson, Real-Time Collision Detection, 5.1.5, by its Voronoi regions: another way than the one under test. In long
// double, for triangles with area.
long double reference_distance(const Point& query, const Point& a0, const Point& b0, const Point& c0) {
    using V = Eigen::Matrix<long double, 1, 3>;
    const V p = query.cast<long double>(), a = a0.cast<long double>(), b = b0.cast<long double>(),
            c = c0.cast<long double>();
    const V ab = b - a, ac = c - a;
    const long double d1 = ab.dot(p - a), d2 = ac.dot(p - a), d3 = ab.dot(p - b), d4 = ac.dot(p - b),
                      d5 = ab.dot(p - c), d6 = ac.dot(p - c);
    if (d1 <= 0 && d2 <= 0) return (p - a).norm();
    if (d3 >= 0 && d4 <= d3) return (p - b).norm();
    if (d6 >= 0 && d5 <= d6) return (p - c).norm();
    const long double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return (p - a - d1 / (d1 - d3) * ab).norm();
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return (p - a - d2 / (d2 - d6) * ac).norm();
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return (p - b - (d4 - d3) / (d4 - d3 + d5 - d6) * (c - b)).norm();
    return (p - a - vb / (va + vb + vc) * ab - vc / (va + vb + vc) * ac).norm();
}

// For slivers, on which the regions' divisions go wrong: the edges' distances, and the plane's where the foot is
// inside.
long double sliver_distance(const Point& query, const Point& a, const Point& b, const Point& c) {
    using V = Eigen::Matrix<long double, 1, 3>;
    const V corners[3] = {a.cast<long double>(), b.cast<long double>(), c.cast<long double>()};
    const V p = query.cast<long double>(), n = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    long double best = std::numeric_limits<long double>::infinity();
    bool inside = n.norm() > 0;
    for (int k = 0; k < 3; ++k) {
        const V from = corners[k], edge = corners[(k + 1) % 3] - from;
        const long double length = edge.squaredNorm(),
                          t = length > 0 ? std::clamp(edge.dot(p - from) / length, 0.0L, 1.0L) : 0;
        best = std::min(best, (p - from - t * edge).norm());
        inside = inside && edge.cross(p - from).dot(n) >= 0;
    }
    return inside ? std::min(best, std::abs(n.dot(p - corners[0])) / n.norm()) : best;
}

double nearest_by_trying_all(const Points& positions, const Triangles& triangles, const Point& query,
                             long double (*distance)(const Point&, const Point&, const Point&,
                                                     const Point&) = reference_distance) {
    long double best = std::numeric_limits<long double>::infinity();
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        best = std::min(best, distance(query, positions.row(triangles(t, 0)), positions.row(triangles(t, 1)),
                                       positions.row(triangles(t, 2))));
    return static_cast<double>(best);
}

Points random_points(Eigen::Index count, double size, unsigned seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> coordinate(-size, size);
    return Points::NullaryExpr(count, 3, [&] { return coordinate(random); });
}

// Triangles thrown at random, of as many sizes as `variety` says from half the whole downwards: they overlap.
Mesh soup(Eigen::Index count, unsigned seed, Eigen::Index variety = 50) {
    Mesh mesh;
    const Points centres = random_points(count, 1, seed), corners = random_points(3 * count, 1, seed + 1);
    mesh.positions.resize(3 * count, 3);
    mesh.triangles.resize(count, 3);
    for (Eigen::Index t = 0; t < count; ++t)
        for (int k = 0; k < 3; ++k) {
            const double shrink = 1.0 / static_cast<double>(2 + t % variety);
            mesh.positions.row(3 * t + k) = centres.row(t) + shrink * corners.row(3 * t + k);
            mesh.triangles(t, k) = static_cast<int>(3 * t + k);
        }
    return mesh;
}

// Slivers of every kind beside sound triangles: needles, caps (an angle near 180 degrees), nearly a point.
Mesh slivers(Eigen::Index count, unsigned seed) {
    Mesh mesh = soup(count, seed);
    for (Eigen::Index t = 0; t < count; ++t) {
        const double thin = std::pow(10.0, -static_cast<double>(t % 14));
        const Point a = mesh.positions.row(3 * t), b = mesh.positions.row(3 * t + 1),
                    off = mesh.positions.row(3 * t + 2) - a;
        if (t % 3 == 0) mesh.positions.row(3 * t + 2) = a + thin * off;
        if (t % 3 == 1) mesh.positions.row(3 * t + 2) = 0.3 * a + 0.7 * b + thin * off;
        if (t % 3 == 2 && thin < 1e-3)
            for (int k = 1; k < 3; ++k) mesh.positions.row(3 * t + k) = a + thin * (mesh.positions.row(3 * t + k) - a);
    }
    return mesh;
}

// A wavy square of n x n cells in the plane z = 0 (height 0) or about it.
Mesh sheet(int n, double height) {
    Mesh mesh;
    mesh.positions.resize((n + 1) * (n + 1), 3);
    mesh.triangles.resize(2 * n * n, 3);
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            const double x = double(i) / n, y = double(j) / n;
            mesh.positions.row(j * (n + 1) + i) << x, y, height * std::sin(9 * x) * std::cos(7 * y);
        }
    for (int j = 0, t = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i, b = a + 1, c = a + n + 1, d = c + 1;
            mesh.triangles.row(t++) << a, b, d;
            mesh.triangles.row(t++) << a, d, c;
        }
    return mesh;
}

void expect_same_bits(const ClosestPoint& x, const ClosestPoint& y) {
    EXPECT_EQ(x.where.triangle, y.where.triangle);
    EXPECT_EQ(x.where.barycentric, y.where.barycentric);
    EXPECT_EQ(x.position, y.position);
    EXPECT_EQ(x.squared_distance, y.squared_distance);
}

void expect_consistent(const Mesh& mesh, const Point& query, const ClosestPoint& answer) {
    ASSERT_TRUE(answer.found());
    EXPECT_NEAR(answer.where.barycentric.sum(), 1, 1e-12);
    EXPECT_GE(answer.where.barycentric.minCoeff(), -1e-12);
    const double scale = std::max(mesh.positions.cwiseAbs().maxCoeff(), query.cwiseAbs().maxCoeff());
    EXPECT_NEAR((answer.position - query).norm(), std::sqrt(answer.squared_distance), 1e-14 * scale);
    EXPECT_LE((answer.position - position(mesh.positions, mesh.triangles, answer.where)).norm(), 1e-14 * scale);
}

TEST(ClosestPoint, AgreesWithTryingAllTriangles) {
    for (const Eigen::Index count : {1, 2, 7, 40, 700}) {
        const Mesh mesh = soup(count, 3);
        const ClosestPointIndex index(mesh);
        const Points queries = random_points(300, 1.5, 17);
        for (Eigen::Index i = 0; i < queries.rows(); ++i) {
            const ClosestPoint answer = index.closest(queries.row(i));
            expect_consistent(mesh, queries.row(i), answer);
            EXPECT_NEAR(std::sqrt(answer.squared_distance),
                        nearest_by_trying_all(mesh.positions, mesh.triangles, queries.row(i)), 1e-14);
        }
    }
}

TEST(ClosestPoint, IsTheFootOnAPlane) {
    const ClosestPointIndex index(sheet(8, 0));
    const ClosestPoint inside = index.closest({0.3, 0.4, -2});
    EXPECT_LE((inside.position - Point(0.3, 0.4, 0)).norm(), 1e-15);
    EXPECT_DOUBLE_EQ(inside.squared_distance, 4);
    const ClosestPoint corner = index.closest({2, -1, 0});
    EXPECT_EQ(corner.position, Point(1, 0, 0));
    EXPECT_DOUBLE_EQ(corner.squared_distance, 2);
}

TEST(ClosestPoint, IsTheQueryItselfOnTheSurface) {
    const Mesh mesh = sheet(12, 0.1);
    const ClosestPointIndex index(mesh);
    for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v)
        EXPECT_EQ(index.closest(mesh.positions.row(v)).squared_distance, 0);
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
        const Point inside = position(mesh.positions, mesh.triangles, {static_cast<int>(t), {0.2, 0.5, 0.3}});
        EXPECT_LE(std::sqrt(index.closest(inside).squared_distance), 1e-15);
    }
}

TEST(ClosestPoint, WorksFarFromTheOriginAndFarFromTheSurface) {
    for (const double shift : {0.0, 1e3, 1e7}) {
        Mesh mesh = soup(300, 5);
        mesh.positions.rowwise() += Point(shift, -shift, 2 * shift);
        const ClosestPointIndex index(mesh);
        for (const double away : {1.0, 20.0, 1e3, 1e6, 1e12}) {
            Points queries = random_points(60, away, 23);
            queries.rowwise() += Point(shift, -shift, 2 * shift);
            for (Eigen::Index i = 0; i < queries.rows(); ++i) {
                const double expected = nearest_by_trying_all(mesh.positions, mesh.triangles, queries.row(i));
                EXPECT_NEAR(std::sqrt(index.closest(queries.row(i)).squared_distance), expected,
                            1e-15 * (expected + 4 * shift));
            }
        }
    }
}

TEST(ClosestPoint, WorksForHugeAndTinyUnits) {
    for (const double unit : {1e-30, 1e-12, 1e12, 1e30}) {
        Mesh mesh = soup(300, 7);
        mesh.positions *= unit;
        const ClosestPointIndex index(mesh);
        const Points queries = random_points(60, unit, 29);
        for (Eigen::Index i = 0; i < queries.rows(); ++i)
            EXPECT_NEAR(std::sqrt(index.closest(queries.row(i)).squared_distance) / unit,
                        nearest_by_trying_all(mesh.positions, mesh.triangles, queries.row(i)) / unit, 1e-14);
    }
}

TEST(ClosestPoint, TakesTrianglesWithoutAreaAsPointsAndEdges) {
    Points positions(5, 3);
    positions << 0, 0, 0, 1, 0, 0, 3, 0, 0, 5, 5, 5, 5, 5, 5;
    Triangles triangles(3, 3);
    triangles << 0, 1, 2, 3, 3, 4, 1, 0, 1;
    const ClosestPointIndex index(positions, triangles);
    EXPECT_TRUE(index.normals().isZero(0));
    const ClosestPoint edge = index.closest({2.5, 1, 0});
    EXPECT_EQ(edge.where.triangle, 0);
    EXPECT_LE((edge.position - Point(2.5, 0, 0)).norm(), 1e-15);
    const ClosestPoint point = index.closest({5, 5, 7});
    EXPECT_EQ(point.where.triangle, 1);
    EXPECT_EQ(point.position, Point(5, 5, 5));
}

TEST(ClosestPoint, AHintChangesNothing) {
    // In the soup more leaves overlap than a neighbourhood holds.
    for (const Mesh& mesh : {sheet(20, 0.2), soup(800, 73, 2), slivers(600, 79)}) {
        const ClosestPointIndex index(mesh);
        const Points queries = random_points(1000, 1.2, 31);
        std::mt19937_64 random(1);
        std::uniform_int_distribution<int> any(0, static_cast<int>(mesh.triangles.rows()) - 1);
        for (Eigen::Index i = 0; i < queries.rows(); ++i) {
            const ClosestPoint plain = index.closest(Point(queries.row(i)));
            for (const int hint : {any(random), any(random), any(random), plain.where.triangle, -1, 1 << 30})
                expect_same_bits(index.closest(Point(queries.row(i)), hint), plain);
        }
    }
}

TEST(ClosestPoint, OfEquallyCloseTrianglesTheFirstAnswers) {
    Mesh mesh = sheet(6, 0);
    const Triangles once = mesh.triangles;
    mesh.triangles.resize(2 * once.rows(), 3);
    mesh.triangles << once, once;
    const ClosestPointIndex index(mesh);
    for (Eigen::Index v = 0; v < mesh.positions.rows(); ++v) {
        int first = 0;
        while ((once.row(first).array() != static_cast<int>(v)).all()) ++first;
        EXPECT_EQ(index.closest(Point(mesh.positions.row(v))).where.triangle, first);
    }
}

TEST(ClosestPoint, CompatibleAnswersObeyTheCone) {
    const Mesh mesh = soup(500, 11);
    const ClosestPointIndex index(mesh);
    const Points queries = random_points(200, 1.2, 37);
    for (Eigen::Index i = 0; i < queries.rows(); ++i) {
        const Point query = queries.row(i);
        const Compatible compatible{queries.row((i + 1) % queries.rows()).normalized(), 0.7};
        const ClosestPoint answer = index.closest(query, compatible);
        long double expected = std::numeric_limits<long double>::infinity();
        for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
            if (index.normals().row(t).dot(compatible.normal) >= compatible.least_cosine)
                expected = std::min(expected, reference_distance(query, mesh.positions.row(mesh.triangles(t, 0)),
                                                                 mesh.positions.row(mesh.triangles(t, 1)),
                                                                 mesh.positions.row(mesh.triangles(t, 2))));
        ASSERT_TRUE(answer.found());
        EXPECT_GE(index.normals().row(answer.where.triangle).dot(compatible.normal), compatible.least_cosine);
        EXPECT_NEAR(std::sqrt(answer.squared_distance), static_cast<double>(expected), 1e-14);
        for (int hint = 0; hint < 500; hint += 50) expect_same_bits(index.closest(query, compatible, 10, hint), answer);
    }
}

TEST(ClosestPoint, FindsNothingBeyondTheBound) {
    const ClosestPointIndex index(sheet(4, 0));
    EXPECT_TRUE(index.closest({0.5, 0.5, 0.25}, {}, 0.25).found());
    EXPECT_FALSE(index.closest({0.5, 0.5, 0.25}, {}, 0.2499).found());
    EXPECT_FALSE(index.closest({0.5, 0.5, 0.25}, {}, 0.2499, 3).found());
    EXPECT_TRUE(index.closest({0.5, 0.5, 0}, {}, 0).found());
    EXPECT_TRUE(index.closest({0.5, 0.5, 1}, {{0, 0, 1}, 0.5}).found());
    EXPECT_FALSE(index.closest({0.5, 0.5, 1}, {{0, 0, -1}, 0.5}).found());
    EXPECT_FALSE(index.closest({std::nan(""), 0, 0}).found());
}

TEST(ClosestPoint, FindsNothingCompatibleFarAway) {
    const ClosestPointIndex index(sheet(6, 0));
    for (const double away : {1.0, 1e4, 1e12, 1e150}) {
        EXPECT_FALSE(index.closest({0.5, away, away}, {{0, 0, -1}, 0.5}).found());
        const ClosestPoint answer = index.closest({0.5, away, away}, {{0, 0, 1}, 0.5});
        ASSERT_TRUE(answer.found());
        EXPECT_NEAR(answer.squared_distance / away / away, 1 + (1 - 1 / away) * (1 - 1 / away), 1e-12);
    }
}

TEST(ClosestPoint, ARowOfQueriesIsEachQueryWithAnyNumberOfThreads) {
    const Mesh mesh = sheet(30, 0.2);
    const ClosestPointIndex index(mesh);
    const Points queries = random_points(3000, 1.2, 41);
    std::vector<int> hints;
    for (Eigen::Index i = 0; i < queries.rows(); ++i)
        hints.push_back(static_cast<int>(i * 7919 % mesh.triangles.rows()));
    set_threads(1);
    const std::vector<ClosestPoint> one = index.closest(queries);
    set_threads(2);
    const std::vector<ClosestPoint> two = index.closest(queries), hinted = index.closest(queries, hints);
    set_threads(0);
    ASSERT_EQ(one.size(), 3000u);
    for (std::size_t i = 0; i < one.size(); ++i) {
        expect_same_bits(one[i], index.closest(queries.row(static_cast<Eigen::Index>(i))));
        expect_same_bits(one[i], two[i]);
        expect_same_bits(one[i], hinted[i]);
    }
}

TEST(ClosestPoint, AgreesWithTryingAllSlivers) {
    const Mesh mesh = slivers(600, 43);
    const ClosestPointIndex index(mesh);
    Points queries = random_points(300, 1.2, 47);
    for (Eigen::Index i = 0; i < 100; ++i) // on the triangles, where a wrong decision costs most
        queries.row(i) = position(mesh.positions, mesh.triangles, {static_cast<int>(5 * i), {0.2, 0.3, 0.5}});
    for (Eigen::Index i = 0; i < queries.rows(); ++i) {
        const ClosestPoint answer = index.closest(Point(queries.row(i)));
        expect_consistent(mesh, queries.row(i), answer);
        // Doubles lose the inside of a sliver whose height is a hundred-millionth of its length, and no more than that.
        EXPECT_NEAR(std::sqrt(answer.squared_distance),
                    nearest_by_trying_all(mesh.positions, mesh.triangles, queries.row(i), sliver_distance), 1e-8);
    }
}

TEST(ClosestPoint, OfAllTrianglesOfASphereTheFirstAnswersItsCentre) {
    // An octahedron, so that all distances are the same to the last bit, many times over.
    Mesh mesh;
    mesh.positions.resize(6, 3);
    mesh.positions << 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
    mesh.triangles.resize(800, 3);
    for (int t = 0; t < 800; ++t) mesh.triangles.row(t) << (t & 1), 2 + (t >> 1 & 1), 4 + (t >> 2 & 1);
    const ClosestPointIndex index(mesh);
    for (int hint = -1; hint < 800; hint += 50) {
        const ClosestPoint answer = index.closest({0, 0, 0}, hint);
        EXPECT_EQ(answer.where.triangle, 0);
        EXPECT_NEAR(answer.squared_distance, 1.0 / 3, 1e-15);
    }
}

TEST(ClosestPoint, EveryWidthGivesTheSameBits) {
    const Mesh sphere_mesh = sphere(4), sliver_mesh = slivers(900, 53);
    const std::vector<search::NamedSearch> searches = search::searches();
    for (const Mesh& mesh : {sphere_mesh, sliver_mesh}) {
        const ClosestPointIndex index(mesh);
        for (const double away : {0.9, 1.1, 3.0, 50.0}) {
            const Points queries = random_points(500, away, 59);
            for (Eigen::Index i = 0; i < queries.rows(); ++i) {
                const Point query = queries.row(i);
                const Compatible compatible{queries.row((i + 1) % queries.rows()).normalized(), 0.3};
                const int hint = static_cast<int>(i * 31 % mesh.triangles.rows());
                search::use_search(searches.front().search);
                const ClosestPoint plain = index.closest(query), choosy = index.closest(query, compatible, 2 * away);
                for (const auto& wider : searches) {
                    search::use_search(wider.search);
                    expect_same_bits(index.closest(query), plain);
                    expect_same_bits(index.closest(query, hint), plain);
                    expect_same_bits(index.closest(query, compatible, 2 * away, hint), choosy);
                }
                search::use_search(nullptr);
            }
        }
    }
}

TEST(ClosestPoint, AWarmHintFindsWhatACleanSearchFinds) {
    // As in a fit: the queries creep towards the surface, the last answer is the hint; also where sheets lie close.
    Mesh mesh = sphere(5);
    const Mesh once = mesh;
    mesh.positions.resize(2 * once.positions.rows(), 3);
    mesh.positions << once.positions, 0.97 * once.positions;
    mesh.triangles.resize(2 * once.triangles.rows(), 3);
    mesh.triangles << once.triangles, once.triangles.array() + static_cast<int>(once.positions.rows());
    const ClosestPointIndex index(mesh);
    Points queries = random_points(1000, 1, 61);
    std::vector<int> hints(1000, -1);
    for (int round = 0; round < 6; ++round) {
        const std::vector<ClosestPoint> answers = index.closest(queries, hints);
        for (Eigen::Index i = 0; i < queries.rows(); ++i) {
            const auto k = static_cast<std::size_t>(i);
            expect_same_bits(answers[k], index.closest(Point(queries.row(i))));
            hints[k] = answers[k].where.triangle;
            queries.row(i) += 0.5 * (answers[k].position - queries.row(i));
        }
    }
}

TEST(ClosestPoint, AMovedMeshAnswersAsANewOne) {
    for (const Mesh& mesh : {sheet(20, 0.2), soup(800, 73, 2), slivers(600, 79)}) {
        ClosestPointIndex index(mesh.positions, mesh.triangles, MeshIs::moving);
        Points moved = mesh.positions;
        for (Eigen::Index i = 0; i < moved.rows(); ++i)
            moved.row(i) += 0.3 * Point(std::sin(3 * moved(i, 1)), std::cos(2 * moved(i, 2)), std::sin(moved(i, 0)));
        index.move(moved);
        const ClosestPointIndex fresh(moved, mesh.triangles);
        const Points queries = random_points(1000, 1.2, 37), normals = random_points(1000, 1, 41);
        for (Eigen::Index i = 0; i < queries.rows(); ++i) {
            const Point query = queries.row(i);
            const Compatible compatible{normals.row(i).normalized(), 0};
            expect_same_bits(index.closest(query), fresh.closest(query));
            expect_same_bits(index.closest(query, compatible, 0.4, static_cast<int>(i % mesh.triangles.rows())),
                             fresh.closest(query, compatible, 0.4));
        }
    }
}

TEST(ClosestPoint, BadMeshesAreTold) {
    EXPECT_THROW(ClosestPointIndex(Points(0, 3), Triangles(0, 3)), Error);
    Mesh mesh = sheet(2, 0);
    mesh.triangles(1, 2) = 99;
    EXPECT_THROW(ClosestPointIndex{mesh}, Error);
    mesh = sheet(2, 0);
    mesh.positions(4, 1) = std::nan("");
    EXPECT_THROW(ClosestPointIndex{mesh}, Error);
    mesh = sheet(2, 0);
    ClosestPointIndex index(mesh);
    EXPECT_THROW(index.move(mesh.positions.topRows(3)), Error);
}

} // namespace
} // namespace meshtween
