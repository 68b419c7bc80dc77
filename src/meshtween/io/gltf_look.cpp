// glTF 2.0 specification (Khronos, 2021): 3.8 texture data, 3.9 materials.
#include "meshtween/io/gltf_look.h"

#include "meshtween/core/error.h"
#include "meshtween/io/gltf_data.h"
#include "meshtween/io/image.h"
#include "meshtween/io/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace meshtween {
namespace {

using nlohmann::json;

// One white pixel: stands for a picture that is not there.
constexpr std::array<unsigned char, 69> white_pixel{
    0x89, 'P',  'N',  'G', 13,  10, 26,   10,   0,    0,    0,    13,   'I',  'H',  'D',  'R', 0,    0,
    0,    1,    0,    0,   0,   1,  8,    2,    0,    0,    0,    0x90, 0x77, 0x53, 0xde, 0,   0,    0,
    12,   'I',  'D',  'A', 'T', 8,  0xd7, 0x63, 0xf8, 0xff, 0xff, 0x3f, 0,    5,    0xfe, 2,   0xfe, 0xa7,
    0x35, 0x81, 0x84, 0,   0,   0,  0,    'I',  'E',  'N',  'D',  0xae, 0x42, 0x60, 0x82};

// The bytes of a picture, or a sentence that says why there are none.
struct Found {
    std::string bytes, trouble;
};

Found found_picture(const TextureImage& picture) {
    const std::string name = picture.path.empty() ? picture.name : picture.path.string();
    Found found{picture.bytes, {}};
    if (found.bytes.empty() && !picture.path.empty()) {
        try {
            found.bytes = read_whole(picture.path);
        } catch (const Error& error) {
            return {{}, fmt::format("the texture is left white: {}", error.what())};
        }
    }
    if (!picture_mime(found.bytes).empty()) return found;
    try {
        return {png_bytes(decoded_image(found.bytes, name)), {}}; // a BMP or TGA
    } catch (const Error&) {
        return {{}, fmt::format("the texture '{}' is left white: it is no PNG, JPEG, WebP, BMP or TGA", name)};
    }
}

std::vector<std::string> append_pictures(Glb& glb, const std::vector<TextureImage>& pictures) {
    std::vector<std::string> notes;
    for (const TextureImage& picture : pictures) {
        Found found = found_picture(picture);
        if (!found.trouble.empty()) {
            notes.push_back(found.trouble);
            found.bytes.assign(reinterpret_cast<const char*>(white_pixel.data()), white_pixel.size());
        }
        json image = {{"mimeType", picture_mime(found.bytes)}};
        if (!picture.name.empty()) image["name"] = picture.name;
        image["bufferView"] = append_view(glb, found.bytes);
        glb.root["images"].push_back(std::move(image));
    }
    return notes;
}

void collect_extensions(const json& value, std::set<std::string>& names) {
    if (value.is_object())
        for (const auto& [key, inner] : value.items()) {
            if (key == "extensions" && inner.is_object())
                for (const auto& [name, ignored] : inner.items()) names.insert(name);
            collect_extensions(inner, names);
        }
    if (value.is_array())
        for (const json& inner : value) collect_extensions(inner, names);
}

// A texture whose picture only an extension names: that picture, which is white where it cannot be shown.
void settle_textures(json& textures, const std::vector<TextureImage>& pictures) {
    for (json& texture : textures) {
        if (!texture.contains("extensions")) continue;
        json& extensions = texture["extensions"];
        for (auto at = extensions.begin(); at != extensions.end();) {
            const json source = at->is_object() ? at->value("source", json()) : json();
            const bool shown = source.is_number_unsigned() && source.get<std::size_t>() < pictures.size() &&
                               !found_picture(pictures[source.get<std::size_t>()]).bytes.empty();
            if (source.is_number_unsigned() && !shown) {
                if (!texture.contains("source")) texture["source"] = source;
                at = extensions.erase(at);
            } else {
                ++at;
            }
        }
        if (extensions.empty()) texture.erase("extensions");
    }
}

void append_gltf_materials(Glb& glb, const MeshFile& file) {
    const GltfData data(file.bytes, file.path);
    std::set<std::string> names;
    for (const char* list : {"materials", "textures", "samplers"}) {
        if (data.count(list) == 0) continue;
        glb.root[list] = data.root()[list];
        if (std::string_view(list) == "textures") settle_textures(glb.root[list], file.images);
        collect_extensions(glb.root[list], names);
    }
    if (names.empty()) return;
    glb.root["extensionsUsed"] = names;
    const json required = data.root().value("extensionsRequired", json::array());
    for (const json& name : required)
        if (name.is_string() && names.count(name.get<std::string>()) > 0)
            glb.root["extensionsRequired"].push_back(name);
}

// Takes out what names a texture and coordinates that are not there: "normalTexture": {"index": 0, "texCoord": 1}.
void drop_unplaced_textures(json& value, std::size_t texcoord_sets) {
    if (!value.is_object()) return;
    for (auto at = value.begin(); at != value.end();) {
        const bool texture = at->is_object() && at->contains("index") && at.key().ends_with("Texture");
        const json set = texture ? at->value("texCoord", json(0)) : json();
        if (texture && !(set.is_number_integer() && set.get<std::size_t>() < texcoord_sets)) {
            at = value.erase(at);
        } else {
            drop_unplaced_textures(*at, texcoord_sets);
            ++at;
        }
    }
}

json material_json(const Material& material) {
    json surface = {{"metallicFactor", material.metallic}, {"roughnessFactor", material.roughness}};
    if (material.base_color != std::array<float, 4>{1, 1, 1, 1}) surface["baseColorFactor"] = material.base_color;
    if (material.base_color_image >= 0) surface["baseColorTexture"] = {{"index", material.base_color_image}};
    json result = {{"pbrMetallicRoughness", surface}};
    if (!material.name.empty()) result["name"] = material.name;
    if (material.double_sided) result["doubleSided"] = true;
    if (material.base_color[3] < 1) result["alphaMode"] = "BLEND";
    return result;
}

} // namespace

