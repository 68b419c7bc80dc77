#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include "support/errors.h"
#include "support/scratch.h"
#include "support/shapes.h"

#include <nlohmann/json.hpp>

#include <cstring>

namespace meshtween {
namespace {

using nlohmann::json;

// A file with a triangle's data in a buffer beside it, to be changed by each test.
class GltfRead : public testing::Test {
protected:
    GltfRead() {
        put<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}); // 48 bytes: four places
        put<std::uint16_t>({0, 1, 2, 3});                 // 8 bytes
        put<std::uint8_t>({0, 51, 255, 255, 255, 255});   // two colours
        root = json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                          {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
            "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 8}],
            "buffers": [{"uri": "the%20data.bin", "byteLength": 62}]})");
    }
    template <typename Number>
    void put(std::initializer_list<Number> values) {
        for (const Number value : values) {
            std::array<char, sizeof(Number)> raw;
            std::memcpy(raw.data(), &value, sizeof value);
            data.append(raw.data(), raw.size());
        }
    }
    std::filesystem::path file() const {
        scratch.file("the data.bin", data);
        return scratch.file("a.gltf", root.dump());
    }
    Mesh read() const { return read_mesh(file()); }
    std::string complaint() const {
        return message_of(ErrorKind::file, [&] { read(); });
    }

    Scratch scratch;
    std::string data;
    json root;
};

TEST_F(GltfRead, ATriangle) {
    const Mesh mesh = read();
    EXPECT_EQ(mesh.positions.rows(), 4);
    EXPECT_EQ(mesh.positions.row(3), Point(1, 1, 0));
    EXPECT_EQ(mesh.triangles, (Triangles(1, 3) << 0, 1, 2).finished());
}

TEST_F(GltfRead, WhatIsWrittenIsRead) {
    Mesh mesh = wavy_sheet(7, 9);
    mesh.positions = mesh.positions.cast<float>().cast<double>();
    mesh.texcoords.resize(mesh.positions.rows(), 2);
    for (Eigen::Index i = 0; i < mesh.texcoords.rows(); ++i) mesh.texcoords.row(i) << float(i) / 64, float(i % 4) / 4;
    mesh.texcoord_triangles = mesh.triangles;
    mesh.colors = Colors::Constant(mesh.positions.rows(), 4, 1);
    for (Eigen::Index i = 0; i < mesh.colors.rows(); ++i) mesh.colors(i, 0) = static_cast<float>(i * 4) / 255;
    write_mesh(mesh, scratch.path("a.glb"));
    const Mesh back = read_mesh(scratch.path("a.glb"));
    EXPECT_EQ(back.positions, mesh.positions);
    EXPECT_EQ(back.triangles, mesh.triangles);
    EXPECT_EQ(back.texcoords, mesh.texcoords);
    EXPECT_EQ(back.colors, mesh.colors);
}

TEST_F(GltfRead, NodesPlaceTheirMeshes) {
    root["scenes"][0]["nodes"] = {0, 1};
    root["nodes"] = json::parse(R"([{"translation": [10, 0, 0], "scale": [2, 2, 2], "mesh": 0, "children": [2]},
        {"mesh": 0, "matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]},
        {"mesh": 0, "rotation": [0, 0, 0.70710678118654757, 0.70710678118654757]}])");
    const Mesh mesh = read();
    ASSERT_EQ(mesh.positions.rows(), 12);
    EXPECT_EQ(mesh.positions.row(3), Point(12, 2, 0));
    EXPECT_NEAR((mesh.positions.row(4 + 3) - Point(10 - 2, 2, 0)).norm(), 0, 1e-12); // the child, turned by 90 degrees
    EXPECT_EQ(mesh.positions.row(8 + 1), Point(-1, 0, 5));
    EXPECT_EQ(mesh.triangles.row(2), Eigen::RowVector3i(8, 10, 9)); // a mirror turns triangles over, so they turn back
}

TEST_F(GltfRead, PartsThatShareTheirVerticesStillDo) {
    json second = root["meshes"][0]["primitives"][0];
    second["mode"] = 5;
    second["indices"] = 2;
    root["accessors"].push_back(
        json::parse(R"({"bufferView": 1, "componentType": 5123, "count": 4, "type": "SCALAR"})"));
    json third = second;
    third["mode"] = 6;
    json points = second;
    points["mode"] = 0;
    root["meshes"][0]["primitives"].insert(root["meshes"][0]["primitives"].end(), {points, second, third});
    const Mesh mesh = read();
    EXPECT_EQ(mesh.positions.rows(), 4);
    EXPECT_EQ(mesh.triangles, (Triangles(5, 3) << 0, 1, 2, 0, 1, 2, 1, 3, 2, 0, 1, 2, 0, 2, 3).finished());
}

