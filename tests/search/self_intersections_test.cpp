#include "meshtween/search/self_intersections.h"

#include "meshtween/core/parallel.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace meshtween {
namespace {

using Pairs = std::vector<std::array<int, 2>>;

// Triangles of their own: three rows a triangle, nothing shared.
Pairs pairs_of_soup(const Points& positions, double gap = 0) {
    Triangles triangles(positions.rows() / 3, 3);
    for (int i = 0; i < static_cast<int>(positions.rows()); ++i) triangles(i / 3, i % 3) = i;
    return self_intersections(positions, triangles, gap);
}

bool two_meet(const Points& first, const Points& second, double gap = 0) {
    Points positions(6, 3);
    positions << first, second;
    const bool meet = !pairs_of_soup(positions, gap).empty();
    positions << second.colwise().reverse(), first; // neither order nor turn matters
    EXPECT_EQ(!pairs_of_soup(positions, gap).empty(), meet);
    return meet;
}

Points triangle(const Point& a, const Point& b, const Point& c) {
    Points result(3, 3);
    result << a, b, c;
    return result;
}

const Points flat = triangle({0, 0, 0}, {4, 0, 0}, {0, 4, 0});

TEST(SelfIntersections, TrianglesThatPierce) {
    EXPECT_TRUE(two_meet(flat, triangle({1, 1, -1}, {1, 1, 1}, {9, 9, 1})));
    EXPECT_TRUE(two_meet(flat, triangle({-1, 1, -1}, {9, 1, -1}, {1, 1, 3})));
    EXPECT_FALSE(two_meet(flat, triangle({3, 3, -1}, {3, 3, 1}, {9, 9, 1})));
    EXPECT_FALSE(two_meet(flat, triangle({1, 1, 1e-9}, {1, 2, 1}, {2, 1, 1})));
}

TEST(SelfIntersections, TouchingIsMeeting) {
    EXPECT_TRUE(two_meet(flat, triangle({1, 1, 0}, {1, 2, 1}, {2, 1, 1})));  // a corner on the face
    EXPECT_TRUE(two_meet(flat, triangle({2, 0, 0}, {2, -2, 1}, {2, 0, 1}))); // a corner on an edge
    EXPECT_TRUE(two_meet(flat, triangle({4, 0, 0}, {9, 0, 1}, {9, 1, 1})));  // corner to corner
    EXPECT_TRUE(two_meet(flat, triangle({1, -1, 0}, {1, 1, 0}, {1, 0, 5}))); // an edge in the plane
    EXPECT_FALSE(two_meet(flat, triangle({std::nextafter(4.0, 5.0), 0, 0}, {9, 0, 1}, {9, 1, 1})));
}

TEST(SelfIntersections, WithAGapWhatAlmostTouchesCounts) {
    const auto above = [](double height) { return triangle({1, 1, height}, {1, 2, 1}, {2, 1, 1}); };
    EXPECT_FALSE(two_meet(flat, above(1e-9)));
    EXPECT_TRUE(two_meet(flat, above(1e-9), 1e-7));
    EXPECT_FALSE(two_meet(flat, above(1e-6), 1e-7));
    const auto sheet = [](double x, double height) { return triangle({x, 1, height}, {x + 1, 1, 0}, {x, 2, -height}); };
    EXPECT_TRUE(two_meet(flat, sheet(0.5, 1e-9), 1e-7)) << "within the face, all but in its plane";
    EXPECT_FALSE(two_meet(flat, sheet(3.5, 1e-9), 1e-7)) << "beside it";
    Points corner(5, 3); // two faces of a flat sheet with one corner in common
    corner << 0, 0, 0, 4, 0, 0, 0, 4, 0, -4, 0, 1e-9, 0, -4, 1e-9;
    EXPECT_TRUE(self_intersections(corner, Triangles{{0, 1, 2}, {0, 3, 4}}, 1e-7).empty());
    corner.row(3) << -0.5, 1, 0.9e-7; // the line between them meets the face, far beyond the end that is near its plane
    corner.row(4) << -0.9, 1, 1.1e-7;
    EXPECT_TRUE(self_intersections(corner, Triangles{{0, 1, 2}, {0, 3, 4}}, 1e-7).empty());
}

TEST(SelfIntersections, TrianglesInOnePlane) {
    EXPECT_TRUE(two_meet(flat, triangle({1, 1, 0}, {1.5, 1, 0}, {1, 1.5, 0}))); // one holds the other
    EXPECT_TRUE(two_meet(flat, triangle({-1, 1, 0}, {9, 1, 0}, {9, 2, 0})));    // edges cross
    EXPECT_TRUE(two_meet(flat, flat));
    EXPECT_TRUE(two_meet(flat, triangle({0, 0, 0}, {4, 0, 0}, {0, -4, 0}))); // edge to edge
    EXPECT_FALSE(two_meet(flat, triangle({2.5, 2.5, 0}, {4, 4, 0}, {2.5, 4, 0})));
    EXPECT_FALSE(two_meet(flat, triangle({5, 0, 0}, {9, 0, 0}, {9, 1, 0}))); // along one line
    // Standing on edge, where the first projection has no area.
    const Points standing = triangle({0, 0, 0}, {0, 0, 4}, {0, 4, 0});
    EXPECT_TRUE(two_meet(standing, triangle({0, 1, 1}, {0, 9, 9}, {0, 9, 8})));
    EXPECT_FALSE(two_meet(standing, triangle({0, 3, 3}, {0, 9, 9}, {0, 9, 8})));
}

TEST(SelfIntersections, FacesWithASharedVertex) {
    Points positions(5, 3);
    positions << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, 1, 1, 1, -1;
    Triangles triangles(2, 3);
    triangles << 0, 1, 2, 3, 0, 4;
    EXPECT_EQ(self_intersections(positions, triangles), (Pairs{{0, 1}})); // the edge opposite pierces the face
    positions.row(4) << 1, 1, 2;
    EXPECT_TRUE(self_intersections(positions, triangles).empty());
    positions.row(3) << 1, 1, 0; // a corner on the face
    EXPECT_EQ(self_intersections(positions, triangles), (Pairs{{0, 1}}));
}

TEST(SelfIntersections, FacesWithASharedEdgeCountWhereFoldedFlat) {
    Points positions(4, 3);
    positions << 0, 0, 0, 4, 0, 0, 0, 4, 0, 1, -1, 0;
    Triangles triangles(2, 3);
    triangles << 0, 1, 2, 1, 0, 3;
    EXPECT_TRUE(self_intersections(positions, triangles).empty());
    positions.row(3) << 3, 3, 0;
    EXPECT_EQ(self_intersections(positions, triangles), (Pairs{{0, 1}}));
    positions.row(3) << 3, 3, 1e-300;
    EXPECT_TRUE(self_intersections(positions, triangles).empty());
    triangles.row(1) << 2, 0, 1; // the same face twice
    EXPECT_EQ(self_intersections(positions, triangles), (Pairs{{0, 1}}));
}

TEST(SelfIntersections, TrianglesWithoutAreaAreLeftOut) {
    Points positions(6, 3);
    positions << flat, 1, 1, -1, 1, 1, 1, 1, 1, 3;
    EXPECT_TRUE(pairs_of_soup(positions).empty());
    Triangles none(0, 3);
    EXPECT_TRUE(self_intersections(positions, none).empty());
}

// Two spheres of the same pattern, one vertex list, `apart` between their centres and a little askew.
Mesh spheres(int rings, double apart) {
    Mesh mesh;
    const int around = 2 * rings, each = rings * around + 2;
    mesh.positions.resize(2 * each, 3);
    std::vector<Eigen::RowVector3i> faces;
    for (int s = 0; s < 2; ++s) {
        const int base = s * each;
        const double pi = std::acos(-1.0);
        mesh.positions.row(base) << s * apart, 0, 1;
        mesh.positions.row(base + each - 1) << s * apart, 0, -1;
        const auto at = [&](int r, int a) { return base + 1 + r * around + a % around; };
        for (int r = 0; r < rings; ++r)
            for (int a = 0; a < around; ++a) {
                const double u = pi * (r + 1) / (rings + 1), v = 2 * pi * a / around;
                mesh.positions.row(at(r, a)) << s * apart + std::sin(u) * std::cos(v), std::sin(u) * std::sin(v),
                    std::cos(u);
                if (r == 0) faces.emplace_back(base, at(0, a), at(0, a + 1));
                if (r + 1 == rings) {
                    faces.emplace_back(base + each - 1, at(r, a + 1), at(r, a));
                    continue;
                }
                faces.emplace_back(at(r, a), at(r + 1, a), at(r + 1, a + 1));
                faces.emplace_back(at(r, a), at(r + 1, a + 1), at(r, a + 1));
            }
    }
    mesh.positions.bottomRows(each).rowwise() += Point(0, 0.0345, 0.0567);
    mesh.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t i = 0; i < faces.size(); ++i) mesh.triangles.row(static_cast<Eigen::Index>(i)) = faces[i];
    return mesh;
}

