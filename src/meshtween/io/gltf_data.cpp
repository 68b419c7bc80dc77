// glTF 2.0 specification (Khronos, 2021): 3.6.2 accessors; KHR_draco_mesh_compression, EXT_meshopt_compression.
#include "meshtween/io/gltf_data.h"

#include "meshtween/core/error.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <utility>

namespace meshtween {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF's numbers are read as memory has them");
using nlohmann::json;

// A small file can name the same data any number of times; each vertex that is laid out and each byte asks for few.
std::size_t most_numbers(std::size_t bytes, std::size_t vertices) {
    return 100'000'000 + 100 * (bytes + vertices);
}

template <typename Number>
double value_at(const char* raw, bool normalized) {
    Number value;
    std::memcpy(&value, raw, sizeof value);
    if constexpr (std::is_floating_point_v<Number>)
        return value;
    else
        return normalized ? std::max(static_cast<double>(value) / std::numeric_limits<Number>::max(), -1.0)
                          : static_cast<double>(value);
}

double value_at(const char* raw, std::size_t type, bool normalized) {
    switch (type) {
    case 5120:
        return value_at<std::int8_t>(raw, normalized);
    case 5121:
        return value_at<std::uint8_t>(raw, normalized);
    case 5122:
        return value_at<std::int16_t>(raw, normalized);
    case 5123:
        return value_at<std::uint16_t>(raw, normalized);
    case 5125:
        return value_at<std::uint32_t>(raw, normalized);
    default:
        return value_at<float>(raw, normalized);
    }
}

} // namespace

std::size_t component_size(std::size_t type) {
    switch (type) {
    case 5120:
    case 5121:
        return 1;
    case 5122:
    case 5123:
        return 2;
    case 5125:
    case 5126:
        return 4;
    default:
        return 0;
    }
}

const json& GltfData::item(const char* list, std::size_t index) const {
    const auto found = root_.find(list);
    if (found == root_.end() || !found->is_array() || index >= found->size() || !(*found)[index].is_object())
        fail(fmt::format("has no {}[{}], though something names it; the file is damaged", list, index));
    return (*found)[index];
}

std::size_t GltfData::number(const json& object, const char* key, std::size_t otherwise) const {
    const auto found = object.find(key);
    if (found == object.end()) return otherwise;
    constexpr std::uint64_t most = std::uint64_t{1} << 40;
    if (!found->is_number_unsigned() || found->get<std::uint64_t>() > most)
        fail(fmt::format("'{}' is {}, which is no sensible number; the file is damaged", key,
                         found->is_structured() ? "a list" : shown(found->dump())));
    return found->get<std::size_t>();
}

std::size_t GltfData::number(const json& object, const char* key) const {
    if (!object.contains(key)) fail(fmt::format("'{}' is missing; the file is damaged", key));
    return number(object, key, 0);
}

std::size_t GltfData::count(const char* list) const {
    const auto found = root_.find(list);
    return found == root_.end() || !found->is_array() ? 0 : found->size();
}

std::vector<std::size_t> GltfData::numbers(const json& object, const char* key) const {
    std::vector<std::size_t> result;
    const auto found = object.find(key);
    if (found == object.end()) return result;
    for (const json& index : *found) {
        if (!index.is_number_unsigned()) fail(fmt::format("'{}' holds no list of numbers", key));
        result.push_back(index.get<std::size_t>());
    }
    return result;
}

std::vector<double> GltfData::reals(const json& object, const char* key) const {
    std::vector<double> result;
    const auto found = object.find(key);
    if (found == object.end()) return result;
    for (const json& value : *found) {
        if (!value.is_number()) fail(fmt::format("'{}' is damaged: it holds something that is no number", key));
        result.push_back(value.get<double>());
    }
    return result;
}

// The bytes that a bufferView, or its compressed form, points at.
std::string_view GltfData::range(const json& object, const std::string& what) const {
    const std::size_t buffer = number(object, "buffer"), offset = number(object, "byteOffset", 0),
                      length = number(object, "byteLength");
    if (buffer < missing_.size() && !missing_[buffer].empty()) throw Error(ErrorKind::file, missing_[buffer]);
    if (buffer >= buffers_.size() || offset > buffers_[buffer].size() || length > buffers_[buffer].size() - offset)
        fail(fmt::format("{} reaches beyond its buffer; the file is truncated or damaged", what));
    return buffers_[buffer].substr(offset, length);
}

