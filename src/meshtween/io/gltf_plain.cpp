// glTF 2.0 specification (Khronos, 2021): 3.6 binary data; KHR_draco_mesh_compression, EXT_meshopt_compression.
#include "meshtween/io/gltf_plain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>

namespace meshtween {
namespace {

using nlohmann::json;

std::size_t number_or(const json& object, const char* key, std::size_t otherwise) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number_unsigned() ? found->get<std::size_t>() : otherwise;
}

std::size_t columns_of(const json& accessor) {
    static constexpr std::array<std::pair<const char*, std::size_t>, 7> types{
        {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};
    for (const auto& [name, columns] : types)
        if (accessor.value("type", json()) == name) return columns;
    return 0;
}

template <typename Number>
void append_number(std::string& bytes, double value) {
    const auto number = static_cast<Number>(value);
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

// A number as the accessor's component type has it.
void append_component(std::string& bytes, double value, std::size_t type, bool normalized) {
    const std::size_t size = component_size(type);
    if (normalized && type != 5126)
        value = std::round(value * (std::exp2(8.0 * static_cast<double>(size) - (type % 2 == 0 ? 1 : 0)) - 1));
    if (type == 5120) append_number<std::int8_t>(bytes, value);
    if (type == 5121) append_number<std::uint8_t>(bytes, value);
    if (type == 5122) append_number<std::int16_t>(bytes, value);
    if (type == 5123) append_number<std::uint16_t>(bytes, value);
    if (type == 5125) append_number<std::uint32_t>(bytes, value);
    if (type == 5126) append_number<float>(bytes, value);
}

// Gives data to an accessor that has none. Rows of vertex attributes begin at multiples of four.
void fill_accessor(Glb& glb, std::size_t index, const GltfRows& rows, int target) {
    json& accessor = glb.root.at("accessors").at(index); // [] would add what is not there
    if (accessor.contains("bufferView")) return;
    const std::size_t type = number_or(accessor, "componentType", 0);
    const bool normalized = accessor.value("normalized", json(false)) == true;
    std::string bytes;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t c = 0; c < rows.columns; ++c)
            append_component(bytes, rows.values[i * rows.columns + c], type, normalized);
        if (target == gltf_array_buffer) bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    }
    const int view = append_view(glb, bytes, target);
    if (target == gltf_array_buffer && rows.size() > 0)
        glb.root["bufferViews"][static_cast<std::size_t>(view)]["byteStride"] = bytes.size() / rows.size();
    accessor["bufferView"] = view;
    accessor["count"] = rows.size();
}

void drop_extension(json& object, const char* name) {
    if (!object.contains("extensions")) return;
    object["extensions"].erase(name);
    if (object["extensions"].empty()) object.erase("extensions");
}

void merge_buffers(Glb& glb, const GltfData& data) {
    std::vector<std::size_t> begins;
    std::map<const char*, std::size_t> known; // buffers of one file are one
    for (const std::string_view bytes : data.buffers()) {
        if (const auto same = known.find(bytes.data()); same != known.end() && !bytes.empty()) {
            begins.push_back(same->second);
            continue;
        }
        glb.bin.resize((glb.bin.size() + 7) / 8 * 8, '\0');
        begins.push_back(glb.bin.size());
        known.emplace(bytes.data(), begins.back());
        glb.bin.append(bytes);
    }
    for (std::size_t v = 0; v < data.count("bufferViews"); ++v) {
        json& view = glb.root["bufferViews"][v];
        const std::string_view bytes = data.view_bytes(v); // which sees that it is there
        const json extensions = view.value("extensions", json::object());
        if (extensions.contains("EXT_meshopt_compression") || extensions.contains("KHR_meshopt_compression")) {
            glb.bin.resize((glb.bin.size() + 7) / 8 * 8, '\0');
            view["byteOffset"] = glb.bin.size();
            view["byteLength"] = bytes.size();
            glb.bin.append(bytes);
            drop_extension(view, "EXT_meshopt_compression");
            drop_extension(view, "KHR_meshopt_compression");
        } else {
            view["byteOffset"] = number_or(view, "byteOffset", 0) + begins[number_or(view, "buffer", 0)];
        }
        view["buffer"] = 0;
    }
    json buffer = data.count("buffers") > 0 ? data.root()["buffers"][0] : json::object();
    buffer.erase("extensions");
    buffer.erase("uri");
    glb.root["buffers"] = json::array({buffer});
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) forget_extension(glb.root, name);
}

