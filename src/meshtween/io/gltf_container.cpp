// glTF 2.0 specification (Khronos, 2021): 3.6.1 buffers, 4 the GLB container. Read over a JSON library alone, since a
// mesh needs neither pictures nor a loader that decodes them.
#include "meshtween/io/gltf_data.h"

#include "meshtween/core/error.h"
#include "meshtween/io/json_limits.h"
#include "meshtween/io/output.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <cstring>
#include <utility>

namespace meshtween {
namespace {

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

} // namespace

std::filesystem::path file_of_uri(const std::filesystem::path& gltf, const std::string& uri) {
    const std::filesystem::path name = from_percent(uri);
    bool inside = name.is_relative() && uri.find("://") == std::string::npos && uri.compare(0, 5, "data:") != 0;
    for (const auto& part : name) inside = inside && part != "..";
    return inside ? gltf.parent_path() / name : std::filesystem::path();
}

std::string data_of_uri(std::string_view uri) {
    const std::size_t comma = uri.find(";base64,");
    if (uri.substr(0, 5) != "data:" || comma == std::string_view::npos) return {};
    return from_base64(uri.substr(comma + 8));
}

GltfData::GltfData(std::string_view bytes, std::filesystem::path path) : path_(std::move(path)), total_(bytes.size()) {
    split_container(bytes);
    if (!root_.is_object()) fail("is no glTF file: it has no 'asset'");
    check_version();
    load_buffers();
}

void GltfData::fail(std::string_view what) const {
    bad_file(path_, what);
}

// Some writers leave the JSON unpadded, and the next chunk right behind it: where it names its kind, there it is.
void GltfData::split_container(std::string_view bytes) {
    std::string_view text = bytes;
    if (bytes.substr(0, 4) == "glTF") {
        if (bytes.size() < 20) fail("the file ends in its header; it is truncated");
        if (word_at(bytes, 4) != 2)
            fail(fmt::format("is glTF of version {}.0; version 2.0 is read, convert it first", word_at(bytes, 4)));
        if (word_at(bytes, 8) > bytes.size())
            fail(fmt::format("promises {} bytes, but the file has {}; it is truncated", word_at(bytes, 8),
                             bytes.size()));
        constexpr std::uint32_t bin = 0x004E4942; // "BIN"
        for (std::size_t at = 12; at + 8 <= bytes.size();) {
            const std::size_t size = word_at(bytes, at), kind = word_at(bytes, at + 4);
            if (size > bytes.size() - at - 8) fail("a chunk is longer than the file, which is truncated or damaged");
            if (at == 12) text = bytes.substr(at + 8, size);
            if (kind == bin && binary_.empty()) binary_ = bytes.substr(at + 8, size);
            at += 8 + size;
            if (at + 8 > bytes.size() || word_at(bytes, at + 4) != bin) at = (at + 3) / 4 * 4;
        }
    }
    if (const std::string_view trouble = json_trouble(text, false); !trouble.empty()) fail(trouble);
    try {
        root_ = json::parse(text.begin(), text.end());
    } catch (const json::parse_error& error) {
        fail(fmt::format("its JSON cannot be read beyond byte {}; the file is damaged or of another format",
                         error.byte));
    } catch (const json::exception&) {
        fail("its JSON holds a number that is too large; the file is damaged or of another format");
    }
}

// Version 1 keeps its lists as objects by name, and its asset may say nothing.
void GltfData::check_version() const {
    const json asset = root_.value("asset", json());
    const auto said = [&](const char* key) {
        const json value = asset.is_object() ? asset.value(key, json()) : json();
        return value.is_string() ? value.get<std::string>() : value.is_number() ? value.dump() : std::string();
    };
    const std::string version = said("version"), least = said("minVersion");
    const bool first = root_.contains("meshes") && root_["meshes"].is_object();
    const bool old = version.compare(0, 1, "0") == 0 || version.compare(0, 1, "1") == 0;
    if (first || old)
        fail(fmt::format("is glTF of version {}; version 2.0 is read, convert it first", old ? shown(version) : "1.0"));
    if (!asset.is_object()) fail("is no glTF file: it has no 'asset'");
    if ((!version.empty() && version.compare(0, 1, "2") != 0) || (!least.empty() && least != "2.0"))
        fail(fmt::format("is glTF of version {}; version 2.0 is read, convert it first",
                         shown(least.empty() ? version : least)));
}

// A buffer that cannot be had matters only where something asks for it: it may hold pictures alone.
void GltfData::load_buffers() {
    const std::size_t count = this->count("buffers");
    loaded_.resize(count);
    missing_.resize(count);
    std::map<std::filesystem::path, std::size_t> known; // files that several buffers name are read once
    for (std::size_t i = 0; i < count; ++i) {
        const json& buffer = item("buffers", i);
        if (!buffer.contains("uri")) {
            buffers_.push_back(i == 0 ? binary_ : std::string_view());
            continue;
        }
        if (!buffer["uri"].is_string()) fail(fmt::format("buffer {}: its uri is no text", i));
        const std::string uri = buffer["uri"].get<std::string>();
        if (uri.compare(0, 5, "data:") != 0) {
            const auto [first, fresh] = known.try_emplace(std::filesystem::path(uri).lexically_normal(), i);
            if (!fresh) {
                missing_[i] = missing_[first->second];
                buffers_.push_back(buffers_[first->second]);
                continue;
            }
        }
        try {
            loaded_[i] = load_uri(uri);
        } catch (const Error& error) {
            missing_[i] = error.what();
        }
        total_ += loaded_[i].size();
        buffers_.push_back(loaded_[i]);
    }
}

// Only files beside this one or below: a model from elsewhere must not read what it likes.
std::string GltfData::load_uri(const std::string& uri) const {
    if (uri.compare(0, 5, "data:") == 0) {
        if (uri.find(";base64,") == std::string::npos) fail("a data: uri is not in base64");
        return data_of_uri(uri);
    }
    const std::filesystem::path file = file_of_uri(path_, uri);
    if (file.empty())
        fail(fmt::format("names the buffer '{}', which lies outside its folder; put it beside", shown(uri)));
    return read_whole(file);
}

} // namespace meshtween
