// Whatever changes the shape of a glTF file is obeyed or refused by name.
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/mesh_io.h"

#include "support/errors.h"
#include "support/gltf_maker.h"
#include "support/scratch.h"
#include "support/shapes.h"

#include <filesystem>
#include <numeric>

#ifdef MESHTWEEN_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif
#ifdef MESHTWEEN_MESHOPT
#include <meshoptimizer.h>
#endif

namespace meshtween {
namespace {

using namespace std::string_literals;
using nlohmann::json;

class GltfShape : public testing::Test {
protected:
    GltfShape() { maker.add_mesh(unit_cube()); }
    Mesh read() const { return read_mesh(scratch.file("a.glb", maker.glb())); }
    std::string complaint() const {
        return message_of(ErrorKind::file, [&] { read(); });
    }
    Scratch scratch;
    GltfMaker maker;
};

// The bytes of a cube's eight weights and joints: all on joint 0.
std::vector<std::uint8_t> eight_times(std::array<std::uint8_t, 4> row) {
    std::vector<std::uint8_t> result;
    for (int i = 0; i < 8; ++i) result.insert(result.end(), row.begin(), row.end());
    return result;
}

TEST_F(GltfShape, ASkinIsReadInItsRestPose) {
    maker.primitive()["attributes"]["JOINTS_0"] = maker.add(eight_times({0, 1, 0, 0}), "VEC4");
    maker.primitive()["attributes"]["WEIGHTS_0"] = maker.add(eight_times({255, 0, 0, 0}), "VEC4", true);
    maker.root["nodes"] = json::parse(R"([{"mesh": 0, "skin": 0, "translation": [9, 9, 9]},
        {"children": [2], "rotation": [-0.70710678118654757, 0, 0, 0.70710678118654757], "scale": [0.01, 0.01, 0.01]},
        {}, {"translation": [0, 4, 0]}])");
    maker.root["scenes"][0]["nodes"] = {0, 1};
    maker.root["skins"] = json::parse(R"([{"joints": [2, 3]}])");
    Mesh mesh = read();
    EXPECT_NEAR((mesh.positions.colwise().minCoeff() - Point(0, 0, -0.01)).norm(), 0, 1e-12);
    EXPECT_NEAR((mesh.positions.colwise().maxCoeff() - Point(0.01, 0.01, 0)).norm(), 0, 1e-12);
    EXPECT_NEAR((mesh.positions.row(7) - Point(0.01, 0.01, -0.01)).norm(), 0, 1e-12);

    // Half on each of two joints, with weights that do not add up to 1, after the second's inverse bind matrix.
    maker.root["accessors"].erase(3);
    maker.primitive()["attributes"]["WEIGHTS_0"] = maker.add(eight_times({100, 100, 0, 0}), "VEC4", true);
    maker.root["nodes"][1] = json::object({{"children", {2}}});
    std::vector<float> inverse(32, 0);
    for (std::size_t i = 0; i < 4; ++i) inverse[5 * i] = inverse[16 + 5 * i] = 1;
    inverse[16 + 12] = 2; // moves along x
    maker.root["skins"][0]["inverseBindMatrices"] = maker.add(inverse, "MAT4");
    mesh = read();
    EXPECT_NEAR((mesh.positions.row(0) - Point(1, 2, 0)).norm(), 0, 1e-12);

