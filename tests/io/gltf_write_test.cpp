#include "meshtween/io/gltf_write.h"

#include "support/glb.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace meshtween {
namespace {

Mesh tetrahedron() {
    Mesh mesh;
    mesh.positions.resize(4, 3);
    mesh.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
    mesh.triangles.resize(4, 3);
    mesh.triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
    return mesh;
}

Mesh grid(int side) {
    Mesh mesh;
    mesh.positions.resize(side * side, 3);
    for (int i = 0; i < side * side; ++i) mesh.positions.row(i) << i % side, i / side, 0.1 * (i % 7);
    mesh.triangles.resize((side - 1) * (side - 1), 3);
    for (int y = 0, t = 0; y + 1 < side; ++y)
        for (int x = 0; x + 1 < side; ++x)
            mesh.triangles.row(t++) << y * side + x, y * side + x + 1, (y + 1) * side + x;
    return mesh;
}

// The file's triangles as one row of corners.
Eigen::RowVectorXi corners(const Triangles& triangles) {
    return Eigen::Map<const Eigen::RowVectorXi>(triangles.data(), triangles.size());
}

const nlohmann::json& primitive(const ParsedGlb& glb) {
    return glb.root["meshes"][0]["primitives"][0];
}

TEST(GltfWrite, KeepsVerticesAndTrianglesInOrder) {
    const Mesh mesh = tetrahedron();
    const ParsedGlb glb = parse_glb(mesh_glb(mesh));
    EXPECT_EQ(accessor<float>(glb, primitive(glb)["attributes"]["POSITION"]), mesh.positions.cast<float>());
    EXPECT_EQ(accessor<std::uint16_t>(glb, primitive(glb)["indices"]).cast<int>().transpose(), corners(mesh.triangles));
    EXPECT_FALSE(glb.root["nodes"][0].contains("translation"));
}

TEST(GltfWrite, NormalsAreThoseOfTheMesh) {
    const Mesh mesh = tetrahedron();
    const ParsedGlb glb = parse_glb(mesh_glb(mesh));
    const auto normals = accessor<float>(glb, primitive(glb)["attributes"]["NORMAL"]);
    EXPECT_EQ(normals, vertex_normals(mesh.positions, mesh.triangles).cast<float>());
}

TEST(GltfWrite, IndicesGrowWithTheMesh) {
    const Mesh small = grid(255), large = grid(257); // 65025 and 66049 vertices
    const ParsedGlb small_glb = parse_glb(mesh_glb(small)), large_glb = parse_glb(mesh_glb(large));
    EXPECT_EQ(accessor<std::uint16_t>(small_glb, primitive(small_glb)["indices"]).rows(), small.triangles.size());
    EXPECT_EQ(accessor<std::uint32_t>(large_glb, primitive(large_glb)["indices"]).cast<int>().transpose(),
              corners(large.triangles));
}

TEST(GltfWrite, OnlySeamsSplitVertices) {
    Mesh mesh = tetrahedron();
    mesh.texcoords.resize(5, 2);
    mesh.texcoords << 0, 0, 1, 0, 0, 1, 1, 1, 0.5F, 0.25F;
    mesh.texcoord_triangles = mesh.triangles;
    ParsedGlb glb = parse_glb(mesh_glb(mesh));
    EXPECT_EQ(accessor<float>(glb, primitive(glb)["attributes"]["POSITION"]).rows(), 4);

    mesh.texcoord_triangles(3, 1) = 4; // vertex 3 has another UV in the last triangle
    glb = parse_glb(mesh_glb(mesh));
    const auto positions = accessor<float>(glb, primitive(glb)["attributes"]["POSITION"]);
    const auto uv = accessor<float>(glb, primitive(glb)["attributes"]["TEXCOORD_0"]);
    const auto triangles = accessor<std::uint16_t>(glb, primitive(glb)["indices"]);
    ASSERT_EQ(positions.rows(), 5);
    EXPECT_EQ(positions.topRows(4), mesh.positions.cast<float>());
    EXPECT_EQ(positions.row(4), positions.row(3));
    for (int t = 0; t < 4; ++t)
        for (int c = 0; c < 3; ++c) {
            const auto expected = mesh.texcoords.row(mesh.texcoord_triangles(t, c));
            EXPECT_EQ(uv(triangles(3 * t + c), 0), expected[0]);
            EXPECT_EQ(uv(triangles(3 * t + c), 1), 1 - expected[1]);
        }
}

TEST(GltfWrite, EqualUvsUnderTwoNumbersAreNoSeam) {
    Mesh mesh = tetrahedron();
    mesh.texcoords = Texcoords::Constant(12, 2, 0.5F);
    mesh.texcoord_triangles.resize(4, 3);
    for (int i = 0; i < 12; ++i) mesh.texcoord_triangles.data()[i] = i;
    const ParsedGlb glb = parse_glb(mesh_glb(mesh));
    EXPECT_EQ(accessor<float>(glb, primitive(glb)["attributes"]["POSITION"]).rows(), 4);
}

TEST(GltfWrite, ColoursAreLinear) {
    Mesh mesh = tetrahedron();
    mesh.colors.resize(4, 4);
    mesh.colors << 0, 0, 0, 1, 1, 1, 1, 0.5F, 0.5F, 0.5F, 0.5F, 1, 2, -1, 0, 1;
    const ParsedGlb glb = parse_glb(mesh_glb(mesh));
    const auto colors = accessor<float>(glb, primitive(glb)["attributes"]["COLOR_0"]);
    EXPECT_EQ(colors.row(1), Eigen::RowVector4f(1, 1, 1, 0.5F));
    EXPECT_NEAR(colors(2, 0), 0.21404, 1e-5);
    EXPECT_EQ(colors.row(3), Eigen::RowVector4f(1, 0, 0, 1));
}

TEST(GltfWrite, FarFromTheOriginTheShapeKeepsItsDigits) {
    Mesh mesh = grid(9);
    const Point far(1e6, -2e6, 3e6);
    mesh.positions.rowwise() += far;
    std::vector<Points> shapes{Points(mesh.positions * 1.0)};
    shapes[0].col(2).array() += 0.123456789;
    const ParsedGlb glb = parse_glb(mesh_glb(
        mesh,
        GltfMorph{
            .shapes = shapes, .names = {"b"}, .times = {0, 1}, .weights = {0, 1}, .degree = 1, .knots = {0, 0, 1, 1}}));
    const auto& t = glb.root["nodes"][0]["translation"];
    const Point origin(t[0].get<double>(), t[1].get<double>(), t[2].get<double>());
    const auto base = accessor<float>(glb, primitive(glb)["attributes"]["POSITION"]);
    const auto delta = accessor<float>(glb, primitive(glb)["targets"][0]["POSITION"]);
    const Points back = base.cast<double>().rowwise() + origin;
    const Points end = (base + delta).cast<double>().rowwise() + origin;
    const double tolerance = 1e-6 * diagonal(mesh);
    EXPECT_LT((back - mesh.positions).rowwise().norm().maxCoeff(), tolerance);
    EXPECT_LT((end - shapes[0]).rowwise().norm().maxCoeff(), tolerance);
}

TEST(GltfWrite, BoundsAreThoseOfTheData) {
    Mesh mesh = grid(5);
    mesh.positions *= 0.1;
    const ParsedGlb glb = parse_glb(mesh_glb(mesh));
    const auto positions = accessor<float>(glb, primitive(glb)["attributes"]["POSITION"]);
    const auto& a = glb.root["accessors"][primitive(glb)["attributes"]["POSITION"].get<std::size_t>()];
    for (std::size_t c = 0; c < 3; ++c) {
        const auto column = positions.col(static_cast<Eigen::Index>(c));
        EXPECT_EQ(a["min"][c].get<double>(), column.minCoeff());
        EXPECT_EQ(a["max"][c].get<double>(), column.maxCoeff());
    }
}

TEST(GltfWrite, VerticesWithoutAreaGetAUnitNormal) {
    Mesh mesh = tetrahedron();
    mesh.positions.conservativeResize(5, 3);
    mesh.positions.row(4) << 9, 9, 9;
    const ParsedGlb glb = parse_glb(mesh_glb(mesh));
    EXPECT_EQ(accessor<float>(glb, primitive(glb)["attributes"]["NORMAL"]).row(4).norm(), 1);
}

TEST(GltfWrite, RefusesWhatGltfCannotHold) {
    const auto refused = [](const Mesh& mesh, const GltfMorph& morph = {}) {
        try {
            mesh_glb(mesh, morph);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    Mesh mesh = tetrahedron();
    mesh.positions(2, 1) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refused(mesh), "glTF cannot hold vertex 2 of mesh: a coordinate is not a finite number");
    mesh = tetrahedron();
    mesh.triangles(3, 0) = 4;
    EXPECT_EQ(refused(mesh), "triangle 3 names vertex 4, but there are 4");
    mesh = tetrahedron();
    mesh.triangles.resize(0, 3);
    EXPECT_EQ(refused(mesh), "\"mesh\" has no faces, so there is no glTF to write");
    const std::vector<Points> shapes{Points::Zero(3, 3)};
    EXPECT_EQ(refused(tetrahedron(), {.shapes = shapes, .names = {"b"}, .degree = 1, .knots = {0, 0, 1, 1}}),
              "shape \"b\" has 3 vertices, but the mesh has 4");
}

} // namespace
} // namespace meshtween
