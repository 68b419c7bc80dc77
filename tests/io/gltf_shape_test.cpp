// Whatever changes the shape of a glTF file is obeyed or refused by name.
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/mesh_io.h"

#include "support/errors.h"
#include "support/gltf_maker.h"
#include "support/scratch.h"
#include "support/shapes.h"

#ifdef MESHTWEEN_DRACO
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#endif
#ifdef MESHTWEEN_MESHOPT
#include <meshoptimizer.h>
#endif

namespace meshtween {
namespace {

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
        compression["byteLength"] = 20;
        EXPECT_NE(complaint().find("meshopt data that cannot be decoded"), std::string::npos);
        compression["byteLength"] = 100000;
        EXPECT_NE(complaint().find("reaches beyond"), std::string::npos);
    }
}
#endif

} // namespace
} // namespace meshtween
