// One reader and one writer a format, behind mesh_io.h. Readers throw Error(file) naming `path` and line or element.
#pragma once

#include "meshtween/io/polygons.h"

#include <filesystem>
#include <ostream>
#include <string_view>

namespace meshtween {

PolygonMesh read_obj(std::string_view bytes, const std::filesystem::path& path);
PolygonMesh read_ply(std::string_view bytes, const std::filesystem::path& path);
PolygonMesh read_stl(std::string_view bytes, const std::filesystem::path& path);
PolygonMesh read_off(std::string_view bytes, const std::filesystem::path& path);
PolygonMesh read_gltf(std::string_view bytes, const std::filesystem::path& path);

void write_obj(const Mesh& mesh, std::ostream& stream);
void write_ply(const Mesh& mesh, std::ostream& stream);
void write_stl(const Mesh& mesh, std::ostream& stream);
void write_off(const Mesh& mesh, std::ostream& stream);

// Colours that some writer gave in 0..255 come down to 0..1.
void normalise_colors(std::vector<float>& colors);

} // namespace meshtween