std::string picture_mime(std::string_view bytes) {
    if (bytes.substr(0, 4) == "\x89PNG") return "image/png";
    if (bytes.substr(0, 3) == "\xff\xd8\xff") return "image/jpeg";
    if (bytes.substr(0, 4) == "RIFF" && bytes.size() > 12 && bytes.substr(8, 4) == "WEBP") return "image/webp";
    return {};
}

std::vector<std::string> append_materials(Glb& glb, const MeshFile* file, bool plain, bool colors,
                                          std::size_t texcoord_sets) {
    std::vector<std::string> notes;
    if (file != nullptr && !file->materials.empty()) {
        notes = append_pictures(glb, file->images);
        if (file->format == ".glb" || file->format == ".gltf") {
            append_gltf_materials(glb, *file);
        } else {
            for (const Material& material : file->materials) glb.root["materials"].push_back(material_json(material));
            for (std::size_t i = 0; i < file->images.size(); ++i)
                glb.root["textures"].push_back({{"source", i}}); // one a picture, of the same number
        }
    }
    if (glb.root.contains("materials"))
        for (json& material : glb.root["materials"]) drop_unplaced_textures(material, texcoord_sets);
    if (!plain && glb.root.contains("materials")) return notes;
    const std::array<double, 4> base =
        colors ? std::array{1.0, 1.0, 1.0, 1.0} : std::array{0.70, 0.625, 0.555, 1.0}; // clay
    glb.root["materials"].push_back(
        {{"name", "surface"},
         {"doubleSided", true},
         {"pbrMetallicRoughness", {{"baseColorFactor", base}, {"metallicFactor", 0}, {"roughnessFactor", 0.6}}}});
    return notes;
}

} // namespace meshtween
