// A GLB of a mesh from a file of another format: its materials and textures, its edges, and reading it back.
#include "meshtween/io/gltf_split.h"
#include "meshtween/io/gltf_write.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include "support/glb.h"
#include "support/gltf_maker.h"
#include "support/scratch.h"
#include "support/shapes.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace meshtween {
namespace {

using nlohmann::json;

// Enough of a picture for who looks at its first bytes.
const std::string png = "\x89PNG\r\n\x1a\n and so on";

// The unit cube with a texture coordinate and a normal a corner, and two materials in turn.
Mesh dressed_cube() {
    Mesh mesh = unit_cube();
    auto file = std::make_shared<MeshFile>();
    file->format = ".obj";
    mesh.texcoords.resize(36, 2);
    mesh.texcoord_triangles.resize(12, 3);
    file->cut.resize(12, 3);
    file->normals.resize(12, 3);
    TexcoordSet more{"second", Texcoords(1, 2), {}};
    more.texcoords << 0.5F, 0.25F;
    for (int t = 0; t < 12; ++t) {
        const Point a = mesh.positions.row(mesh.triangles(t, 0)), b = mesh.positions.row(mesh.triangles(t, 1)),
                    c = mesh.positions.row(mesh.triangles(t, 2));
        file->normals.row(t) = (b - a).cross(c - a).normalized();
        file->ends.push_back(3 * t + 3);
        file->polygon_materials.push_back(t / 3 % 2);
        for (int k = 0; k < 3; ++k) {
            const Point p = mesh.positions.row(mesh.triangles(t, k));
            mesh.texcoords.row(3 * t + k) << static_cast<float>(p[0]), static_cast<float>(p[1] + t / 2);
            mesh.texcoord_triangles(t, k) = file->cut(t, k) = 3 * t + k;
            file->corners.push_back(mesh.triangles(t, k));
            file->normal_corners.push_back(t);
            more.corners.push_back(k == 0 ? 0 : -1);
        }
    }
    file->more_texcoords = {more};
    file->images.push_back({"photo", "image/png", png, {}});
    file->materials = {{.name = "cloth", .base_color_image = 0}, {.name = "glass", .base_color = {1, 0, 0, 0.5F}}};
    mesh.file = file;
    return mesh;
}

const json& primitive(const ParsedGlb& glb, std::size_t p) {
    return glb.root["meshes"][0]["primitives"][p];
}

TEST(GltfParts, OnePrimitiveAMaterialWithItsTexture) {
    const ParsedGlb glb = parse_glb(mesh_glb(dressed_cube()));
    ASSERT_EQ(glb.root["meshes"][0]["primitives"].size(), 2U);
    ASSERT_EQ(glb.root["materials"].size(), 2U);
    EXPECT_EQ(primitive(glb, 0)["material"], 0);
    EXPECT_EQ(glb.root["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
    EXPECT_EQ(glb.root["materials"][1]["alphaMode"], "BLEND");
    EXPECT_EQ(glb.root["images"][0]["mimeType"], "image/png");
    const json& view = glb.root["bufferViews"][glb.root["images"][0]["bufferView"].get<std::size_t>()];
    EXPECT_EQ(glb.bin.substr(view["byteOffset"], view["byteLength"]), png);
    EXPECT_EQ(accessor<std::uint16_t>(glb, primitive(glb, 0)["indices"]).rows(), 18);
    EXPECT_TRUE(primitive(glb, 1)["attributes"].contains("TEXCOORD_1"));
}

TEST(GltfParts, NormalsAreSplitAtEdgesAndSmoothAcrossSeams) {
    Mesh mesh = dressed_cube();
    ParsedGlb glb = parse_glb(mesh_glb(mesh));
    for (std::size_t p = 0; p < 2; ++p) {
        const auto normals = accessor<float>(glb, primitive(glb, p)["attributes"]["NORMAL"]);
        EXPECT_TRUE((normals.cwiseAbs().rowwise().maxCoeff().array() == 1).all()); // a cube's sides, all flat
    }
    auto smooth = std::make_shared<MeshFile>(*mesh.file);
    for (int c = 0; c < 36; ++c) smooth->normal_corners[static_cast<std::size_t>(c)] = mesh.triangles.data()[c];
    smooth->normals = (mesh.positions.rowwise() - Point(0.5, 0.5, 0.5)).rowwise().normalized();
    mesh.file = smooth;
    glb = parse_glb(mesh_glb(mesh));
    const auto normals = accessor<float>(glb, primitive(glb, 0)["attributes"]["NORMAL"]);
    EXPECT_LT(normals.cwiseAbs().rowwise().maxCoeff().maxCoeff(), 0.9);
}

TEST(GltfParts, ReadingGivesBackTheMesh) {
    const Scratch scratch;
    const Mesh mesh = dressed_cube();
    const std::array<Points, 1> shapes{mesh.positions * 2};
    GltfMorph morph;
    morph.shapes = shapes;
    morph.names = {"twice"};
    morph.degree = 1;
    morph.knots = {0, 0, 1, 1};
    const Mesh back = read_mesh(scratch.file("a.glb", mesh_glb(mesh, morph)));
    EXPECT_EQ(back.positions, mesh.positions);
    EXPECT_EQ(back.triangles, mesh.triangles);
    for (Eigen::Index t = 0; t < 12; ++t)
        for (int c = 0; c < 3; ++c)
            EXPECT_EQ(back.texcoords.row(back.texcoord_triangles(t, c)), mesh.texcoords.row(3 * t + c));
    EXPECT_EQ(back.file->polygon_materials, mesh.file->polygon_materials);
    EXPECT_EQ(back.file->materials[1].name, "glass");
    EXPECT_EQ(back.file->images.at(0).bytes, png);
    ASSERT_EQ(back.file->more_texcoords.size(), 1U);

    // And once more, from that file: the same materials, the same order, other positions.
    Mesh moved = back;
    moved.positions *= 3;
    write_mesh(moved, scratch.path("b.glb"));
    const Mesh again = read_mesh(scratch.path("b.glb"));
    EXPECT_EQ(again.positions, moved.positions);
    EXPECT_EQ(again.triangles, mesh.triangles);
    const ParsedGlb glb = parse_glb(mesh_glb(moved));
    EXPECT_EQ(glb.root["materials"].size(), 2U);
}

// As many faces around one vertex, and as many vertices in one place, as no shape has.
TEST(GltfParts, CrowdedVerticesAndPlaces) {
    constexpr int many = 100'000;
    Mesh fan;
    fan.positions = Points::Zero(many + 3, 3);
    fan.positions(many + 1, 0) = fan.positions(many + 2, 1) = 1;
    fan.triangles.resize(many, 3);
    for (int t = 0; t < many; ++t) fan.triangles.row(t) << many, many + 1, many + 2;
    fan.texcoord_triangles = fan.triangles;
    fan.texcoord_triangles.col(0).setLinSpaced(many, 0, many - 1);
    fan.texcoords = Texcoords::Zero(many + 3, 2);
    fan.texcoords.col(0).setLinSpaced(0, 1);
    const auto corners = corner_texcoords(fan);
    const NormalGroups flat = normal_groups(fan);
    const GltfParts parts = split_parts(fan, corners, flat, {});
    EXPECT_EQ(parts.primitives[0].vertices.size(), std::size_t(many + 3 + many - 1));

    // Without normals each vertex goes alone, wherever it lies.
    Triangles silent(many, 3);
    for (int t = 0; t < many; ++t) silent.row(t) << t, many + 1, many + 2;
    const NormalGroups groups = normal_groups(fan.positions, silent, Points::Zero(3 * many, 3));
    EXPECT_EQ(groups.vertices.size(), std::size_t(many + 2));
    EXPECT_EQ(groups.of(many - 1, 0), groups.of(many - 2, 0) + 1);
}

TEST(GltfParts, NumbersThatAreWrongAreNotBelieved) {
    const Scratch scratch;
    Mesh mesh = unit_cube();
    GltfMaker maker;
    maker.add_mesh(mesh);
    const auto read = [&](std::vector<float> numbers) {
        maker.primitive()["attributes"]["_VERTEX"] = maker.add(numbers, "SCALAR");
        return read_mesh(scratch.file("a.glb", maker.glb())).positions;
    };
    EXPECT_EQ(read({7, 6, 5, 4, 3, 2, 1, 0}), mesh.positions.colwise().reverse());
    for (const std::vector<float>& wrong : {std::vector<float>{0, 1, 2, 3, 4, 5, 6, 6},
                                            {0, 1, 2, 3, 4, 5, 6, 9},
                                            {0, 1, 2, 3, 4, 5, 6, -1},
                                            {0, 1, 2, 3, 4, 5, 6, 6.5F},
                                            {0, 1, 2}})
        EXPECT_EQ(read(wrong), mesh.positions);
}

TEST(GltfParts, APictureThatCannotBeHadIsToldAndWhite) {
    Mesh mesh = dressed_cube();
    auto file = std::make_shared<MeshFile>(*mesh.file);
    file->images[0] = {"photo", "", "", "/nowhere/photo.png"};
    mesh.file = file;
    EXPECT_NE(mesh_glb_notes(mesh).at(0).find("/nowhere/photo.png"), std::string::npos);
    file->images[0] = {"photo.tga", "", "no picture that glTF knows", {}};
    EXPECT_NE(mesh_glb_notes(mesh).at(0).find("photo.tga"), std::string::npos);
    const ParsedGlb glb = parse_glb(mesh_glb(mesh));
    EXPECT_EQ(glb.root["images"][0]["mimeType"], "image/png");
}

TEST(GltfParts, ATextureWithoutTexturecoordinatesIsLeftOut) {
    Mesh mesh = dressed_cube();
    mesh.texcoords.resize(0, 2);
    mesh.texcoord_triangles.resize(0, 3);
    const ParsedGlb glb = parse_glb(mesh_glb(mesh));
    EXPECT_FALSE(glb.root["materials"][0]["pbrMetallicRoughness"].contains("baseColorTexture"));
}

TEST(GltfParts, MaterialsOfAGltfComeWhole) {
    const Scratch scratch;
    GltfMaker maker;
    maker.add_mesh(unit_cube());
    maker.primitive()["attributes"]["TEXCOORD_0"] = maker.add(std::vector<float>(16, 0.5F), "VEC2");
    maker.primitive()["material"] = 0;
    maker.root["images"] =
        json::array({{{"bufferView", maker.view(png)}, {"mimeType", "image/png"}, {"name", "bumps"}}});
    maker.root["samplers"] = json::parse(R"([{"wrapS": 33071}])");
    maker.root["textures"] = json::parse(R"([{"source": 0, "sampler": 0}])");
    maker.root["materials"] = json::parse(R"([{"name": "m", "normalTexture": {"index": 0, "scale": 0.5,
        "extensions": {"KHR_texture_transform": {"scale": [2, 2]}}}, "extras": {"a": 1}}])");
    maker.root["extensionsUsed"] = json::parse(R"(["KHR_texture_transform", "KHR_lights_punctual"])");
    const Mesh mesh = read_mesh(scratch.file("a.glb", maker.glb()));
    const ParsedGlb glb = parse_glb(mesh_glb(mesh));
    EXPECT_EQ(glb.root["materials"], maker.root["materials"]);
    EXPECT_EQ(glb.root["textures"], maker.root["textures"]);
    EXPECT_EQ(glb.root["samplers"], maker.root["samplers"]);
    EXPECT_EQ(glb.root["extensionsUsed"], json({"KHR_texture_transform"}));
}

} // namespace
} // namespace meshtween
