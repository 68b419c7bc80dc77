// A glTF file while it is put together: its JSON and its one buffer.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

namespace meshtween {

template <typename Number, int Columns>
using GltfColumns = Eigen::Matrix<Number, Eigen::Dynamic, Columns, Columns == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

constexpr int gltf_array_buffer = 34962, gltf_element_array_buffer = 34963, gltf_no_target = 0; // the specification's

struct Glb {
    nlohmann::json root;
    std::string bin;
};

template <typename Number>
constexpr int gltf_component_type() {
    if constexpr (std::is_same_v<Number, float>)
        return 5126;
    else
        return sizeof(Number) == 2 ? 5123 : 5125;
}

// Adds bytes to the buffer and tells their bufferView's number.
int append_view(Glb& glb, std::string_view bytes, int target = gltf_no_target);

// Adds the rows to the buffer and tells the accessor's number.
template <typename Number, int Columns>
int append(Glb& glb, const GltfColumns<Number, Columns>& rows, int target, bool bounds = false) {
    const char* const types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    nlohmann::json accessor = {
        {"componentType", gltf_component_type<Number>()}, {"count", rows.rows()}, {"type", types[Columns]}};
    if (bounds) {
        // Doubles hold floats exactly, and JSON gives doubles all their digits: the bounds are those of the data.
        for (int c = 0; c < Columns; ++c) {
            accessor["min"].push_back(static_cast<double>(rows.col(c).minCoeff()));
            accessor["max"].push_back(static_cast<double>(rows.col(c).maxCoeff()));
        }
    }
    const auto bytes = static_cast<std::size_t>(rows.size()) * sizeof(Number);
    accessor["bufferView"] = append_view(glb, {reinterpret_cast<const char*>(rows.data()), bytes}, target);
    glb.root["accessors"].push_back(std::move(accessor));
    return static_cast<int>(glb.root["accessors"].size()) - 1;
}

// The file as one GLB. Throws Error(argument) where it would be larger than a GLB can be (4 GiB).
std::string packed(Glb glb);

// The JSON of the same file as .gltf, whose buffer is the file `uri` beside it.
std::string unpacked_json(const Glb& glb, const std::string& uri);

} // namespace meshtween