TEST_F(GltfRead, CornersNamedTwiceOnlyLeadOnInAStrip) {
    root["buffers"].push_back({{"byteLength", 12}, {"uri", "data:;base64,AAABAAIAAgABAAMA"}});
    root["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 12}});
    root["accessors"].push_back(
        {{"bufferView", root["bufferViews"].size() - 1}, {"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}});
    json& primitive = root["meshes"][0]["primitives"][0];
    primitive["indices"] = root["accessors"].size() - 1;
    primitive["mode"] = 5;
    EXPECT_EQ(read().triangles, (Triangles(2, 3) << 0, 1, 2, 2, 3, 1).finished());
}

TEST_F(GltfRead, SparseAccessorsAndColoursOfBytes) {
    root["accessors"][0]["sparse"] = json::parse(R"({"count": 1, "indices": {"bufferView": 1, "byteOffset": 4,
        "componentType": 5123}, "values": {"bufferView": 0, "byteOffset": 36}})"); // place 2 becomes place 3's
    root["bufferViews"].push_back(json::parse(R"({"buffer": 0, "byteOffset": 56, "byteLength": 6, "byteStride": 1})"));
    root["accessors"].push_back(
        json::parse(R"({"bufferView": 2, "componentType": 5121, "normalized": true, "count": 4, "type": "VEC3"})"));
    root["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 2;
    const Mesh mesh = read();
    EXPECT_EQ(mesh.positions.row(2), Point(1, 1, 0));
    ASSERT_EQ(mesh.colors.rows(), 4);
    EXPECT_EQ(mesh.colors(0, 0), 0);
    EXPECT_NEAR(mesh.colors(0, 1), 0.4845, 1e-4); // 0.2 linear
    EXPECT_EQ(mesh.colors.row(3), Eigen::RowVector4f(1, 1, 1, 1));
}

TEST_F(GltfRead, DataInTheFile) {
    root["buffers"][0]["uri"] = "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
                                "AACAPwAAgD8AAAAAAAABAAIAAwAAM/////8=";
    EXPECT_EQ(read().positions.row(3), Point(1, 1, 0));
}

TEST_F(GltfRead, DamageIsTold) {
    const struct {
        const char *pointer, *value, *words;
    } rows[] = {
        {"/asset", "null", "asset"},
        {"/extensionsRequired", R"(["VENDOR_packing"])", "needs the extension VENDOR_packing"},
        {"/accessors/0/count", "5", "promises 5 elements"},
        {"/accessors/0/count", "4000000000", "promises 4000000000 elements"},
        {"/accessors/0/count", "-1", "no sensible number"},
        {"/accessors/0/type", "\"MAT3\"", "MAT3"},
        {"/accessors/0/type", "7", "not of numbers"},
        {"/accessors/0/componentType", "17", "component type"},
        {"/accessors/0/byteOffset", "49", "begins beyond"},
        {"/accessors/0/bufferView", "9", "no bufferViews[9]"},
        {"/accessors/1/byteOffset", "2", ""},
        {"/bufferViews/0/byteLength", "63", "reaches beyond"},
        {"/bufferViews/0/byteOffset", "1099511627776", "reaches beyond"},
        {"/bufferViews/0/buffer", "1", "reaches beyond"},
        {"/buffers/0/uri", "\"../secret.bin\"", "outside its folder"},
        {"/buffers/0/uri", "\"/etc/passwd\"", "outside its folder"},
        {"/buffers/0/uri", "\"file:///etc/passwd\"", "outside its folder"},
        {"/buffers/0/uri", "\"..%2fsecret.bin\"", "outside its folder"},
        {"/buffers/0/uri", "\"none.bin\"", "no such file"},
        {"/buffers/0/uri", "\"data:,x\"", "base64"},
        {"/nodes/0/children", "[0]", "two parents"},
        {"/nodes/0/translation", "[1, 2]", "translation"},
        {"/nodes/0/rotation", "\"up\"", "rotation"},
        {"/nodes/0/mesh", "3", "no meshes[3]"},
        {"/scenes/0/nodes", "[8]", "no nodes[8]"},
        {"/scenes/0/nodes", "[]", "no vertices"},
        {"/meshes/0/primitives/0/mode", "1", "no vertices"},
        {"/meshes/0/primitives/0/attributes/TEXCOORD_0", "0", "does not agree"},
        {"/meshes/0/primitives/0/attributes/COLOR_0", "1", "does not agree"},
    };
    const json whole = root;
    for (const auto& row : rows) {
        root = whole;
        root[json::json_pointer(row.pointer)] = json::parse(row.value);
        if (*row.words == '\0') {
            EXPECT_EQ(read().triangles, (Triangles(1, 3) << 1, 2, 3).finished());
            continue;
        }
        const std::string message = complaint();
        EXPECT_NE(message.find(row.words), std::string::npos) << row.pointer << ' ' << row.value << ": " << message;
        EXPECT_NE(message.find(scratch.folder().string()), std::string::npos) << message;
    }
    root = whole;
    data[48] = 9;
    EXPECT_NE(complaint().find("names vertex 9, but its part has 4"), std::string::npos);
}

TEST_F(GltfRead, DamageInTheContainerIsTold) {
    write_mesh(unit_cube(), scratch.path("a.glb"));
    const std::string whole = read_whole(scratch.path("a.glb"));
    const auto complaint_of = [&](const std::string& bytes) {
        return message_of(ErrorKind::file, [&] { read_mesh(scratch.file("b.glb", bytes)); });
    };
    EXPECT_NE(complaint_of(whole.substr(0, 11)).find("truncated"), std::string::npos);
    EXPECT_NE(complaint_of(whole.substr(0, whole.size() - 5)).find("truncated"), std::string::npos);
    std::string old = whole;
    old[4] = 1;
    EXPECT_NE(complaint_of(old).find("version 1"), std::string::npos);
    EXPECT_NE(complaint_of("not json at all").find("JSON"), std::string::npos);
}

} // namespace
} // namespace meshtween