GltfData::View GltfData::view(std::size_t index) const {
    const json& found = item("bufferViews", index);
    if (const auto extensions = found.find("extensions"); extensions != found.end())
        for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"})
            if (const auto compression = extensions->find(name); compression != extensions->end())
                return {decoded_view(index, *compression), number(*compression, "byteStride")};
    return {range(found, fmt::format("bufferViews[{}]", index)), number(found, "byteStride", 0)};
}

std::string_view GltfData::decoded_view(std::size_t index, const json& compression) const {
    if (const auto known = views_.find(index); known != views_.end()) return known->second;
    const auto text = [&](const char* key) {
        const json value = compression.value(key, json());
        return value.is_string() ? value.get<std::string>() : std::string();
    };
    const std::string_view bytes = range(compression, fmt::format("the compressed bufferViews[{}]", index));
    count_decoded(bytes.size());
    MeshoptBytes decoded = decode_meshopt(
        bytes, {number(compression, "count"), number(compression, "byteStride"), text("mode"), text("filter")});
    if (!decoded.trouble.empty()) fail(decoded.trouble);
    return views_[index] = std::move(decoded.bytes);
}

void GltfData::count_read(std::size_t numbers) const {
    read_ += numbers;
    if (const std::size_t most = most_numbers(total_, vertices_); read_ > most)
        fail(fmt::format("its parts name the same data again and again, more than {} numbers in all; the file is "
                         "damaged",
                         most));
}

// What is compressed is there once.
void GltfData::count_decoded(std::size_t bytes) const {
    decoded_ += bytes;
    if (decoded_ > 2 * total_) fail("its compressed parts lie over one another; the file is damaged");
}

std::string_view GltfData::view_bytes(std::size_t index) const {
    return view(index).bytes;
}

void GltfData::read_numbers(std::string_view bytes, std::size_t stride, std::size_t component_type, bool normalized,
                            GltfRows& rows, std::size_t count) const {
    const std::size_t size = component_size(component_type);
    if (size == 0) fail(fmt::format("{} is no component type; the file is damaged", component_type));
    const std::size_t row = size * rows.columns;
    if (stride == 0) stride = row;
    if (count > 0 && (bytes.size() < row || (bytes.size() - row) / stride < count - 1))
        fail(fmt::format(
            "an accessor promises {} elements, more than its {} bytes hold; the file is truncated or damaged", count,
            bytes.size()));
    count_read(count * rows.columns);
    rows.values.reserve(count * rows.columns);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < rows.columns; ++c)
            rows.values.push_back(value_at(bytes.data() + i * stride + c * size, component_type, normalized));
}

