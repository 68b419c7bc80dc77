// Meshes from and to files; the format is the name's extension: .obj .ply .stl .off .glb .vtk .vtp, and
// .dae .3mf where assimp was found; .gltf and .fbx are only read, .usda is only written.
#pragma once

#include "meshtween/core/mesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace meshtween {

// Reads a mesh. Polygons become triangles; vertex order and count are the file's (STL, which has none, is welded at
// equal coordinates). Throws Error(file), naming file, line or element and remedy: not there, a folder, empty,
// truncated, garbage, a coordinate that is not finite, an index out of range, a header that promises more than the file
// can hold, no faces.
Mesh read_mesh(const std::filesystem::path& path);

// Reads meshes that are meant to have one connectivity. A file whose polygons can be cut into the triangles of the
// first is cut so: a mesh of quads in two poses stays one mesh, and so it does beside its own triangles. Throws as
// read_mesh.
std::vector<Mesh> read_meshes(const std::vector<std::filesystem::path>& paths);

// Where a picture or a material library that the mesh's file names lies in another folder than the written file.
enum class Textures {
    copy,  // it is copied beside the written file, so that the folder can be passed on
    refer, // the written file names it where it is
};

struct WriteOptions {
    Textures textures = Textures::copy;
};

// A mesh that read_mesh gave is written to its own format as its file was: other positions and normals, all else the
// same. To another format goes what that can hold. Returns what was left behind and what else people should know, a
// sentence each that begins with the file's name.
// Writes beside `path`, then renames: a failure leaves nothing half-written. Doubles in text keep all their digits; STL
// and GLB hold floats. A .gltf comes with a .bin of its name beside it. Throws Error(argument) as check_writable,
// Error(file) where writing fails.
std::vector<std::string> write_mesh(const Mesh& mesh, const std::filesystem::path& path,
                                    const WriteOptions& options = {});

// What write_mesh would leave behind there, as a sentence; none where nothing is. Also for .glb and .html of a morph.
std::vector<std::string> left_behind(const Mesh& mesh, const std::filesystem::path& path, bool of_morph = false);

// Throws Error(argument) where write_mesh would not know how: so that nobody waits for a fit to hear it.
void check_writable(const std::filesystem::path& path);

// The extensions that read_mesh and write_mesh know, with the dot, in lower case.
const std::vector<std::string>& mesh_extensions();
std::vector<std::string> readable_extensions(); // those of them that read_mesh knows

} // namespace meshtween
