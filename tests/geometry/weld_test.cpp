#include "meshtween/geometry/weld.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/geometry/topology.h"

#include "support/cut.h"
#include "support/shapes.h"

#include <gtest/gtest.h>

#include <random>

namespace meshtween {
namespace {

// A sheet of 9 x 9 vertices in the plane with a slit along its middle row, from column 2 to 6: `first` is the vertex
// at the slit's left end.
Mesh flat_sheet() {
    Mesh mesh = wavy_sheet(9, 9);
    for (auto p : mesh.positions.rowwise()) p[2] = 0;
    return mesh;
}

std::set<std::pair<int, int>> slit() {
    std::set<std::pair<int, int>> edges;
    for (int j = 2; j < 6; ++j) edges.insert({4 * 9 + j, 4 * 9 + j + 1});
    return edges;
}

// One texture coordinate a vertex, its place in the plane.
void texture(Mesh& mesh) {
    mesh.texcoords = mesh.positions.leftCols(2).cast<float>();
    mesh.texcoord_triangles = mesh.triangles;
}

long open_edges(const Mesh& mesh, const Weld& weld) {
    const Triangles& triangles = weld.any() ? weld.triangles : mesh.triangles;
    const Topology top = topology(weld.any() ? std::ssize(weld.first) : mesh.positions.rows(), triangles);
    return std::count_if(top.edges.begin(), top.edges.end(), [](const Edge& e) { return e.count == 1; });
}

// The welded mesh is the one that was cut, but for the order of its vertices.
void expect_whole_again(const CutMesh& cut, const Mesh& mesh, const char* what) {
    const Weld found = weld(cut.mesh);
    ASSERT_TRUE(found.any()) << what;
    EXPECT_EQ(std::ssize(found.first), mesh.positions.rows()) << what;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const int first = found.first[static_cast<std::size_t>(found.triangles(t, k))];
            ASSERT_EQ(cut.vertex[static_cast<std::size_t>(first)], mesh.triangles(t, k)) << what;
        }
    const Points x = Points::Random(mesh.positions.rows(), 3);
    EXPECT_EQ(found.expanded(found.reduced(cut.whole(x))), cut.whole(x)) << what;
}

TEST(Weld, AMeshWithoutCopiesStaysItself) {
    for (const Mesh& mesh : {sphere(3), wavy_sheet(5, 4), unit_cube()}) {
        const Weld found = weld(mesh);
        EXPECT_FALSE(found.any());
        EXPECT_TRUE(found.touching.empty());
        EXPECT_EQ(found.expanded(mesh.positions), mesh.positions);
    }
}

TEST(Weld, ACutMeshIsWholeAgain) {
    for (const auto& [name, mesh] : {std::pair("ball", sphere(4)), std::pair("ring", torus(2, 0.7, 40, 20))}) {
        for (const unsigned seed : {1U, 2U, 3U})
            expect_whole_again(cut_along(mesh, random_seams(mesh, 12, 20, seed)), mesh, name);
        expect_whole_again(flat_shaded(mesh), mesh, name);
    }
    expect_whole_again(cut_along(wavy_sheet(9, 9), slit()), wavy_sheet(9, 9), "open sheet");
    expect_whole_again(flat_shaded(wavy_sheet(9, 9)), wavy_sheet(9, 9), "open sheet");
    expect_whole_again(flat_shaded(unit_cube()), unit_cube(), "cube");
}

TEST(Weld, CopiesAtTheEndGiveTheSameNumbering) {
    const Mesh mesh = sphere(3);
    const CutMesh cut = cut_along(mesh, random_seams(mesh, 5, 5, 7));
    const Weld found = weld(cut.mesh);
    EXPECT_EQ(found.triangles, mesh.triangles);
    EXPECT_EQ(found.reduced(cut.mesh.positions), mesh.positions);
}

TEST(Weld, TheOrderOfAFileChangesNothing) {
    const Mesh mesh = sphere(3);
    Mesh cut = cut_along(mesh, random_seams(mesh, 5, 5, 7)).mesh;
    const Weld before = weld(cut);
    std::vector<int> order(static_cast<std::size_t>(cut.positions.rows())), now(order.size());
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), std::mt19937(5));
    for (std::size_t i = 0; i < order.size(); ++i) now[static_cast<std::size_t>(order[i])] = static_cast<int>(i);
    cut.positions = Points(cut.positions(order, Eigen::all));
    for (int& v : cut.triangles.reshaped()) v = now[static_cast<std::size_t>(v)];
    const Weld after = weld(cut);
    ASSERT_EQ(after.first.size(), before.first.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const auto one = [](const Weld& w, int a, int b) {
                return w.vertex[static_cast<std::size_t>(a)] == w.vertex[static_cast<std::size_t>(b)];
            };
            ASSERT_EQ(one(after, static_cast<int>(i), static_cast<int>(j)), one(before, order[i], order[j]));
        }
}

