// A glTF file comes back as it was, with the positions of a new shape.
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include "support/errors.h"
#include "support/glb.h"
#include "support/gltf_maker.h"
#include "support/scratch.h"
#include "support/shapes.h"

#include <Eigen/Geometry>

#include <cmath>

namespace meshtween {
namespace {

using nlohmann::json;

// Somewhere else, everywhere differently.
Points bent(const Points& positions) {
    Points result = positions;
    for (Eigen::Index i = 0; i < result.rows(); ++i)
        result.row(i) = Point(positions(i, 0) + 0.3 * std::sin(positions(i, 1) + 1), 1.1 * positions(i, 1),
                              positions(i, 2) - 0.2 * positions(i, 0) * positions(i, 0));
    return result;
}

class GltfRewritten : public testing::Test {
protected:
    GltfRewritten() { maker.add_mesh(unit_cube()); }
    Mesh read() const { return read_mesh(scratch.file("a.glb", maker.glb())); }

    // Writes the bent mesh, reads it back, and gives the file.
    ParsedGlb bend(double tolerance = 1e-6) {
        Mesh mesh = read();
        mesh.positions = bent(mesh.positions);
        write_mesh(mesh, scratch.path("b.glb"));
        const Mesh back = read_mesh(scratch.path("b.glb"));
        EXPECT_EQ(back.triangles, mesh.triangles);
        EXPECT_LT((back.positions - mesh.positions).cwiseAbs().maxCoeff(), tolerance);
        return parse_glb(read_whole(scratch.path("b.glb")));
    }
    std::vector<std::uint8_t> eight_times(std::array<std::uint8_t, 4> row) const {
        std::vector<std::uint8_t> result;
        for (int i = 0; i < 8; ++i) result.insert(result.end(), row.begin(), row.end());
        return result;
    }
    std::vector<float> ramp(std::size_t count) const {
        std::vector<float> result;
        for (std::size_t i = 0; i < count; ++i) result.push_back(static_cast<float>(i) / 32);
        return result;
    }

