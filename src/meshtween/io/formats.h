// One reader and one writer a format, behind mesh_io.h. Readers throw Error(file) naming `path` and line or element.
#pragma once

#include "meshtween/io/mesh_io.h"
#include "meshtween/io/polygons.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace meshtween {

PolygonMesh read_obj(std::string_view bytes, const std::filesystem::path& path);
PolygonMesh read_ply(std::string_view bytes, const std::filesystem::path& path);
PolygonMesh read_stl(std::string_view bytes, const std::filesystem::path& path);
PolygonMesh read_off(std::string_view bytes, const std::filesystem::path& path);
PolygonMesh read_gltf(std::string_view bytes, const std::filesystem::path& path);
PolygonMesh read_vtk(std::string_view bytes, const std::filesystem::path& path);
PolygonMesh read_vtp(std::string_view bytes, const std::filesystem::path& path);
// FBX, Collada and 3MF; where the program was built without assimp, an error that says so.
PolygonMesh read_assimp(std::string_view bytes, const std::filesystem::path& path);

// Each writes `path` through write_whole and returns sentences for people: what became of pictures beside it, what was
// decided. What the format cannot hold is told by its FormatKeeps. Where is_rewritable, the mesh's own file comes back
// with other positions.
std::vector<std::string> write_obj(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions& options);
std::vector<std::string> write_ply(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions& options);
std::vector<std::string> write_stl(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions& options);
std::vector<std::string> write_off(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions& options);
std::vector<std::string> write_vtk(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions& options);
std::vector<std::string> write_vtp(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions& options);
std::vector<std::string> write_usda(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions& options);
std::vector<std::string> write_dae(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions& options);
std::vector<std::string> write_3mf(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions& options);
std::vector<std::string> write_glb(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions& options);
std::vector<std::string> write_gltf(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions& options);

// Whether a glTF can be written as the mesh's own file with other positions, be that .glb or .gltf.
bool is_own_gltf(const Mesh& mesh);

// What a format can hold besides positions and triangles, as our writer writes it.
struct FormatKeeps {
    bool polygons = false, texcoords = false, more_texcoords = false, colors = false;
    bool objects = false, groups = false, smoothing = false, materials = false, images = false;
};

// What the mesh and its file have and the format has not: "12 groups", "vertex colours".
std::vector<std::string> not_kept(const Mesh& mesh, const FormatKeeps& keeps);

// Throws Error(argument) where the program was built without assimp.
void require_assimp(const std::filesystem::path& path);

// Colours that some writer gave in 0..255 come down to 0..1.
void normalise_colors(std::vector<float>& colors);

} // namespace meshtween
