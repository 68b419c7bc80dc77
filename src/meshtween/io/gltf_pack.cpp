// glTF 2.0 specification (Khronos, 2021): 4 the GLB container.
#include "meshtween/io/gltf_pack.h"

#include "meshtween/core/error.h"

#include <bit>
#include <limits>

namespace meshtween {

static_assert(std::endian::native == std::endian::little, "GLB is little-endian and written as the memory has it");
using nlohmann::json;

int append_view(Glb& glb, std::string_view bytes, int target) {
    glb.bin.resize((glb.bin.size() + 3) / 4 * 4, '\0');
    json view = {{"buffer", 0}, {"byteOffset", glb.bin.size()}, {"byteLength", bytes.size()}};
    if (target != gltf_no_target) view["target"] = target;
    glb.bin.append(bytes);
    glb.root["bufferViews"].push_back(std::move(view));
    return static_cast<int>(glb.root["bufferViews"].size()) - 1;
}

std::string packed(Glb glb) {
    glb.bin.resize((glb.bin.size() + 3) / 4 * 4, '\0');
    json& buffer = glb.root["buffers"];
    if (!buffer.is_array() || buffer.empty()) buffer = json::array({json::object()});
    buffer[0].erase("uri");
    buffer[0]["byteLength"] = glb.bin.size();
    std::string text = glb.root.dump(-1, ' ', false, json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t total = 12 + 8 + text.size() + 8 + glb.bin.size();
    if (total > std::numeric_limits<std::uint32_t>::max())
        throw Error(ErrorKind::argument, "the mesh does not fit into one GLB, which ends at 4 GiB");
    std::string result;
    result.reserve(total);
    const auto number = [&](std::size_t value) {
        const auto word = static_cast<std::uint32_t>(value);
        result.append(reinterpret_cast<const char*>(&word), sizeof word);
    };
    result += "glTF";
    number(2); // version
    number(total);
    number(text.size());
    result += "JSON";
    result += text;
    number(glb.bin.size());
    result.append("BIN\0", 4);
    result += glb.bin;
    return result;
}

std::string unpacked_json(const Glb& glb, const std::string& uri) {
    json root = glb.root;
    json& buffer = root["buffers"];
    if (!buffer.is_array() || buffer.empty()) buffer = json::array({json::object()});
    buffer[0]["uri"] = uri;
    buffer[0]["byteLength"] = glb.bin.size();
    return root.dump(2, ' ', false, json::error_handler_t::replace);
}

} // namespace meshtween