    Scratch scratch;
    GltfMaker maker;
};

TEST_F(GltfRewritten, EverythingElseStays) {
    json& attributes = maker.primitive()["attributes"];
    attributes["TEXCOORD_0"] = maker.add(ramp(16), "VEC2");
    attributes["TEXCOORD_1"] = maker.add(ramp(16), "VEC2");
    attributes["JOINTS_0"] = maker.add(eight_times({0, 1, 0, 0}), "VEC4");
    attributes["WEIGHTS_0"] = maker.add(eight_times({155, 100, 0, 0}), "VEC4", true);
    maker.primitive()["targets"] = json::array({{{"POSITION", maker.add(ramp(24), "VEC3")}}});
    maker.primitive()["material"] = 0;
    maker.root["nodes"] = json::parse(R"([{"mesh": 0, "skin": 0, "name": "body", "extras": {"kind": 7}},
        {"name": "hips", "children": [2], "rotation": [0, 0.6, 0, 0.8], "scale": [0.5, 0.5, 0.5]},
        {"name": "knee", "translation": [0, 1, 0], "rotation": [0.6, 0, 0, 0.8]}, {"camera": 0}])");
    maker.root["skins"] = json::parse(R"([{"joints": [1, 2]}])");
    maker.root["scenes"][0]["nodes"] = {0, 1, 3};
    maker.root["cameras"] = json::parse(R"([{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}])");
    maker.root["materials"] = json::parse(R"([{"name": "skin", "emissiveFactor": [0.5, 0, 0]}])");
    const int times = maker.add(std::vector<float>{0, 1}, "SCALAR"), turns = maker.add(ramp(8), "VEC4");
    maker.root["animations"] =
        json::array({{{"samplers", json::array({{{"input", times}, {"output", turns}}})},
                      {"channels", json::array({{{"sampler", 0}, {"target", {{"node", 2}, {"path", "rotation"}}}}})}}});
    const ParsedGlb before = parse_glb(maker.glb()), after = bend();
    json old = before.root, now = after.root;
    EXPECT_EQ(before.bin.size(), after.bin.size()); // in place
    EXPECT_NE(before.bin.substr(0, 96), after.bin.substr(0, 96));
    EXPECT_EQ(before.bin.substr(96), after.bin.substr(96));
    for (json* root : {&old, &now})
        for (const char* key : {"min", "max"}) (*root)["accessors"][0].erase(key);
    EXPECT_EQ(old, now);
}

TEST_F(GltfRewritten, MeshesThatAreShownTwiceBecomeTwo) {
    maker.root["nodes"] = json::parse(R"([{"mesh": 0}, {"mesh": 0, "translation": [3, 0, 0], "scale": [-1, 1, 2]}])");
    maker.root["scenes"][0]["nodes"] = {0, 1};
    const ParsedGlb after = bend();
    EXPECT_EQ(after.root["meshes"].size(), 2U);
    EXPECT_EQ(after.root["nodes"][1]["mesh"], 1);
    EXPECT_EQ(after.root["nodes"][1]["scale"], json({-1, 1, 2}));

    maker.root["nodes"].push_back({{"mesh", 0}}); // of no scene: keeps the old one
    const ParsedGlb hidden = bend();
    EXPECT_EQ(hidden.root["nodes"][2]["mesh"], 0);
    EXPECT_EQ(hidden.bin.substr(0, 96), maker.bin.substr(0, 96));
}

TEST_F(GltfRewritten, InstancesBecomeNodes) {
    json& attributes = maker.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    attributes["TRANSLATION"] = maker.add(std::vector<float>{0, 0, 0, 2, 0, 0, 4, 0, 0}, "VEC3");
    maker.root["extensionsUsed"] = maker.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const ParsedGlb after = bend();
    EXPECT_FALSE(after.root.contains("extensionsUsed"));
    EXPECT_EQ(after.root["nodes"][0]["children"].size(), 3U);
}

TEST_F(GltfRewritten, WhatOthersUseIsLeftToThem) {
    // The positions are a texture coordinate's bytes too, and the mesh has lines along its edges.
    json again = maker.root["accessors"][0];
    again.update({{"type", "VEC2"}, {"count", 8}});
    again["min"].erase(2);
    again["max"].erase(2);
    maker.root["accessors"].push_back(again);
    maker.primitive()["attributes"]["TEXCOORD_0"] = 2;
    json lines = maker.primitive();
    lines["mode"] = 1;
    lines["attributes"].erase("TEXCOORD_0");
    maker.root["meshes"][0]["primitives"].push_back(lines);
    const ParsedGlb after = bend();
    EXPECT_EQ(after.bin.substr(0, 96), maker.bin.substr(0, 96));
    const json& primitives = after.root["meshes"][0]["primitives"];
    EXPECT_EQ(primitives[0]["attributes"]["POSITION"], primitives[1]["attributes"]["POSITION"]);
}

TEST_F(GltfRewritten, SparseQuantisedAndInterleavedPositions) {
    const Mesh cube = unit_cube();
    std::vector<std::int16_t> places;
    for (const double x : cube.positions.reshaped<Eigen::RowMajor>())
        places.push_back(static_cast<std::int16_t>(x * 32767));
    maker.primitive()["attributes"]["POSITION"] = maker.add(places, "VEC3", true);
    maker.root["extensionsUsed"] = maker.root["extensionsRequired"] = {"KHR_mesh_quantization"};
    maker.root["nodes"][0]["scale"] = {0.5, 0.5, 0.5};
    EXPECT_EQ(bend().root["accessors"][2]["componentType"], 5126);

    maker.primitive()["attributes"]["POSITION"] = 0;
    maker.root["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", maker.view(std::string("\3\0", 2))}, {"componentType", 5123}}},
        {"values", {{"bufferView", 0}}}};
    EXPECT_FALSE(bend().root["accessors"][0].contains("sparse"));

    std::vector<float> mixed; // place and texture coordinate in turn
    for (Eigen::Index i = 0; i < 8; ++i) {
        for (const double x : cube.positions.row(i)) mixed.push_back(static_cast<float>(x));
        mixed.insert(mixed.end(), {0.25F, 0.75F});
    }
    const int all = maker.add(mixed, "SCALAR");
    const json view = maker.root["accessors"][static_cast<std::size_t>(all)]["bufferView"];
    maker.root["bufferViews"][view.get<std::size_t>()]["byteStride"] = 20;
    maker.root["accessors"][0] = {{"bufferView", view}, {"componentType", 5126}, {"count", 8}, {"type", "VEC3"}};
    maker.root["accessors"][static_cast<std::size_t>(all)] = {
        {"bufferView", view}, {"byteOffset", 12}, {"componentType", 5126}, {"count", 8}, {"type", "VEC2"}};
    maker.primitive()["attributes"]["TEXCOORD_0"] = all;
    EXPECT_EQ(bend().bin.size(), (maker.bin.size() + 3) / 4 * 4);
}

TEST_F(GltfRewritten, DefaultWeightsAreTakenOffAgain) {
    maker.primitive()["targets"] = json::array({{{"POSITION", maker.add(ramp(24), "VEC3")}}});
    maker.root["meshes"][0]["weights"] = {0.5};
    bend();
}