void decode_primitives(Glb& glb, const GltfData& data) {
    for (std::size_t m = 0; m < data.count("meshes"); ++m) {
        const json& mesh = data.item("meshes", m);
        const auto primitives = mesh.find("primitives");
        for (std::size_t p = 0; primitives != mesh.end() && p < primitives->size(); ++p) {
            const json& primitive = (*primitives)[p];
            const json extensions = primitive.value("extensions", json::object());
            if (!extensions.contains("KHR_draco_mesh_compression")) continue;
            for (const auto& [name, accessor] : primitive.at("attributes").items())
                fill_accessor(glb, accessor.get<std::size_t>(), data.attribute(primitive, name), gltf_array_buffer);
            if (primitive.contains("indices"))
                fill_accessor(glb, primitive["indices"].get<std::size_t>(), {1, data.corners(primitive, 0)},
                              gltf_element_array_buffer);
            drop_extension(glb.root["meshes"][m]["primitives"][p], "KHR_draco_mesh_compression");
        }
    }
    forget_extension(glb.root, "KHR_draco_mesh_compression");
}

} // namespace

void forget_extension(json& root, const std::string& name) {
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
        if (!root.contains(list) || !root[list].is_array()) continue;
        json kept = json::array();
        for (const json& used : root[list])
            if (used != name) kept.push_back(used);
        if (kept.empty())
            root.erase(list);
        else
            root[list] = std::move(kept);
    }
}

Glb plain_gltf(const GltfData& data) {
    Glb glb{data.root(), {}};
    merge_buffers(glb, data);
    decode_primitives(glb, data);
    return glb;
}

std::vector<char> byte_owners(const Glb& glb) {
    std::vector<char> owners(glb.bin.size(), 0);
    const auto mark = [&](std::size_t begin, std::size_t length) {
        for (std::size_t i = begin; i < std::min(begin + length, owners.size()); ++i)
            owners[i] = static_cast<char>(std::min(owners[i] + 1, 2));
    };
    const json empty = json::array();
    const auto list = [&](const char* name) -> const json& { return glb.root.contains(name) ? glb.root[name] : empty; };
    const auto mark_view = [&](const json& object) {
        const std::size_t v = number_or(object, "bufferView", list("bufferViews").size());
        if (v >= list("bufferViews").size()) return;
        const json& view = list("bufferViews")[v];
        mark(number_or(view, "byteOffset", 0), number_or(view, "byteLength", 0));
    };
    for (const json& image : list("images")) mark_view(image);
    for (const json& accessor : list("accessors")) {
        if (accessor.contains("sparse")) {
            mark_view(accessor["sparse"].value("indices", json::object()));
            mark_view(accessor["sparse"].value("values", json::object()));
        }
        const std::size_t v = number_or(accessor, "bufferView", list("bufferViews").size());
        if (v >= list("bufferViews").size()) continue;
        const json& view = list("bufferViews")[v];
        const std::size_t row = columns_of(accessor) * component_size(number_or(accessor, "componentType", 0));
        const std::size_t stride = std::max<std::size_t>(number_or(view, "byteStride", row), 1);
        const std::size_t begin = number_or(view, "byteOffset", 0) + number_or(accessor, "byteOffset", 0);
        const std::size_t count = number_or(accessor, "count", 0);
        for (std::size_t i = 0; i < count && begin + i * stride < owners.size(); ++i) mark(begin + i * stride, row);
    }
    return owners;
}

void replace_rows(Glb& glb, std::size_t index, const std::vector<char>& owners, const std::vector<float>& values,
                  std::size_t columns, bool bounds) {
    json& accessor = glb.root.at("accessors").at(index);
    const std::size_t row = columns * sizeof(float), count = values.size() / columns;
    bool own = number_or(accessor, "componentType", 0) == 5126 && columns_of(accessor) == columns &&
               number_or(accessor, "count", 0) == count && accessor.contains("bufferView") &&
               !accessor.contains("sparse");
    std::size_t begin = 0, stride = row;
    if (own) {
        const json& view = glb.root.at("bufferViews").at(accessor["bufferView"].get<std::size_t>());
        begin = number_or(view, "byteOffset", 0) + number_or(accessor, "byteOffset", 0);
        stride = number_or(view, "byteStride", row);
        for (std::size_t i = 0; i < count && own; ++i)
            for (std::size_t b = begin + i * stride; b < begin + i * stride + row && own; ++b)
                own = b < owners.size() && owners[b] == 1;
    }
    const char* bytes = reinterpret_cast<const char*>(values.data());
    if (own) {
        for (std::size_t i = 0; i < count; ++i) std::memcpy(glb.bin.data() + begin + i * stride, bytes + i * row, row);
    } else {
        for (const char* key : {"sparse", "normalized", "byteOffset"}) accessor.erase(key);
        accessor["componentType"] = 5126;
        accessor["bufferView"] = append_view(glb, {bytes, values.size() * sizeof(float)}, gltf_array_buffer);
    }
    if (!bounds) {
        accessor.erase("min");
        accessor.erase("max");
        return;
    }
    std::vector<double> low(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(columns)), high = low;
    for (std::size_t i = 0; i < values.size(); ++i) {
        low[i % columns] = std::min<double>(low[i % columns], values[i]);
        high[i % columns] = std::max<double>(high[i % columns], values[i]);
    }
    accessor["min"] = low;
    accessor["max"] = high;
}

} // namespace meshtween
