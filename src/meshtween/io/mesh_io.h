// Meshes from and to files; the format is the name's extension: .obj .ply .stl .off .glb .gltf
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

// Reads meshes that are meant to have one connectivity. A file whose polygons are those of the first is cut into
// triangles as the first is, so that a mesh of quads in two poses stays one mesh. Throws as read_mesh.
std::vector<Mesh> read_meshes(const std::vector<std::filesystem::path>& paths);

// Writes beside `path`, then renames: a failure leaves nothing half-written. Doubles in text keep all their digits; STL
// and GLB hold floats. UVs go to .obj .ply .glb, colours to .obj .ply .off .glb. Throws Error(argument) for an unknown
// extension (and .gltf, which is only read), Error(file) where writing fails.
void write_mesh(const Mesh& mesh, const std::filesystem::path& path);

// The extensions that read_mesh and write_mesh know, with the dot, in lower case.
const std::vector<std::string>& mesh_extensions();

} // namespace meshtween