std::size_t GltfData::columns_of(std::size_t index, const json& accessor) const {
    const std::string type = accessor.value("type", json()).is_string() ? accessor["type"].get<std::string>() : "";
    static constexpr std::array<std::string_view, 5> types{"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    for (std::size_t c = 1; c < types.size(); ++c)
        if (type == types[c]) return c;
    if (type == "MAT4" && accessor.value("componentType", json()) == 5126) return 16; // floats leave no gaps
    fail(fmt::format("accessors[{}] is of type '{}', not of numbers or vectors", index, shown(type)));
}

GltfRows GltfData::rows(std::size_t index) const {
    const json& accessor = item("accessors", index);
    GltfRows rows;
    rows.columns = columns_of(index, accessor);
    const std::size_t count = number(accessor, "count");
    if (accessor.contains("bufferView")) {
        View source = view(number(accessor, "bufferView"));
        const std::size_t offset = number(accessor, "byteOffset", 0);
        if (offset > source.bytes.size()) fail(fmt::format("accessors[{}] begins beyond its bufferView", index));
        const json normalized = accessor.value("normalized", json(false));
        read_numbers(source.bytes.substr(offset), source.stride, number(accessor, "componentType"), normalized == true,
                     rows, count);
    } else {
        if (count > total_) fail(fmt::format("accessors[{}] promises {} elements without data", index, count));
        count_read(count * rows.columns);
        rows.values.assign(count * rows.columns, 0);
    }
    if (accessor.contains("sparse")) read_sparse(accessor, rows);
    return rows;
}

// Some rows are replaced by others: (index, row) pairs in two more views.
void GltfData::read_sparse(const json& accessor, GltfRows& rows) const {
    const json& sparse = accessor["sparse"];
    if (!sparse.is_object() || !sparse.contains("indices") || !sparse.contains("values"))
        fail("a sparse accessor lacks its indices or values; the file is damaged");
    const std::size_t count = number(sparse, "count");
    const auto part = [&](const char* key, std::size_t columns, std::size_t type, bool normalized) {
        const View source = view(number(sparse[key], "bufferView"));
        const std::size_t offset = std::min(number(sparse[key], "byteOffset", 0), source.bytes.size());
        GltfRows result{columns, {}};
        read_numbers(source.bytes.substr(offset), 0, type, normalized, result, count);
        return result;
    };
    const GltfRows indices = part("indices", 1, number(sparse["indices"], "componentType"), false);
    const GltfRows values = part("values", rows.columns, number(accessor, "componentType"),
                                 accessor.value("normalized", json(false)) == true);
    for (std::size_t i = 0; i < count; ++i) {
        const double row = indices.values[i];
        if (!(row >= 0 && row < static_cast<double>(rows.size()))) fail("a sparse accessor's index is out of range");
        for (std::size_t c = 0; c < rows.columns; ++c)
            rows.values[static_cast<std::size_t>(row) * rows.columns + c] = values.values[i * rows.columns + c];
    }
}

// The decoded part of a primitive that Draco compressed; null for any other.
const DracoMesh* GltfData::draco(const json& primitive) const {
    const auto extensions = primitive.find("extensions");
    if (extensions == primitive.end() || !extensions->is_object()) return nullptr;
    const auto compression = extensions->find("KHR_draco_mesh_compression");
    if (compression == extensions->end()) return nullptr;
    const std::size_t index = number(*compression, "bufferView");
    auto known = draco_.find(index);
    if (known == draco_.end()) {
        const std::string_view bytes = view_bytes(index);
        count_decoded(bytes.size());
        known = draco_.emplace(index, decode_draco(bytes)).first;
    }
    if (known->second.trouble.empty()) return &known->second;
    const json& position = item("accessors", number(primitive.at("attributes"), "POSITION"));
    if (position.contains("bufferView")) return nullptr; // the file holds it uncompressed too
    fail(known->second.trouble);
}

GltfRows GltfData::attribute(const json& primitive, const std::string& name) const {
    const std::size_t index = number(primitive.at("attributes"), name.c_str());
    const DracoMesh* compressed = draco(primitive);
    if (compressed == nullptr) return rows(index);
    const json& compression = primitive["extensions"]["KHR_draco_mesh_compression"];
    const auto numbers = compression.find("attributes");
    if (numbers == compression.end() || !numbers->contains(name)) return rows(index);
    const auto found = compressed->of.find(number(*numbers, name.c_str()));
    if (found == compressed->of.end()) fail(fmt::format("its Draco mesh lacks {}; the file is damaged", name));
    const json& accessor = item("accessors", index);
    count_read(found->second.values.size());
    GltfRows result = found->second;
    if (result.columns != columns_of(index, accessor)) fail(fmt::format("its Draco mesh has another {}", name));
    const std::size_t type = number(accessor, "componentType");
    if (accessor.value("normalized", json(false)) == true && component_size(type) > 0 && type != 5126) {
        const double most = std::exp2(8.0 * static_cast<double>(component_size(type)) - (type % 2 == 0 ? 1 : 0)) - 1;
        for (double& value : result.values) value = std::max(value / most, -1.0);
    }
    return result;
}

std::vector<double> GltfData::corners(const json& primitive, std::size_t vertices) const {
    if (const DracoMesh* compressed = draco(primitive)) {
        count_read(compressed->corners.size());
        return compressed->corners;
    }
    if (primitive.contains("indices")) return rows(number(primitive, "indices")).values;
    count_read(vertices);
    std::vector<double> corners(vertices);
    std::iota(corners.begin(), corners.end(), 0.0);
    return corners;
}

} // namespace meshtween