// Whether two triangles in general position meet, by solving for the points where edges pierce faces.
bool pierce(const Mesh& mesh, int s, int t) {
    const auto pierced_by = [&](int face, int other) {
        const auto corner = [&](int f, int k) { return Point(mesh.positions.row(mesh.triangles(f, k % 3))); };
        for (int k = 0; k < 3; ++k) {
            Eigen::Matrix3d m;
            m << (corner(face, 1) - corner(face, 0)).transpose(), (corner(face, 2) - corner(face, 0)).transpose(),
                (corner(other, k) - corner(other, k + 1)).transpose();
            const Eigen::Vector3d x = m.inverse() * (corner(other, k) - corner(face, 0)).transpose();
            if (x[0] >= 0 && x[1] >= 0 && x[0] + x[1] <= 1 && x[2] >= 0 && x[2] <= 1) return true;
        }
        return false;
    };
    return pierced_by(s, t) || pierced_by(t, s);
}

TEST(SelfIntersections, OfTwoSpheresAreWhereTheirFacesPierce) {
    EXPECT_TRUE(self_intersections(spheres(12, 3).positions, spheres(12, 3).triangles).empty());
    const Mesh mesh = spheres(12, 1.2345678);
    Pairs expected;
    const int half = static_cast<int>(mesh.triangles.rows()) / 2;
    for (int s = 0; s < half; ++s)
        for (int t = half; t < 2 * half; ++t)
            if (pierce(mesh, s, t)) expected.push_back({s, t});
    EXPECT_GT(expected.size(), 20u);
    EXPECT_EQ(self_intersections(mesh.positions, mesh.triangles), expected);
}