// Every corner of a cube has three normals, one a side; so has the new shape.
TEST_F(GltfRewritten, NormalsAreSplitWhereTheyWere) {
    const Mesh cube = unit_cube();
    std::vector<float> places, normals, tangents;
    std::vector<std::uint16_t> corners;
    for (Eigen::Index t = 0; t < 12; ++t)
        for (int c = 0; c < 3; ++c) {
            const Point a = cube.positions.row(cube.triangles(t, 0)), b = cube.positions.row(cube.triangles(t, 1)),
                        d = cube.positions.row(cube.triangles(t, 2)), n = (b - a).cross(d - a).normalized();
            for (const double x : cube.positions.row(cube.triangles(t, c))) places.push_back(static_cast<float>(x));
            for (const double x : n) normals.push_back(static_cast<float>(x));
            for (const double x : (b - a).normalized()) tangents.push_back(static_cast<float>(x));
            tangents.push_back(-1);
            corners.push_back(static_cast<std::uint16_t>(corners.size()));
        }
    json& attributes = maker.primitive()["attributes"];
    attributes = {{"POSITION", maker.add(places, "VEC3")},
                  {"NORMAL", maker.add(normals, "VEC3")},
                  {"TANGENT", maker.add(tangents, "VEC4")}};
    maker.primitive()["indices"] = maker.add(corners, "SCALAR");
    Mesh mesh = read();
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    mesh.positions = mesh.positions * turn.transpose();
    write_mesh(mesh, scratch.path("b.glb"));
    const ParsedGlb after = parse_glb(read_whole(scratch.path("b.glb")));
    const auto n = accessor<float>(after, after.root["meshes"][0]["primitives"][0]["attributes"]["NORMAL"]);
    const auto s = accessor<float>(after, after.root["meshes"][0]["primitives"][0]["attributes"]["TANGENT"]);
    for (Eigen::Index i = 0; i < 36; ++i) {
        const auto row = static_cast<std::size_t>(i);
        const Eigen::Vector3d was(normals[3 * row], normals[3 * row + 1], normals[3 * row + 2]);
        const Eigen::Vector3d along(tangents[4 * row], tangents[4 * row + 1], tangents[4 * row + 2]);
        EXPECT_NEAR((n.row(i).transpose().cast<double>() - turn * was).norm(), 0, 1e-6);
        EXPECT_NEAR((s.row(i).head<3>().transpose().cast<double>() - turn * along).norm(), 0, 1e-6);
        EXPECT_EQ(s(i, 3), -1);
    }
}

TEST_F(GltfRewritten, GltfKeepsItsBufferBeside) {
    maker.root["images"] = json::parse(R"([{"uri": "skin.png"}])");
    scratch.file("a.bin", maker.bin);
    Mesh mesh = read_mesh(scratch.file("a.gltf", maker.gltf("a.bin")));
    mesh.positions = bent(mesh.positions);
    write_mesh(mesh, scratch.path("out.gltf"));
    const json root = json::parse(read_whole(scratch.path("out.gltf")));
    EXPECT_EQ(root["buffers"][0]["uri"], "out.bin");
    EXPECT_EQ(read_whole(scratch.path("out.bin")).size(), maker.bin.size());
    EXPECT_EQ(read_whole(scratch.path("a.bin")), maker.bin);
    const Mesh back = read_mesh(scratch.path("out.gltf"));
    EXPECT_LT((back.positions - mesh.positions).cwiseAbs().maxCoeff(), 1e-6);
    write_mesh(mesh, scratch.path("out.glb"));
    EXPECT_EQ(read_mesh(scratch.path("out.glb")).positions, back.positions);
    write_mesh(unit_cube(), scratch.path("cube.gltf")); // a mesh of no file
    EXPECT_EQ(read_mesh(scratch.path("cube.gltf")).positions, unit_cube().positions);
}

TEST_F(GltfRewritten, ABufferThatIsGoneIsTold) {
    scratch.file("a.bin", maker.bin);
    const Mesh mesh = read_mesh(scratch.file("a.gltf", maker.gltf("a.bin")));
    std::filesystem::remove(scratch.path("a.bin"));
    const std::vector<std::string> notes = write_mesh(mesh, scratch.path("out.gltf"));
    ASSERT_FALSE(notes.empty());
    EXPECT_NE(notes[0].find("written anew"), std::string::npos) << notes[0];
    EXPECT_NE(notes[0].find("a.bin"), std::string::npos) << notes[0];
    EXPECT_EQ(read_mesh(scratch.path("out.gltf")).positions, mesh.positions) << "the shape is not lost";
}

} // namespace
} // namespace meshtween
