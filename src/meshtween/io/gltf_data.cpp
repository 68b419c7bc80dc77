// glTF 2.0 specification (Khronos, 2021): 3.6 binary data, 4 the GLB container. Read over a JSON library alone, since a
// mesh needs neither pictures nor a loader that decodes them.
#include "meshtween/io/gltf_data.h"

#include "meshtween/io/output.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>

namespace meshtween {
namespace {

static_assert(std::endian::native == std::endian::little, "glTF's numbers are read as memory has them");
using nlohmann::json;

std::uint32_t word_at(std::string_view bytes, std::size_t offset) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    return c == '+' || c == '-' ? 62 : c == '/' || c == '_' ? 63 : -1;
}

// Stops at the first character that is no digit: the padding, or damage that shows as a buffer too short.
std::string from_base64(std::string_view text) {
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3);
    std::uint32_t word = 0;
    int bits = 0;
    for (const char c : text) {
        const int digit = base64_digit(c);
        if (digit < 0) break;
        word = word << 6 | static_cast<std::uint32_t>(digit);
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes += static_cast<char>(word >> bits & 0xff);
        }
    }
    return bytes;
}

std::string from_percent(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned code = 0;
        if (text[i] == '%' && i + 2 < text.size() &&
            std::from_chars(text.data() + i + 1, text.data() + i + 3, code, 16).ptr == text.data() + i + 3) {
            result += static_cast<char>(code);
            i += 2;
        } else {
            result += text[i];
        }
    }
    return result;
}

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

GltfData::GltfData(std::string_view bytes, std::filesystem::path path) : path_(std::move(path)), total_(bytes.size()) {
    split_container(bytes);
    if (!root_.is_object() || !root_.value("asset", json()).is_object()) fail("is no glTF file: it has no 'asset'");
    refuse_extensions();
    load_buffers();
}

void GltfData::fail(std::string_view what) const {
    bad_file(path_, what);
}

void GltfData::split_container(std::string_view bytes) {
    std::string_view text = bytes;
    if (bytes.substr(0, 4) == "glTF") {
        if (bytes.size() < 20) fail("the file ends in its header; it is truncated");
        if (word_at(bytes, 4) != 2)
            fail(fmt::format("is glTF of version {}; version 2 is read, convert it first", word_at(bytes, 4)));
        if (word_at(bytes, 8) > bytes.size())
            fail(fmt::format("promises {} bytes, but the file has {}; it is truncated", word_at(bytes, 8),
                             bytes.size()));
        for (std::size_t at = 12; at + 8 <= bytes.size();) {
            const std::size_t size = word_at(bytes, at), kind = word_at(bytes, at + 4);
            if (size > bytes.size() - at - 8) fail("a chunk is longer than the file, which is truncated or damaged");
            if (at == 12) text = bytes.substr(at + 8, size);
            if (kind == 0x004E4942 && binary_.empty()) binary_ = bytes.substr(at + 8, size); // "BIN"
            at += 8 + (size + 3) / 4 * 4;
        }
    }
    try {
        root_ = json::parse(text.begin(), text.end());
    } catch (const json::exception& error) {
        fail(fmt::format("its JSON cannot be read ({:.120}); the file is damaged or of another format", error.what()));
    }
}

void GltfData::refuse_extensions() const {
    const json& required = root_.value("extensionsRequired", json::array());
    for (const json& name : required)
        if (name == "KHR_draco_mesh_compression" || name == "EXT_meshopt_compression")
            fail(fmt::format("is compressed with {}, which is not read; export it without compression",
                             name == "KHR_draco_mesh_compression" ? "Draco" : "meshopt"));
}

void GltfData::load_buffers() {
    const std::size_t count = root_.contains("buffers") ? root_["buffers"].size() : 0;
    loaded_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const json& buffer = item("buffers", i);
        if (!buffer.contains("uri")) {
            buffers_.push_back(i == 0 ? binary_ : std::string_view());
            continue;
        }
        if (!buffer["uri"].is_string()) fail(fmt::format("buffer {}: its uri is no text", i));
        loaded_[i] = load_uri(buffer["uri"].get<std::string>());
        total_ += loaded_[i].size();
        buffers_.push_back(loaded_[i]);
    }
}

// Only files beside this one or below: a model from elsewhere must not read what it likes.
std::string GltfData::load_uri(const std::string& uri) const {
    if (uri.compare(0, 5, "data:") == 0) {
        const std::size_t comma = uri.find(";base64,");
        if (comma == std::string::npos) fail("a data: uri is not in base64");
        return from_base64(std::string_view(uri).substr(comma + 8));
    }
    const std::filesystem::path name = from_percent(uri);
    bool inside = name.is_relative() && uri.find("://") == std::string::npos;
    for (const auto& part : name) inside = inside && part != "..";
    if (!inside) fail(fmt::format("names the buffer '{}', which lies outside its folder; put it beside", shown(uri)));
    return read_whole(path_.parent_path() / name);
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
        fail(fmt::format("'{}' is {}, which is no sensible number; the file is damaged", key, shown(found->dump())));
    return found->get<std::size_t>();
}

std::size_t GltfData::number(const json& object, const char* key) const {
    if (!object.contains(key)) fail(fmt::format("'{}' is missing; the file is damaged", key));
    return number(object, key, 0);
}

GltfData::View GltfData::view(std::size_t index) const {
    const json& found = item("bufferViews", index);
    const std::size_t buffer = number(found, "buffer"), offset = number(found, "byteOffset", 0),
                      length = number(found, "byteLength");
    if (buffer >= buffers_.size() || offset > buffers_[buffer].size() || length > buffers_[buffer].size() - offset)
        fail(fmt::format("bufferViews[{}] reaches beyond its buffer; the file is truncated or damaged", index));
    return {buffers_[buffer].substr(offset, length), number(found, "byteStride", 0)};
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
    rows.values.reserve(count * rows.columns);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < rows.columns; ++c)
            rows.values.push_back(value_at(bytes.data() + i * stride + c * size, component_type, normalized));
}

GltfRows GltfData::rows(std::size_t index) const {
    const json& accessor = item("accessors", index);
    GltfRows rows;
    const std::string type = accessor.value("type", json()).is_string() ? accessor["type"].get<std::string>() : "";
    static constexpr std::array<std::string_view, 5> types{"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    for (std::size_t c = 1; c < types.size(); ++c)
        if (type == types[c]) rows.columns = c;
    if (rows.columns == 0)
        fail(fmt::format("accessors[{}] is of type '{}', not of numbers or vectors", index, shown(type)));
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

} // namespace meshtween
