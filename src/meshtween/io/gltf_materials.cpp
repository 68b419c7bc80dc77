// glTF 2.0 specification (Khronos, 2021): 3.8 texture data, 3.9 materials.
#include "meshtween/io/gltf_materials.h"

#include "meshtween/core/error.h"

#include <fmt/format.h>

#include <array>

namespace meshtween {
namespace {

using nlohmann::json;

std::string text_of(const json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

float number_of(const json& object, const char* key, float otherwise) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? found->get<float>() : otherwise;
}

TextureImage picture_of(const GltfData& data, std::size_t index) {
    const json& image = data.item("images", index);
    TextureImage picture;
    picture.name = text_of(image, "name");
    picture.mime = text_of(image, "mimeType");
    if (image.contains("bufferView")) picture.bytes = data.view_bytes(data.number(image, "bufferView"));
    const std::string uri = text_of(image, "uri");
    if (uri.compare(0, 5, "data:") == 0) {
        picture.bytes = data_of_uri(uri);
        if (picture.mime.empty()) picture.mime = uri.substr(5, uri.find(';') - 5);
    } else if (!uri.empty()) {
        picture.path = file_of_uri(data.path(), uri);
        if (picture.name.empty()) picture.name = picture.path.stem().string();
    }
    return picture;
}

// A texture's picture: its own, or the one that an extension for another kind of picture names.
int image_of_texture(const GltfData& data, std::size_t index) {
    const json& texture = data.item("textures", index);
    std::size_t source = data.number(texture, "source", data.count("images"));
    if (const auto extensions = texture.find("extensions"); extensions != texture.end())
        for (const auto& [name, extension] : extensions->items())
            if (source == data.count("images")) source = data.number(extension, "source", source);
    return source < data.count("images") ? static_cast<int>(source) : -1;
}

Material material_of(const GltfData& data, const json& found) {
    Material material;
    material.name = text_of(found, "name");
    material.double_sided = found.value("doubleSided", json(false)) == true;
    const json surface = found.value("pbrMetallicRoughness", json::object());
    material.metallic = number_of(surface, "metallicFactor", 1);
    material.roughness = number_of(surface, "roughnessFactor", 1);
    const std::vector<double> factor = data.reals(surface, "baseColorFactor");
    for (std::size_t c = 0; c < 4 && factor.size() == 4; ++c) material.base_color[c] = static_cast<float>(factor[c]);
    const json texture = surface.value("baseColorTexture", json());
    if (texture.is_object()) material.base_color_image = image_of_texture(data, data.number(texture, "index"));
    return material;
}

} // namespace

void read_gltf_materials(const GltfData& data, MeshFile& file) {
    std::size_t damaged = 0;
    const auto guarded = [&](const auto& read) {
        try {
            read();
        } catch (const Error&) {
            ++damaged;
        } catch (const json::exception&) {
            ++damaged;
        }
    };
    file.images.resize(data.count("images"));
    std::size_t bytes = 0; // of all pictures; a small file can name the same any number of times
    for (std::size_t i = 0; i < file.images.size(); ++i)
        guarded([&] {
            if (bytes > 16 * data.size()) data.fail("has too many pictures");
            file.images[i] = picture_of(data, i);
            bytes += file.images[i].bytes.size();
        });
    file.materials.resize(data.count("materials"));
    for (std::size_t i = 0; i < file.materials.size(); ++i)
        guarded([&] { file.materials[i] = material_of(data, data.item("materials", i)); });
    if (damaged > 0)
        file.notes.push_back(fmt::format("{} of its materials or pictures are damaged: left out", damaged));
}

} // namespace meshtween