    maker.primitive()["attributes"]["JOINTS_0"] = maker.add(eight_times({0, 2, 0, 0}), "VEC4");
    EXPECT_NE(complaint().find("hangs on joint 2, but its skin has 2"), std::string::npos);
}

TEST_F(GltfShape, DefaultWeightsMove) {
    std::vector<float> lift(24, 0);
    for (std::size_t i = 0; i < 8; ++i) lift[3 * i + 2] = 2.0F * static_cast<float>(i >> 2 & 1);
    maker.primitive()["targets"] = json::array({{{"POSITION", maker.add(lift, "VEC3")}}});
    EXPECT_EQ(read().positions.col(2).maxCoeff(), 1);
    maker.root["meshes"][0]["weights"] = {1};
    EXPECT_EQ(read().positions.col(2).maxCoeff(), 3);
    maker.root["nodes"][0]["weights"] = {0.5}; // the node's go before the mesh's
    EXPECT_EQ(read().positions.col(2).maxCoeff(), 2);
    EXPECT_NE(read().file->notes.at(0).find("default weights"), std::string::npos);
    maker.primitive()["targets"][0]["POSITION"] = maker.add(std::vector<float>(9, 1), "VEC3");
    EXPECT_NE(complaint().find("a morph target does not agree"), std::string::npos);
}

TEST_F(GltfShape, InstancesBecomeVertices) {
    maker.root["nodes"][0]["translation"] = {0, 0, 10};
    json& attributes = maker.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    attributes["TRANSLATION"] = maker.add(std::vector<float>{0, 0, 0, 2, 0, 0, 4, 0, 0}, "VEC3");
    attributes["SCALE"] = maker.add(std::vector<float>{1, 1, 1, 1, 1, 1, -1, 1, 1}, "VEC3");
    maker.root["extensionsUsed"] = maker.root["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
    const Mesh mesh = read();
    ASSERT_EQ(mesh.positions.rows(), 24);
    EXPECT_EQ(mesh.triangles.rows(), 36);
    EXPECT_EQ(mesh.positions.row(8 + 7), Point(3, 1, 11));
    EXPECT_EQ(mesh.positions.row(16 + 7), Point(3, 1, 11));
    EXPECT_EQ(mesh.triangles.row(24), Eigen::RowVector3i(16, 17, 18)); // mirrored, so turned back
    attributes["ROTATION"] = maker.add(std::vector<float>{0, 0, 0, 1}, "VEC4");
    EXPECT_NE(complaint().find("ROTATION does not agree"), std::string::npos);
}

// Small files that ask for more than they hold.
TEST_F(GltfShape, CountsWithoutDataAreNotBelieved) {
    const GltfMaker cube = maker;
    maker.root["accessors"][0]["count"] = 99'000'000;
    EXPECT_NE(complaint().find("promises 99000000 elements"), std::string::npos);

    // Joints are shared by instances, and by nodes with the same skin.
    maker = cube;
    maker.primitive()["attributes"]["JOINTS_0"] = maker.add(eight_times({0, 0, 0, 0}), "VEC4");
    maker.primitive()["attributes"]["WEIGHTS_0"] = maker.add(eight_times({255, 0, 0, 0}), "VEC4", true);
    maker.root["skins"] = {{{"joints", std::vector<int>(50'000, 0)}}};
    maker.root["nodes"][0] = {{"mesh", 0}, {"skin", 0}};
    const GltfMaker skinned = maker;
    maker.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] =
        maker.add(std::vector<float>(30'000, 1), "VEC3");
    EXPECT_EQ(read().positions.rows(), 80'000);
    maker = skinned;
    maker.root["nodes"] = json(std::vector<json>(10'000, maker.root["nodes"][0]));
    std::vector<int> all(10'000);
    std::iota(all.begin(), all.end(), 0);
    maker.root["scenes"][0]["nodes"] = all;
    EXPECT_EQ(read().positions.rows(), 80'000);
    for (int set = 1; set < 20; ++set)
        for (const char* name : {"JOINTS_", "WEIGHTS_"})
            maker.primitive()["attributes"][name + std::to_string(set)] = maker.primitive()["attributes"][name + "0"s];
    EXPECT_NE(complaint().find("more than 16 sets of joints"), std::string::npos);

    // Parts, their vertices and the weights of their morph targets.
    maker = cube;
    maker.root["meshes"].push_back({{"primitives", json::array()}});
    const int scale = maker.add(std::vector<float>(30'000, 1), "VEC3");
    json node = {{"mesh", 1}};
    node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["SCALE"] = scale;
    maker.root["nodes"] = json(std::vector<json>(300, node));
    maker.root["scenes"][0]["nodes"] = std::vector<int>(all.begin(), all.begin() + 300);
    EXPECT_NE(complaint().find("more than 2000000 parts"), std::string::npos);
    maker.root["meshes"][1]["primitives"] = std::vector<json>(500, maker.primitive());
    maker.root["scenes"][0]["nodes"] = {0};
    EXPECT_NE(complaint().find("more than 2000000 parts"), std::string::npos);
    maker = cube;
    maker.root["nodes"] = json(std::vector<json>(10'000, maker.root["nodes"][0]));
    maker.root["scenes"][0]["nodes"] = all;
    maker.root["meshes"][0]["weights"] = std::vector<int>(20'000, 1);
    EXPECT_NE(complaint().find("more than 100000000 weights"), std::string::npos);
}

TEST_F(GltfShape, DataThatAreNamedAgainAndAgain) {
    const int strip = maker.add(std::vector<std::uint16_t>(100'000, 0), "SCALAR");
    json part = maker.primitive();
    part["mode"] = 5;
    part["indices"] = strip;
    std::vector<json> parts(3000, part);
    parts.front() = maker.primitive();
    maker.root["meshes"][0]["primitives"] = parts;
    EXPECT_NE(complaint().find("name the same data again and again"), std::string::npos);
}

// What does not touch the shape is left out and told.
TEST_F(GltfShape, TexturecoordinatesAndPicturesAreLimited) {
    const int uv = maker.add(std::vector<float>(16, 0), "VEC2");
    for (int set = 0; set < 1000; ++set) maker.primitive()["attributes"]["TEXCOORD_" + std::to_string(set)] = uv;
    const int view = maker.view(std::string(100'000, 'x'));
    maker.root["images"] = std::vector<json>(1000, {{"bufferView", view}, {"mimeType", "image/png"}});
    const Mesh mesh = read();
    EXPECT_EQ(mesh.positions, unit_cube().positions);
    EXPECT_EQ(mesh.file->more_texcoords.size(), 15U);
    std::size_t bytes = 0;
    for (const TextureImage& image : mesh.file->images) bytes += image.bytes.size();
    EXPECT_LT(bytes, 20 * mesh.file->bytes.size());
    std::string notes;
    for (const std::string& note : mesh.file->notes) notes += note + "\n";
    EXPECT_NE(notes.find("more than 16 sets of texture coordinates"), std::string::npos) << notes;
    EXPECT_NE(notes.find("pictures are damaged: left out"), std::string::npos) << notes;
}

TEST_F(GltfShape, AFileThatManyBuffersNameIsReadOnce) {
    scratch.file("more.bin", std::string(10'000'000, '\0'));
    std::vector<json> buffers(20'000, {{"uri", "more.bin"}, {"byteLength", 10'000'000}});
    buffers[0] = json::object();
    buffers[2]["uri"] = "./more.bin";
    maker.root["buffers"] = buffers;
    const Mesh mesh = read();
    EXPECT_EQ(mesh.positions, unit_cube().positions);
    write_mesh(mesh, scratch.path("b.glb"));
    EXPECT_LT(std::filesystem::file_size(scratch.path("b.glb")), 12'000'000U);
}

TEST_F(GltfShape, ManyNamedNodesAreReadInOneGo) {
    std::vector<json> nodes;
    std::vector<int> all;
    for (int i = 0; i < 40'000; ++i) {
        nodes.push_back({{"mesh", 0}, {"name", "node " + std::to_string(i)}});
        all.push_back(i);
    }
    maker.root["nodes"] = nodes;
    maker.root["scenes"][0]["nodes"] = all;
    const Mesh mesh = read();
    ASSERT_EQ(mesh.file->objects.names.size(), 40'000U);
    EXPECT_EQ(mesh.file->objects.names[39'999], "node 39999");
    EXPECT_EQ(mesh.file->objects.of.back(), 39'999);
}

TEST_F(GltfShape, WhatIsRequiredAndUnknownIsRefusedByName) {
    for (const char* name : {"KHR_materials_unlit", "KHR_texture_transform", "EXT_texture_webp", "KHR_lights_punctual",
                             "KHR_mesh_quantization", "KHR_texture_basisu", "MSFT_texture_dds"}) {
        maker.root["extensionsRequired"] = {name};
        EXPECT_EQ(read().positions.rows(), 8) << name;
    }
    for (const char* name : {"VENDOR_geometry_packing", "EXT_implicit_shapes", "CESIUM_RTC", "materials_x"}) {
        maker.root["extensionsRequired"] = {"KHR_materials_unlit", name};
        EXPECT_NE(complaint().find(name), std::string::npos) << name;
    }
    maker.root["extensionsRequired"] = {7};
    EXPECT_NE(complaint().find("no name"), std::string::npos);
}

TEST_F(GltfShape, ChunksWithoutPaddingAndOldVersions) {
    EXPECT_EQ(read_mesh(scratch.file("u.glb", maker.glb(false))).positions, unit_cube().positions);
    maker.root["asset"]["version"] = "1.0";
    EXPECT_NE(complaint().find("version 1.0"), std::string::npos);
    maker.root["asset"]["version"] = "0.8";
    EXPECT_NE(complaint().find("version 0.8"), std::string::npos);
    const auto told = [&](const char* text) {
        return message_of(ErrorKind::file, [&] { read_mesh(scratch.file("v.gltf", text)); });
    };
    EXPECT_NE(told(R"({"meshes": {"m": {}}, "nodes": {}})").find("version 1.0"), std::string::npos);
    EXPECT_NE(told(R"({"asset": {"version": "3.0"}})").find("version 3.0"), std::string::npos);
    EXPECT_NE(told(R"({"asset": {"version": "2.0", "minVersion": "2.1"}})").find("version 2.1"), std::string::npos);
}

TEST_F(GltfShape, ABufferOfPicturesMayBeMissing) {
    maker.root["buffers"] = json::parse(R"([{}, {"uri": "none.bin", "byteLength": 4}])");
    EXPECT_EQ(read().positions.rows(), 8);
}

TEST_F(GltfShape, QuantisedPositions) {
    std::vector<std::int16_t> places;
    const Mesh cube = unit_cube();
    for (const double x : cube.positions.reshaped<Eigen::RowMajor>())
        places.push_back(static_cast<std::int16_t>(x * 32767));
    maker.primitive()["attributes"]["POSITION"] = maker.add(places, "VEC3", true);
    EXPECT_EQ(read().positions, unit_cube().positions);
}

TEST_F(GltfShape, PointsAndLinesAreCounted) {
    json lines = maker.primitive();
    lines["mode"] = 1;
    maker.root["meshes"][0]["primitives"].push_back(lines);
    EXPECT_NE(read().file->notes.at(0).find("1 of its parts are points or lines"), std::string::npos);
}

#ifdef MESHTWEEN_DRACO
std::string draco_cube() {
    draco::TriangleSoupMeshBuilder builder;
    const Mesh cube = unit_cube();
    builder.Start(static_cast<int>(cube.triangles.rows()));
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (Eigen::Index t = 0; t < cube.triangles.rows(); ++t) {
        std::array<Eigen::RowVector3f, 3> p;
        for (int c = 0; c < 3; ++c)
            p[static_cast<std::size_t>(c)] = cube.positions.row(cube.triangles(t, c)).cast<float>();
        builder.SetAttributeValuesForFace(position, draco::FaceIndex(static_cast<std::uint32_t>(t)), p[0].data(),
                                          p[1].data(), p[2].data());
    }
    const auto mesh = builder.Finalize();
    draco::Encoder encoder;
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {buffer.data(), buffer.size()};
}

TEST_F(GltfShape, DracoIsDecoded) {
    for (const char* key : {"bufferView", "byteOffset"})
        for (json& accessor : maker.root["accessors"]) accessor.erase(key);
    json& draco = maker.primitive()["extensions"]["KHR_draco_mesh_compression"];
    draco = {{"bufferView", maker.view(draco_cube())}, {"attributes", {{"POSITION", 0}}}};
    maker.root["extensionsUsed"] = maker.root["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    const Mesh mesh = read();
    ASSERT_EQ(mesh.positions.rows(), 8);
    EXPECT_EQ(mesh.triangles.rows(), 12);
    EXPECT_EQ(mesh.positions.colwise().sum(), Point(4, 4, 4));
    EXPECT_EQ(mesh.positions.cwiseProduct(mesh.positions), mesh.positions); // all 0 or 1

    // Only the rewriting asks for what an index says of the corners.
    const json corners = maker.primitive()["indices"];
    maker.primitive()["indices"] = 1'000'000'000'000;
    const Mesh damaged = read();
    const std::vector<std::string> notes = write_mesh(damaged, scratch.path("b.glb"));
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find("parts of the template's file are damaged"), std::string::npos) << notes[0];
    maker.primitive()["indices"] = corners;

    draco["attributes"]["POSITION"] = 5;
    EXPECT_NE(complaint().find("Draco mesh lacks POSITION"), std::string::npos);
    draco["bufferView"] = 0; // which holds no such thing
    EXPECT_NE(complaint().find("Draco"), std::string::npos);
    maker.root["extensionsRequired"].clear();
    EXPECT_NE(complaint().find("Draco"), std::string::npos);
}
#endif

#ifdef MESHTWEEN_MESHOPT
TEST_F(GltfShape, MeshoptIsDecoded) {
    const Mesh cube = unit_cube();
    const Eigen::Matrix<float, 8, 3, Eigen::RowMajor> places = cube.positions.cast<float>();
    std::string packed(meshopt_encodeVertexBufferBound(8, 12), '\0');
    packed.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(packed.data()), packed.size(),
                                             places.data(), 8, 12));
    const int raw = maker.view(packed);
    json at = maker.root["bufferViews"][static_cast<std::size_t>(raw)];
    at.update({{"byteStride", 12}, {"count", 8}, {"mode", "ATTRIBUTES"}});
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        maker.root["bufferViews"][0] = {{"buffer", 1}, {"byteLength", 96}, {"extensions", {{name, at}}}};
        maker.root["buffers"] = json::parse(R"([{}, {"byteLength": 96}])");
        maker.root["extensionsUsed"] = maker.root["extensionsRequired"] = {name};
        EXPECT_EQ(read().positions, cube.positions);
        json& compression = maker.root["bufferViews"][0]["extensions"][name];
        compression["mode"] = "OTHER";
        EXPECT_NE(complaint().find("meshopt"), std::string::npos);
        compression["mode"] = "ATTRIBUTES";
        compression["count"] = 100'000; // a megabyte
        EXPECT_NE(complaint().find("meshopt in a way that is not known"), std::string::npos);
        compression["count"] = 8;
        compression["byteLength"] = 20;
        EXPECT_NE(complaint().find("meshopt data that cannot be decoded"), std::string::npos);
        compression["byteLength"] = 100000;
        EXPECT_NE(complaint().find("reaches beyond"), std::string::npos);
    }
}
#endif

} // namespace
} // namespace meshtween
