// USD as text. What Pixar's own reader makes of it is tested apart.
#include "meshtween/io/usd_write.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/output.h"

#include "support/errors.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace meshtween {
namespace {

class Usd : public testing::Test {
protected:
    std::string written(const Mesh& mesh, const UsdMorph& morph = {}) {
        notes = write_usd(mesh, morph, scratch.path("a.usda"), {});
        return read_whole(scratch.path("a.usda"));
    }
    Mesh read(std::string_view name, std::string_view contents) const {
        return read_mesh(scratch.file(name, contents));
    }
    Scratch scratch;
    std::vector<std::string> notes;
};

bool has(const std::string& text, std::string_view words) {
    return text.find(words) != std::string::npos;
}

TEST_F(Usd, PolygonsTextureCoordinatesAndColours) {
    Mesh mesh =
        read("a.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0 1 1 1\nv 2 0 0 1 1 1\nvt 0 0\nvt 1 0\n"
                      "vt 1 1\nvt 0 0.5\nf 1/1 2/2 3/3 4/4\nf 2/1 5/2 3/3\n");
    const std::string text = written(mesh);
    EXPECT_TRUE(text.starts_with("#usda 1.0\n"));
    EXPECT_TRUE(has(text, "faceVertexCounts = [4, 3]")) << text;
    EXPECT_TRUE(has(text, "faceVertexIndices = [0, 1, 2, 3, 1, 4, 2]"));
    EXPECT_TRUE(has(text, "points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0)]"));
    EXPECT_TRUE(has(text, "primvars:st:indices = [0, 1, 2, 3, 0, 1, 2]"));
    EXPECT_TRUE(has(text, "displayColor = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1), (1, 1, 1)]"));
    EXPECT_TRUE(has(text, "normals = [(0, 0, 1)"));
    EXPECT_TRUE(has(text, "def Xform \"Model\""));
    EXPECT_FALSE(has(text, "Skel"));
}

TEST_F(Usd, AMeshFarFromTheOriginKeepsItsDigits) {
    Mesh mesh = unit_cube();
    mesh.positions.rowwise() += Point(1e7, 0, 0);
    const std::string text = written(mesh);
    EXPECT_TRUE(has(text, "xformOp:translate = (10000000")) << text;
    EXPECT_TRUE(has(text, "0.5")) << text;
}

struct Blended {
    Mesh mesh = unit_cube();
    std::vector<Points> shapes, normals;
    UsdMorph morph;
    Blended() {
        shapes.assign(2, mesh.positions);
        shapes[0].row(3) *= 2; // one vertex alone
        shapes[1].rowwise() += Point(3, 0, 0);
        normals.assign(3, vertex_normals(mesh.positions, mesh.triangles));
        morph.shapes = shapes;
        morph.normals = normals;
        morph.names = {"key 2", "key 2"};
        morph.times = {0, 1};
        morph.weights = {0, 0, 0.25F, 0.5F};
    }
};

TEST_F(Usd, FewMovedVerticesAreToldByTheirNumbers) {
    Blended made;
    const std::string text = written(made.mesh, made.morph);
    EXPECT_TRUE(has(text, "pointIndices = [3]\n")) << text;
    EXPECT_EQ(text.find("pointIndices"), text.rfind("pointIndices"));
    EXPECT_TRUE(has(text, "blendShapes = [\"key_2\", \"key_2_2\"]"));
    EXPECT_TRUE(has(text, "24: [0.25, 0.5],"));
    EXPECT_TRUE(has(text, "endTimeCode = 24"));
}

TEST_F(Usd, NeighboursOnAStraightLineAreInBetweens) {
    Blended made;
    made.morph.stops = {0.25F, 1};
    const std::string text = written(made.mesh, made.morph);
    EXPECT_TRUE(has(text, "blendShapes = [\"morph\"]")) << text;
    EXPECT_TRUE(has(text, "inbetweens:key_2_0 = ["));
    EXPECT_TRUE(has(text, "weight = 0.25"));
    EXPECT_TRUE(has(text, "24: [0.5625],"));
}

TEST_F(Usd, GroupsMaterialsAndTheirPictures) {
    MeshFile file;
    Mesh mesh = unit_cube();
    file.vertices = mesh.positions.rows();
    for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i) file.corners.push_back(mesh.triangles.data()[i]);
    file.cut = mesh.triangles;
    for (int i = 0; i < static_cast<int>(mesh.triangles.size()); ++i) file.cut.data()[i] = i;
    for (int t = 1; t <= static_cast<int>(mesh.triangles.rows()); ++t) file.ends.push_back(3 * t);
    mesh.texcoords = Texcoords::Zero(1, 2);
    mesh.texcoord_triangles = Triangles::Zero(mesh.triangles.rows(), 3);
    file.groups.names = {"left ear"};
    file.groups.of.assign(static_cast<std::size_t>(mesh.triangles.rows()), -1);
    file.groups.of[5] = 0;
    file.materials.resize(2);
    file.materials[0].name = "2nd \"skin\"";
    file.materials[0].base_color_image = 0;
    file.polygon_materials.assign(file.groups.of.size(), 1);
    file.images.push_back({"skin", "image/png", "PNG", {}});
    mesh.file = std::make_shared<const MeshFile>(file);
    const std::string text = written(mesh);
    EXPECT_TRUE(has(text, "def GeomSubset \"left_ear\"")) << text;
    EXPECT_TRUE(has(text, "int[] indices = [5]\n"));
    EXPECT_TRUE(has(text, "def Material \"_2nd__skin_\""));
    EXPECT_TRUE(has(text, "displayName = \"2nd \\\"skin\\\"\""));
    EXPECT_TRUE(has(text, "asset inputs:file = @skin.png@"));
    EXPECT_EQ(read_whole(scratch.path("skin.png")), "PNG");
    EXPECT_TRUE(notes.empty()) << notes[0];
}

TEST_F(Usd, WhatDoesNotAgreeIsRefused) {
    Blended made;
    made.morph.weights.pop_back();
    message_of(ErrorKind::argument, [&] { written(made.mesh, made.morph); });
    Blended other;
    other.shapes[1].conservativeResize(7, 3);
    EXPECT_TRUE(has(message_of(ErrorKind::argument, [&] { written(other.mesh, other.morph); }), "7 vertices"));
    EXPECT_EQ(scratch.entries(), 0);
    EXPECT_TRUE(has(message_of(ErrorKind::argument, [&] { read("a.usda", "#usda 1.0\n"); }), "written but not read"));
}

} // namespace
} // namespace meshtween
