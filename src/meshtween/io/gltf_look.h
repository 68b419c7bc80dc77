// Materials and pictures of a mesh's file as glTF has them.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/io/gltf_pack.h"
#include "meshtween/io/mesh_file.h"

#include <string>
#include <vector>

namespace meshtween {

// The kind of a picture by its first bytes: "image/png", "image/jpeg", "image/webp"; empty for any other.
std::string picture_mime(std::string_view bytes);

// Adds the file's materials, with the pictures inside the buffer. Those of a glTF file come whole: all their textures
// and extensions. Where the file has none, or `plain` asks, one more is added behind them: clay, or white under vertex
// colours. Textures that need other than the first `texcoord_sets` sets of coordinates are left out. Returns what could
// not be had, sentences.
std::vector<std::string> append_materials(Glb& glb, const MeshFile* file, bool plain, bool colors,
                                          std::size_t texcoord_sets);

} // namespace meshtween
