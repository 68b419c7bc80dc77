#include "meshtween/geometry/check.h"

#include "support/shapes.h"

#include <gtest/gtest.h>

#include <limits>

namespace meshtween {
namespace {

Mesh mesh_of(std::initializer_list<Point> positions, std::initializer_list<std::array<int, 3>> triangles) {
    Mesh mesh;
    mesh.positions.resize(static_cast<Eigen::Index>(positions.size()), 3);
    mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
    Eigen::Index i = 0;
    for (const Point& p : positions) mesh.positions.row(i++) = p;
    i = 0;
    for (const auto& t : triangles) mesh.triangles.row(i++) << t[0], t[1], t[2];
    return mesh;
}

// A grid of rows x columns vertices whose ends meet: a torus.
Mesh torus(int rows, int columns) {
    Mesh mesh;
    mesh.positions.resize(rows * columns, 3);
    mesh.triangles.resize(2 * rows * columns, 3);
    Eigen::Index t = 0;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double u = 2 * M_PI * i / rows, v = 2 * M_PI * j / columns, r = 2 + std::cos(v);
            mesh.positions.row(i * columns + j) << r * std::cos(u), r * std::sin(u), std::sin(v);
            const auto at = [&](int a, int b) { return a % rows * columns + b % columns; };
            mesh.triangles.row(t++) << at(i, j), at(i + 1, j), at(i + 1, j + 1);
            mesh.triangles.row(t++) << at(i, j), at(i + 1, j + 1), at(i, j + 1);
        }
    return mesh;
}

Mesh both(const Mesh& a, const Mesh& b, const Point& apart) {
    Mesh mesh;
    mesh.positions.resize(a.positions.rows() + b.positions.rows(), 3);
    mesh.positions << a.positions, b.positions.rowwise() + apart;
    mesh.triangles.resize(a.triangles.rows() + b.triangles.rows(), 3);
    mesh.triangles << a.triangles, (b.triangles.array() + static_cast<int>(a.positions.rows())).matrix();
    return mesh;
}

std::string told(const Mesh& mesh) {
    std::string all;
    for (const Finding& finding : check(mesh)) {
        EXPECT_GE(finding.count, finding.severity == Severity::error ? 0 : 1);
        all += (finding.severity == Severity::note      ? "note: "
                : finding.severity == Severity::warning ? "warning: "
                                                        : "error: ") +
               finding.what + "\n";
    }
    return all;
}

TEST(Check, NothingToSayOfACleanClosedMesh) {
    EXPECT_EQ(told(unit_cube()), "");
}

TEST(Check, EachDefectIsNamed) {
    const Mesh cube = unit_cube();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Point o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), d(1, 1, 0);
    const struct {
        const char* name;
        Mesh mesh;
        const char* words;
    } rows[] = {
        {"no faces", mesh_of({o, x}, {}), "error: there are no faces, only 2 vertices\n"},
        {"nothing", Mesh(), "error: there are no faces, only 0 vertices\n"},
        {"range", mesh_of({o, x, y}, {{0, 1, 2}, {0, 1, 3}, {-1, 1, 2}}),
         "error: faces 1 and 2 name a vertex that does not exist: there are 3\n"},
        {"not finite", mesh_of({o, {nan, 0, 0}, y}, {{0, 1, 2}}),
         "error: vertex 1 has a coordinate that is not a finite number\n"
         "note: the surface is open: a boundary of 3 edges\n"},
        {"repeated", mesh_of({o, x, y}, {{0, 1, 2}, {1, 1, 2}}), "warning: face 1 names a vertex more than once\n"},
        {"no area", mesh_of({o, x, {2, 0, 0}, y}, {{0, 1, 2}, {1, 3, 2}}),
         "warning: face 0 has no area\nnote: the surface is open: a boundary of 4 edges\n"},
        {"same face", mesh_of({o, x, y, d}, {{0, 1, 2}, {1, 3, 2}, {2, 0, 1}}),
         "warning: a face has the same vertices as another: 2 as 0\n"},
        {"unused", mesh_of({o, x, y, z}, {{0, 1, 2}}), "warning: vertex 3 belongs to no face\n"},
        {"equal places", mesh_of({o, x, y, x, d, y}, {{0, 1, 2}, {3, 4, 5}}),
         "note: 2 vertices lie on others where edges pair up (3 on 1 and 5 on 2): a seam of the file"},
        {"tips that touch", mesh_of({o, x, y, o, -x, -y}, {{0, 1, 2}, {3, 4, 5}}),
         "note: vertices 0 and 3 lie on others where edges do not pair up: a border"},
        {"three faces on an edge", mesh_of({o, x, y, z, d}, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}),
         "warning: edge 0-1 belongs to three faces (0, 1 and 2)\n"},
        {"two fans", mesh_of({o, x, y, -x, -y}, {{0, 1, 2}, {0, 3, 4}}),
         "warning: vertex 0 joins parts of the surface that share nothing else there\n"},
        {"turned", mesh_of({o, x, y, d}, {{0, 1, 2}, {1, 2, 3}}),
         "warning: two neighbouring faces look to opposite sides: 0 and 1 at edge 1-2\n"},
        {"two cubes", both(cube, cube, {3, 0, 0}), "note: the surface has two separate parts, of 8 and 8 vertices\n"},
        {"a sheet", wavy_sheet(3, 4), "note: the surface is open: a boundary of 10 edges\n"},
        {"two sheets", both(wavy_sheet(3, 4), wavy_sheet(3, 3), {9, 0, 0}),
         "note: the surface is open: two boundaries, of 10 and 8 edges\n"},
        {"a torus", torus(8, 6), "note: the surface has one handle (its genus)\n"},
        {"two tori", both(torus(8, 6), torus(8, 6), {9, 0, 0}), "note: the surface has two handles (its genus)\n"},
    };
    for (const auto& row : rows) {
        const std::string all = told(row.mesh);
        EXPECT_NE(all.find(row.words), std::string::npos) << row.name << ": " << all;
    }
}

TEST(Check, InsideOut) {
    Mesh cube = unit_cube();
    cube.triangles.col(0).swap(cube.triangles.col(1));
    EXPECT_EQ(told(cube), "warning: the surface is inside out: its faces look inwards, turn them all over\n");
}

TEST(Check, ManyOfAKindAreCountedAndAFewNamed) {
    Mesh mesh = wavy_sheet(5, 5);
    mesh.positions.conservativeResize(34, 3);
    for (int i = 25; i < 34; ++i) mesh.positions.row(i) << i, 0, 100;
    const std::vector<Finding> findings = check(mesh);
    ASSERT_EQ(findings.size(), 2u);
    EXPECT_EQ(findings[0].count, 9);
    EXPECT_EQ(findings[0].what, "9 vertices (25, 26, 27, 28, 29, ...) belong to no face");
}

TEST(Check, HandlesAreNotMistakenInAnOpenSurface) {
    Mesh open = torus(8, 6);
    open.triangles = open.triangles.bottomRows(open.triangles.rows() - 2).eval();
    EXPECT_EQ(told(open), "note: the surface is open: a boundary of 4 edges\n"
                          "note: the surface has one handle (its genus)\n");
}

} // namespace
} // namespace meshtween
