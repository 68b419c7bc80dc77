// Makes small glTF files, with nothing of the reader or the writer.
#pragma once

#include "meshtween/core/mesh.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace meshtween {

struct GltfMaker {
    nlohmann::json root = {{"asset", {{"version", "2.0"}}}, {"scene", 0}};
    std::string bin;

    int view(const std::string& bytes) {
        bin.resize((bin.size() + 3) / 4 * 4, '\0');
        root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", bytes.size()}});
        bin += bytes;
        return static_cast<int>(root["bufferViews"].size()) - 1;
    }

    template <typename Number>
    static constexpr int component() {
        if (std::is_same_v<Number, float>) return 5126;
        return (sizeof(Number) == 1 ? 5120 : sizeof(Number) == 2 ? 5122 : 5124) + (std::is_unsigned_v<Number> ? 1 : 0);
    }

    // An accessor of "VEC3" and the like, with its bounds where it has three columns.
    template <typename Number>
    int add(const std::vector<Number>& values, const std::string& type, bool normalized = false) {
        const std::size_t columns = type == "SCALAR" ? 1
                                    : type == "MAT4" ? 16
                                                     : static_cast<std::size_t>(type[3] - '0');
        std::string bytes(values.size() * sizeof(Number), '\0');
        std::memcpy(bytes.data(), values.data(), bytes.size());
        nlohmann::json accessor = {{"bufferView", view(bytes)},
                                   {"componentType", component<Number>()},
                                   {"count", values.size() / columns},
                                   {"type", type}};
        if (normalized) accessor["normalized"] = true;
        for (std::size_t c = 0; c < columns && columns <= 3; ++c) {
            Number low = values[c], high = values[c];
            for (std::size_t i = c; i < values.size(); i += columns) {
                low = std::min(low, values[i]);
                high = std::max(high, values[i]);
            }
            accessor["min"].push_back(low);
            accessor["max"].push_back(high);
        }
        root["accessors"].push_back(accessor);
        return static_cast<int>(root["accessors"].size()) - 1;
    }

    // A mesh's positions and triangles as the only primitive of mesh 0, shown by node 0.
    void add_mesh(const Mesh& mesh) {
        std::vector<float> positions;
        for (Eigen::Index i = 0; i < mesh.positions.size(); ++i)
            positions.push_back(static_cast<float>(mesh.positions.data()[i]));
        std::vector<std::uint16_t> corners;
        for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i)
            corners.push_back(static_cast<std::uint16_t>(mesh.triangles.data()[i]));
        nlohmann::json primitive;
        primitive["attributes"]["POSITION"] = add(positions, "VEC3");
        primitive["indices"] = add(corners, "SCALAR");
        root["meshes"] = nlohmann::json::array({{{"primitives", nlohmann::json::array({primitive})}}});
        root["nodes"] = nlohmann::json::array({{{"mesh", 0}}});
        root["scenes"] = nlohmann::json::array({{{"nodes", {0}}}});
    }

    // Says of each bufferView what it is for, as validators like it.
    void set_targets() {
        const auto set = [&](const nlohmann::json& accessor, int target) {
            const nlohmann::json& view = root["accessors"][accessor.get<std::size_t>()]["bufferView"];
            root["bufferViews"][view.get<std::size_t>()]["target"] = target;
        };
        for (const nlohmann::json& mesh : root["meshes"])
            for (const nlohmann::json& part : mesh["primitives"]) {
                for (const nlohmann::json& accessor : part["attributes"]) set(accessor, 34962);
                for (const nlohmann::json& target : part.value("targets", nlohmann::json::array()))
                    for (const nlohmann::json& accessor : target) set(accessor, 34962);
                set(part["indices"], 34963);
            }
    }

    nlohmann::json& primitive() { return root["meshes"][0]["primitives"][0]; }

    // The GLB; unpadded: its chunks stand one right behind the other.
    std::string glb(bool padded = true) const {
        std::string data = bin;
        if (padded) data.resize((data.size() + 3) / 4 * 4, '\0');
        nlohmann::json whole = root;
        if (!whole.contains("buffers")) whole["buffers"] = nlohmann::json::array();
        if (whole["buffers"].empty()) whole["buffers"].push_back(nlohmann::json::object());
        whole["buffers"][0]["byteLength"] = data.size();
        std::string text = whole.dump();
        while (padded ? text.size() % 4 != 0 : text.size() % 4 != 3) text += ' ';
        std::string result = "glTF";
        const auto word = [&](std::size_t value) {
            const auto number = static_cast<std::uint32_t>(value);
            result.append(reinterpret_cast<const char*>(&number), 4);
        };
        word(2);
        word(28 + text.size() + data.size());
        word(text.size());
        result += "JSON" + text;
        word(data.size());
        result.append("BIN\0", 4);
        return result + data;
    }

    // The JSON for a file whose buffer lies beside it.
    std::string gltf(const std::string& uri) const {
        nlohmann::json whole = root;
        whole["buffers"] = nlohmann::json::array({{{"uri", uri}, {"byteLength", bin.size()}}});
        return whole.dump();
    }
};

} // namespace meshtween
