#include "meshtween/io/mesh_io.h"

#include "meshtween/core/error.h"
#include "meshtween/io/formats.h"
#include "meshtween/io/gltf_write.h"
#include "meshtween/io/output.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string_view>

namespace meshtween {
namespace {
namespace fs = std::filesystem;

struct Format {
    std::string_view extension;
    PolygonMesh (*read)(std::string_view, const fs::path&);
    std::vector<std::string> (*write)(const Mesh&, const fs::path&, const WriteOptions&);
    FormatKeeps keeps;
};

constexpr FormatKeeps obj_keeps{.polygons = true,
                                .texcoords = true,
                                .colors = true,
                                .objects = true,
                                .groups = true,
                                .smoothing = true,
                                .materials = true,
                                .images = true};
constexpr FormatKeeps ply_keeps{.polygons = true, .texcoords = true, .colors = true, .images = true};
constexpr FormatKeeps off_keeps{.polygons = true, .colors = true};
constexpr FormatKeeps vtk_keeps{.polygons = true, .texcoords = true, .colors = true};
constexpr FormatKeeps usd_keeps{.polygons = true,
                                .texcoords = true,
                                .colors = true,
                                .objects = true,
                                .groups = true,
                                .materials = true,
                                .images = true};
constexpr FormatKeeps threemf_keeps{};
constexpr FormatKeeps gltf_keeps{
    .texcoords = true, .more_texcoords = true, .colors = true, .materials = true, .images = true};

constexpr std::array formats{
    Format{".obj", read_obj, write_obj, obj_keeps},    Format{".ply", read_ply, write_ply, ply_keeps},
    Format{".stl", read_stl, write_stl, {}},           Format{".off", read_off, write_off, off_keeps},
    Format{".glb", read_gltf, write_glb, gltf_keeps},  Format{".gltf", read_gltf, write_gltf, gltf_keeps},
    Format{".vtk", read_vtk, write_vtk, vtk_keeps},    Format{".vtp", read_vtp, write_vtp, vtk_keeps},
    Format{".usda", nullptr, write_usda, usd_keeps},   Format{".fbx", read_assimp, nullptr, vtk_keeps},
    Format{".dae", read_assimp, write_dae, vtk_keeps}, Format{".3mf", read_assimp, write_3mf, threemf_keeps},
};

std::string lower_extension(const fs::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

const Format* find_format(std::string_view extension) {
    const auto* found =
        std::find_if(formats.begin(), formats.end(), [&](const Format& f) { return f.extension == extension; });
    return found == formats.end() ? nullptr : found;
}

const Format& format_of(const fs::path& path, const std::vector<std::string>& choice) {
    const std::string extension = lower_extension(path);
    if (const Format* found = find_format(extension)) return *found;
    throw Error(ErrorKind::argument,
                fmt::format("{}: {} is no mesh format known here; use one of {}", path.string(),
                            extension.empty() ? "a name without an extension" : extension, fmt::join(choice, " ")));
}

PolygonMesh read_polygons(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) read_whole(path); // which says so
    const Format& format = format_of(path, readable_extensions());
    if (format.read == nullptr)
        throw Error(ErrorKind::argument, fmt::format("{}: {} is written but not read; save the model as .glb or .obj",
                                                     path.string(), format.extension));
    std::string bytes = read_whole(path);
    if (bytes.empty()) bad_file(path, "the file is empty; export the model again");
    PolygonMesh polygons = format.read(bytes, path);
    require_sound(polygons, path);
    polygons.file.path = path;
    polygons.file.format = format.extension;
    polygons.file.bytes = std::move(bytes);
    return polygons;
}

} // namespace

Mesh read_mesh(const fs::path& path) {
    PolygonMesh polygons = read_polygons(path);
    const Triangles cut = cut_polygons(polygons);
    return cut_mesh(std::move(polygons), cut);
}

std::vector<Mesh> read_meshes(const std::vector<fs::path>& paths) {
    std::vector<Mesh> meshes;
    for (const fs::path& path : paths) {
        PolygonMesh polygons = read_polygons(path);
        std::optional<Triangles> alike;
        if (!meshes.empty()) alike = cut_like(polygons, meshes.front().triangles);
        const Triangles cut = alike ? *alike : cut_polygons(polygons);
        meshes.push_back(cut_mesh(std::move(polygons), cut));
    }
    return meshes;
}

void check_writable(const fs::path& path) {
    const Format& format = format_of(path, mesh_extensions());
    if (format.write == nullptr)
        throw Error(ErrorKind::argument,
                    fmt::format("{}: {} is read but not written; write .glb or .obj", path.string(), format.extension));
    if (format.read == read_assimp) require_assimp(path);
}

std::vector<std::string> write_mesh(const Mesh& mesh, const fs::path& path, const WriteOptions& options) {
    check_writable(path);
    std::vector<std::string> notes = format_of(path, mesh_extensions()).write(mesh, path, options);
    for (std::string& note : left_behind(mesh, path)) notes.push_back(std::move(note));
    return notes;
}

std::vector<std::string> left_behind(const Mesh& mesh, const fs::path& path, bool of_morph) {
    const std::string extension = lower_extension(path);
    const bool gltf = extension == ".glb" || extension == ".gltf"; // one format in two wrappings
    if (!of_morph && (is_rewritable(mesh, extension) || (gltf && is_own_gltf(mesh)))) return {};
    std::vector<std::string> notes;
    if (of_morph && extension != ".usda")
        for (const std::string& note : mesh_glb_notes(mesh))
            notes.push_back(fmt::format("{}: {}", path.string(), note));
    const Format* format = find_format(extension == ".html" ? ".glb" : extension);
    if (format == nullptr) return notes;
    const std::vector<std::string> lost = not_kept(mesh, format->keeps);
    if (lost.empty()) return notes;
    const Format* own = mesh.file ? find_format(mesh.file->format) : nullptr;
    const bool helps = own != nullptr && own->write != nullptr && own != format;
    notes.push_back(fmt::format("{}: left behind {}{}", path.string(), listed(lost),
                                helps ? fmt::format("; write {} to keep them", own->extension) : ""));
    return notes;
}

std::vector<std::string> readable_extensions() {
    std::vector<std::string> names;
    for (const Format& format : formats)
        if (format.read != nullptr) names.emplace_back(format.extension);
    return names;
}

const std::vector<std::string>& mesh_extensions() {
    static const std::vector<std::string> extensions = [] {
        std::vector<std::string> names;
        for (const Format& format : formats) names.emplace_back(format.extension);
        return names;
    }();
    return extensions;
}

void normalise_colors(std::vector<float>& colors) {
    const bool bytes = std::any_of(colors.begin(), colors.end(), [](float c) { return c > 2; });
    for (std::size_t i = 0; i < colors.size(); ++i) {
        float& color = colors[i];
        if (bytes && (i % 4 != 3 || color > 1)) color /= 255; // an alpha that was not given is 1 already
        color = color >= 0 ? std::min(color, 1.0F) : 0;       // and what is no number is 0
    }
}

} // namespace meshtween