TEST(SelfIntersections, OfChosenTrianglesAreThoseOfAllWithOneOfThem) {
    Mesh mesh = spheres(30, 0.7654321);
    mesh.triangles.row(21) << 5, 5, 6; // chosen, and no triangle at all
    std::vector<char> chosen(static_cast<std::size_t>(mesh.triangles.rows()), 0);
    EXPECT_TRUE(self_intersections(mesh.positions, mesh.triangles, chosen).empty());
    for (std::size_t t = 0; t < chosen.size(); t += 7) chosen[t] = 1;
    Pairs expected = self_intersections(mesh.positions, mesh.triangles);
    const auto count = expected.size();
    std::erase_if(expected, [&](const auto& pair) {
        return !chosen[static_cast<std::size_t>(pair[0])] && !chosen[static_cast<std::size_t>(pair[1])];
    });
    EXPECT_LT(expected.size(), count);
    EXPECT_GT(expected.size(), 10u);
    EXPECT_EQ(self_intersections(mesh.positions, mesh.triangles, chosen), expected);
}

TEST(SelfIntersections, AreTheSameForAnyNumberOfThreadsAndAnyOrderOfFaces) {
    const Mesh mesh = spheres(30, 0.7654321);
    set_threads(1);
    const Pairs one = self_intersections(mesh.positions, mesh.triangles);
    set_threads(2);
    EXPECT_EQ(self_intersections(mesh.positions, mesh.triangles), one);
    set_threads(0);
    const int last = static_cast<int>(mesh.triangles.rows()) - 1;
    const Triangles reversed = mesh.triangles.colwise().reverse();
    Pairs back;
    for (const auto& [s, t] : self_intersections(mesh.positions, reversed)) back.push_back({last - t, last - s});
    std::sort(back.begin(), back.end());
    EXPECT_EQ(back, one);
}

} // namespace
} // namespace meshtween