TEST(Weld, MinusNoughtIsNought) {
    Mesh mesh = wavy_sheet(2, 3);
    const CutMesh cut = cut_along(mesh, {{1, 4}});
    Mesh signed_noughts = cut.mesh;
    for (Eigen::Index i = mesh.positions.rows(); i < signed_noughts.positions.rows(); ++i)
        for (int k = 0; k < 3; ++k)
            if (signed_noughts.positions(i, k) == 0) signed_noughts.positions(i, k) = -0.0;
    EXPECT_EQ(open_edges(signed_noughts, weld(signed_noughts)), open_edges(mesh, Weld()));
}

// Both ends of a circle, as programs compute them.
TEST(Weld, PlacesAreTheSameToARounding) {
    const Mesh ball = sphere(3);
    Mesh cut = cut_along(ball, random_seams(ball, 5, 5, 7)).mesh;
    for (Eigen::Index i = ball.positions.rows(); i < cut.positions.rows(); ++i)
        cut.positions.row(i) += 1e-7 * Point(1, -1, 1);
    EXPECT_EQ(weld(cut).triangles, ball.triangles);
    for (Eigen::Index i = ball.positions.rows(); i < cut.positions.rows(); ++i)
        cut.positions.row(i) += 1e-4 * Point(1, -1, 1);
    EXPECT_NE(std::ssize(weld(cut).first), ball.positions.rows());
}

// Edges shorter than any rounding are still edges of a whole mesh.
TEST(Weld, TinyTrianglesStay) {
    Mesh mesh = wavy_sheet(4, 4);
    mesh.positions.row(5) = mesh.positions.row(6) + 1e-9 * Point(1, 0, 0);
    mesh.positions.row(0) = mesh.positions.row(1);
    EXPECT_FALSE(weld(mesh).any());
}

