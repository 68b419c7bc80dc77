// .glb and .gltf on the disk: the mesh's own file with new positions where it was one, else a file made from the mesh.
#include "meshtween/core/error.h"
#include "meshtween/io/companions.h"
#include "meshtween/io/formats.h"
#include "meshtween/io/gltf_build.h"
#include "meshtween/io/gltf_data.h"
#include "meshtween/io/gltf_look.h"
#include "meshtween/io/gltf_rewrite.h"
#include "meshtween/io/output.h"

#include <fmt/format.h>

#include <cctype>

namespace meshtween {
namespace {
namespace fs = std::filesystem;

using nlohmann::json;

struct GltfFile {
    GltfRewrite file;
    bool own = false; // the mesh's own file with new positions
};

GltfFile file_of(const Mesh& mesh) {
    std::string why;
    if (is_own_gltf(mesh)) try {
            return {rewritten_gltf(mesh), true};
        } catch (const Error& error) { // parts that the shape did not need
            why = error.what();
        } catch (const json::exception&) {
            why = "parts of the template's file are damaged";
        }
    GltfFile result{{mesh_gltf(mesh, {}, "mesh"), mesh_glb_notes(mesh)}, false};
    if (!why.empty())
        result.file.notes.push_back(fmt::format(
            "it is written anew, without the template's nodes, skins, morph targets and animations: {}", why));
    return result;
}

// The file that an image of the JSON names beside the mesh's own; empty where it is inside.
fs::path picture_beside(const Mesh& mesh, const json& image) {
    if (!mesh.file || !image.contains("uri") || !image["uri"].is_string()) return {};
    return file_of_uri(mesh.file->path, image["uri"].get<std::string>());
}

// A name as a uri has it, by bytes: letters, digits and a few signs stay.
std::string as_uri(const std::string& name) {
    std::string result;
    for (const char c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) != 0 || std::string_view("-_.~/").find(c) != std::string::npos)
            result += c;
        else
            result += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    return result;
}

// Pictures beside the mesh's file go into the GLB.
void embed_pictures(const Mesh& mesh, GltfRewrite& file) {
    if (!file.glb.root.contains("images")) return;
    for (json& image : file.glb.root["images"]) {
        const fs::path picture = picture_beside(mesh, image);
        if (picture.empty()) continue;
        std::string bytes;
        try {
            bytes = read_whole(picture);
        } catch (const Error& error) {
            file.notes.push_back(fmt::format("a texture is missing: {}", error.what()));
            continue;
        }
        const std::string mime = picture_mime(bytes);
        if (mime.empty()) continue;
        if (!image.contains("name")) image["name"] = picture.stem().string();
        image.erase("uri");
        image["mimeType"] = mime;
        image["bufferView"] = append_view(file.glb, bytes);
    }
}

// Pictures beside the mesh's file are found from where the new one lies.
void place_pictures(const Mesh& mesh, const fs::path& path, Textures textures, GltfRewrite& file) {
    if (!file.glb.root.contains("images")) return;
    const fs::path folder = fs::absolute(path).parent_path();
    for (json& image : file.glb.root["images"]) {
        const fs::path picture = picture_beside(mesh, image);
        std::error_code error;
        if (picture.empty() || fs::equivalent(fs::absolute(picture).parent_path(), folder, error)) continue;
        if (textures == Textures::refer) {
            image["uri"] = as_uri(fs::proximate(fs::absolute(picture), folder).generic_string());
            continue;
        }
        image["uri"] = as_uri(picture.filename().string());
        try {
            image["uri"] = as_uri(place_beside(folder, picture.filename().string(), read_whole(picture)));
        } catch (const Error& missing) {
            file.notes.push_back(fmt::format("a texture could not be copied beside it: {}", missing.what()));
        }
    }
}

std::vector<std::string> told(const fs::path& path, std::vector<std::string> notes) {
    for (std::string& note : notes) note = fmt::format("{}: {}", path.string(), note);
    return notes;
}

} // namespace

bool is_own_gltf(const Mesh& mesh) {
    return is_rewritable(mesh, ".glb") || is_rewritable(mesh, ".gltf");
}

std::vector<std::string> write_glb(const Mesh& mesh, const fs::path& path, const WriteOptions&) {
    auto [file, own] = file_of(mesh);
    if (own) embed_pictures(mesh, file);
    write_whole(path, packed(std::move(file.glb)));
    return told(path, std::move(file.notes));
}

std::vector<std::string> write_gltf(const Mesh& mesh, const fs::path& path, const WriteOptions& options) {
    auto [file, own] = file_of(mesh);
    if (own) place_pictures(mesh, path, options.textures, file);
    const fs::path bin = fs::path(path).replace_extension(".bin");
    file.glb.bin.resize((file.glb.bin.size() + 3) / 4 * 4, '\0');
    write_whole(bin, file.glb.bin);
    write_whole(path, unpacked_json(file.glb, as_uri(bin.filename().string())));
    return told(path, std::move(file.notes));
}

} // namespace meshtween
