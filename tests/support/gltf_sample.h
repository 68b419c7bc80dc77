// A model such as Khronos collects: textured, two sets of texture coordinates, edges, a skin, a morph target, an
// animation.
#pragma once

#include "support/gltf_maker.h"

#include "meshtween/geometry/measure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meshtween {

// `mesh` lies along x, from 0 to 3, and bends at a joint in its middle. Normals are split between its sides and its
// ends.
inline GltfMaker gltf_sample(const Mesh& mesh, const std::string& png) {
    GltfMaker maker;
    std::vector<float> places, normals, tangents, uv, more, weights, lift;
    std::vector<std::uint8_t> joints;
    std::vector<std::uint16_t> corners;
    const Points shading = vertex_normals(mesh.positions, mesh.triangles);
    const auto put = [](std::vector<float>& into, const auto& row) {
        for (const auto x : row) into.push_back(static_cast<float>(x));
    };
    for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
        const Point p = mesh.positions.row(i), n = shading.row(i);
        const double u = p[0] / 3, v = std::atan2(p[2], p[1]) / (2 * std::numbers::pi) + 0.5;
        put(places, p);
        put(normals, n);
        put(tangents, Point(n.unitOrthogonal()));
        tangents.push_back(1);
        put(uv, std::array{4 * u, 2 * v});
        put(more, std::array{v, u});
        const float second = static_cast<float>(std::clamp(2 * u - 0.5, 0.0, 1.0));
        put(weights, std::array{1 - second, second, 0.0F, 0.0F});
        joints.insert(joints.end(), {0, static_cast<std::uint8_t>(second > 0 ? 1 : 0), 0, 0});
        put(lift, std::array{0.0, 0.2 * std::sin(std::numbers::pi * u), 0.0});
    }
    for (Eigen::Index k = 0; k < mesh.triangles.size(); ++k)
        corners.push_back(static_cast<std::uint16_t>(mesh.triangles.data()[k]));
    nlohmann::json primitive;
    primitive["attributes"] = {{"POSITION", maker.add(places, "VEC3")},  {"NORMAL", maker.add(normals, "VEC3")},
                               {"TANGENT", maker.add(tangents, "VEC4")}, {"TEXCOORD_0", maker.add(uv, "VEC2")},
                               {"TEXCOORD_1", maker.add(more, "VEC2")},  {"JOINTS_0", maker.add(joints, "VEC4")},
                               {"WEIGHTS_0", maker.add(weights, "VEC4")}};
    primitive["indices"] = maker.add(corners, "SCALAR");
    primitive["targets"] = nlohmann::json::array({{{"POSITION", maker.add(lift, "VEC3")}}});
    primitive["material"] = 0;
    maker.root["meshes"] =
        nlohmann::json::array({{{"name", "bar"}, {"primitives", nlohmann::json::array({primitive})}}});
    maker.root["images"] =
        nlohmann::json::array({{{"bufferView", maker.view(png)}, {"mimeType", "image/png"}, {"name", "checks"}}});
    maker.root["samplers"] = nlohmann::json::parse(R"([{"magFilter": 9729, "minFilter": 9987}])");
    maker.root["textures"] = nlohmann::json::parse(R"([{"source": 0, "sampler": 0}])");
    maker.root["materials"] = nlohmann::json::parse(R"([{"name": "checked", "pbrMetallicRoughness":
        {"baseColorTexture": {"index": 0}, "metallicFactor": 0, "roughnessFactor": 0.5},
        "occlusionTexture": {"index": 0, "texCoord": 1, "strength": 0.3}}])");
    std::vector<float> inverse(32, 0);
    for (std::size_t i = 0; i < 4; ++i) inverse[5 * i] = inverse[16 + 5 * i] = 1;
    inverse[16 + 12] = -1.5F;
    maker.root["skins"] =
        nlohmann::json::array({{{"joints", {1, 2}}, {"inverseBindMatrices", maker.add(inverse, "MAT4")}}});
    for (const char* bound : {"min", "max"}) maker.root["accessors"].back().erase(bound);
    maker.root["nodes"] = nlohmann::json::parse(R"([{"mesh": 0, "skin": 0, "name": "body"},
        {"name": "first", "children": [2]},
        {"name": "second", "translation": [1.5, 0, 0], "rotation": [0, 0, 0.25881904510252074, 0.9659258262890683]}])");
    maker.root["scenes"] = nlohmann::json::parse(R"([{"nodes": [0, 1]}])");
    const int times = maker.add(std::vector<float>{0, 1}, "SCALAR"),
              weight = maker.add(std::vector<float>{0, 1}, "SCALAR");
    maker.root["animations"] = nlohmann::json::array(
        {{{"samplers", nlohmann::json::array({{{"input", times}, {"output", weight}}})},
          {"channels", nlohmann::json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}})}}});
    maker.set_targets();
    return maker;
}

} // namespace meshtween