// Each row: a mesh in which vertices lie on others and nothing may be joined.
TEST(Weld, WhatTouchesIsNotJoined) {
    Mesh bow_tie; // two triangles tip to tip
    bow_tie.positions.resize(6, 3);
    bow_tie.positions << -1, -1, 0, 0, 0, 0, -1, 1, 0, 0, 0, 0, 1, -1, 0, 1, 1, 0;
    bow_tie.triangles.resize(2, 3);
    bow_tie.triangles << 0, 1, 2, 3, 4, 5;

    const Mesh sheet = flat_sheet();
    Mesh layers = sheet; // one sheet on another
    layers.positions.resize(2 * sheet.positions.rows(), 3);
    layers.positions << sheet.positions, sheet.positions;
    layers.triangles.resize(2 * sheet.triangles.rows(), 3);
    layers.triangles << sheet.triangles, Triangles(sheet.triangles.array() + static_cast<int>(sheet.positions.rows()));

    Mesh leaf = layers; // a front and a back
    leaf.triangles.bottomRows(sheet.triangles.rows())
        .col(1)
        .swap(leaf.triangles.bottomRows(sheet.triangles.rows()).col(2));

    Mesh three; // sheets that meet at one edge, each with its own vertices
    three.positions.resize(9, 3);
    three.positions << 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 1, -1, 1, 0, 0, 0, 0, 0, 0, 1, -1, -1, 0;
    three.triangles.resize(3, 3);
    three.triangles << 0, 1, 2, 4, 3, 5, 7, 6, 8;

    Mesh zip = sheet; // the upper half begins with vertices between those of the lower half's end
    zip.positions.resize(sheet.positions.rows() + 9, 3);
    zip.positions.topRows(81) = sheet.positions;
    for (int j = 0; j < 9; ++j) {
        zip.positions.row(81 + j) = sheet.positions.row(4 * 9 + j);
        if (j > 0 && j < 8) zip.positions(81 + j, 0) += 0.03;
    }
    for (Eigen::Index t = 8 * 8; t < zip.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            if (zip.triangles(t, k) / 9 == 4) zip.triangles(t, k) += 81 - 36;

    for (const auto& [name, mesh] :
         {std::pair("bow tie", bow_tie), std::pair("two layers", layers), std::pair("leaf", leaf),
          std::pair("three sheets", three), std::pair("zip", zip)}) {
        const Weld found = weld(mesh);
        EXPECT_FALSE(found.any()) << name;
        EXPECT_FALSE(found.touching.empty()) << name;
    }
}

// Two cubes that share an edge, flat-shaded: four triangles meet there, and each cube is closed for itself.
TEST(Weld, SolidsThatTouchAtAnEdgeAreClosedEach) {
    Mesh mesh = flat_shaded(unit_cube()).mesh, other = mesh;
    for (auto p : other.positions.rowwise()) p += Point(1, 1, 0);
    const auto n = static_cast<int>(mesh.positions.rows());
    Points positions(2 * n, 3);
    positions << mesh.positions, other.positions;
    Triangles triangles(24, 3);
    triangles << mesh.triangles, Triangles(other.triangles.array() + n);
    mesh.positions = positions, mesh.triangles = triangles;
    const Weld found = weld(mesh);
    ASSERT_TRUE(found.any());
    EXPECT_EQ(found.first.size(), 16U);
    EXPECT_EQ(open_edges(mesh, found), 0);
    EXPECT_EQ(components(topology(16, found.triangles)).back(), 1);
}

// A leaf with a front and a back, flat-shaded: two sheets.
TEST(Weld, AFlatShadedLeafIsTwoSheets) {
    const Mesh sheet = flat_sheet();
    Mesh leaf = sheet;
    leaf.triangles.resize(2 * sheet.triangles.rows(), 3);
    leaf.triangles << sheet.triangles, sheet.triangles;
    leaf.triangles.bottomRows(sheet.triangles.rows())
        .col(1)
        .swap(leaf.triangles.bottomRows(sheet.triangles.rows()).col(2));
    leaf = flat_shaded(leaf).mesh;
    const Weld found = weld(leaf);
    ASSERT_TRUE(found.any());
    EXPECT_EQ(std::ssize(found.first), 2 * sheet.positions.rows());
    EXPECT_EQ(open_edges(leaf, found), 2 * open_edges(sheet, Weld()));
}

TEST(Weld, ShapesMustAllBeClosed) {
    const Mesh sheet = flat_sheet();
    const CutMesh cut = cut_along(sheet, slit());
    Points open = cut.mesh.positions;
    for (Eigen::Index i = sheet.positions.rows(); i < open.rows(); ++i) open(i, 2) += 0.1;
    EXPECT_TRUE(weld(cut.mesh, {&cut.mesh.positions, &cut.mesh.positions}).any());
    EXPECT_FALSE(weld(cut.mesh, {&cut.mesh.positions, &open}).any());
}

// Closed lips in a textured sheet: the texture goes on from one to the other, so that nothing but the shape split them.
TEST(Weld, ATextureThatGoesOnTellsLipsFromASeam) {
    Mesh lips = cut_along(flat_sheet(), slit()).mesh;
    EXPECT_TRUE(weld(lips).any()) << "without a texture pairing decides";
    texture(lips);
    const Weld open = weld(lips);
    EXPECT_FALSE(open.any());
    EXPECT_EQ(open.left_open.size(), 8U); // three copied vertices twice, and both ends
    EXPECT_EQ(open.touching.size(), 6U);

    Mesh jump = lips; // the texture jumps there
    for (Eigen::Index i = 81; i < jump.texcoords.rows(); ++i) jump.texcoords(i, 0) += 5;
    EXPECT_TRUE(weld(jump).any());

    Mesh mirrored = lips; // both sides show the same piece of it
    for (auto uv : mirrored.texcoords.rowwise()) uv[1] = std::abs(uv[1] - float(4 / 3.0));
    EXPECT_TRUE(weld(mirrored).any());

    Mesh blank = lips; // written because the format wants them
    blank.texcoords.setZero();
    EXPECT_TRUE(weld(blank).any());

    Mesh painted = lips;
    painted.colors = Colors::Ones(lips.positions.rows(), 4);
    EXPECT_FALSE(weld(painted).any());
    painted.colors.bottomRows(3).setZero();
    EXPECT_TRUE(weld(painted).any());

    Mesh pieces = flat_shaded(flat_sheet()).mesh; // a program that shares no vertices
    texture(pieces);
    EXPECT_EQ(std::ssize(weld(pieces).first), 81);
}

TEST(Weld, NormalsTellLipsFromASharpEdge) {
    Mesh lips = cut_along(flat_sheet(), slit()).mesh;
    texture(lips);
    const auto bent = [&](double up) { // along the slit
        Mesh mesh = lips;
        for (auto p : mesh.positions.rowwise()) p[2] = up * std::abs(p[1] - 4 / 3.0);
        return mesh;
    };
    const auto with = [](const Mesh& mesh, const Points& normals) {
        CornerAttributes file;
        file.normal = [mesh, normals](int t, int k) -> Point { return normals.row(mesh.triangles(t, k)); };
        return weld(mesh, {}, file).any();
    };
    const Mesh flat = bent(0), gentle = bent(0.1), sharp = bent(1);
    const auto own = [](const Mesh& mesh) { return vertex_normals(mesh.positions, mesh.triangles); };
    const auto of_one = [](const Mesh& mesh) {
        return vertex_normals(mesh.positions, mesh.triangles, weld({mesh.positions, mesh.triangles, {}, {}, {}}));
    };
    EXPECT_FALSE(with(flat, own(flat))) << "equal, as each side has them";
    EXPECT_FALSE(with(gentle, own(gentle))) << "each side its own, and no fold";
    EXPECT_TRUE(with(gentle, of_one(gentle))) << "made for one surface";
    EXPECT_TRUE(with(sharp, own(sharp))) << "a sharp edge";
}

TEST(Weld, AVertexOfNoFaceGoesWithTheSurfaceInItsPlace) {
    Mesh ball = sphere(2);
    const Eigen::Index n = ball.positions.rows();
    ball.positions.conservativeResize(n + 2, 3);
    ball.positions.row(n) = ball.positions.row(5);
    ball.positions.row(n + 1) = Point(1000, 0, 0); // in no vertex's place, and no measure of the mesh's size
    const Weld found = weld(ball);
    ASSERT_TRUE(found.any());
    EXPECT_EQ(found.vertex[static_cast<std::size_t>(n)], found.vertex[5]);
    EXPECT_EQ(std::ssize(found.first), n + 1);
}

TEST(Weld, NormalsAreSmoothAcrossSeams) {
    const Mesh ball = sphere(3);
    const CutMesh cut = flat_shaded(ball);
    const Points across = vertex_normals(cut.mesh.positions, cut.mesh.triangles, weld(cut.mesh));
    EXPECT_TRUE(across.isApprox(cut.whole(vertex_normals(ball.positions, ball.triangles)), 1e-12));
}

} // namespace
} // namespace meshtween
