// glTF 2.0 specification, 3.12: what a file requires must be understood. Most extensions speak of looks, sounds or
// ownership and change no vertex: those are passed over. What is not known to be harmless is refused by name.
#include "meshtween/io/gltf_data.h"

#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace meshtween {
namespace {

// Whole names and, with a star, beginnings of names after the vendor's prefix.
constexpr std::array<std::string_view, 27> harmless{
    "KHR_mesh_quantization", // read as any accessor
    "KHR_draco_mesh_compression",
    "EXT_meshopt_compression",
    "KHR_meshopt_compression",
    "EXT_mesh_gpu_instancing",
    "KHR_techniques_webgl",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "KHR_animation_pointer",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_interactivity",
    "EXT_mesh_features",
    "EXT_instance_features",
    "EXT_structural_metadata",
    "EXT_feature_metadata",
    "CESIUM_primitive_outline",
    "VRM",
    "GODOT_single_root",
    "*materials_",
    "*texture_",
    "*lights_",
    "*audio",
    "*physics",
    "*stk_metadata",
    "*articulations",
    "*packing_", // of channels into textures, where the vendor is Microsoft
};

bool is_harmless(std::string_view name) {
    if (name.substr(0, 5) == "VRMC_") return true;
    const std::size_t bar = name.find('_');
    const std::string_view vendor = name.substr(0, bar), rest = bar == name.npos ? "" : name.substr(bar + 1);
    return std::any_of(harmless.begin(), harmless.end(), [&](std::string_view known) {
        if (known[0] != '*') return name == known;
        if (known == "*packing_" && vendor != "MSFT") return false;
        return rest.substr(0, known.size() - 1) == known.substr(1);
    });
}

} // namespace

void require_known_extensions(const GltfData& data) {
    const auto required = data.root().find("extensionsRequired");
    if (required == data.root().end() || !required->is_array()) return;
    for (const auto& name : *required) {
        if (!name.is_string()) data.fail("extensionsRequired holds something that is no name; the file is damaged");
        const std::string known = name.get<std::string>();
        if (!is_harmless(known))
            data.fail(fmt::format("needs the extension {}, which is not known here and may change its shape; export "
                                  "it without",
                                  shown(known)));
    }
}

} // namespace meshtween
