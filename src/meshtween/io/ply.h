// The header of a PLY file.
#pragma once

#include "meshtween/io/polygons.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace meshtween {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t size_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    bool is_list = false;
    PlyType count_type = PlyType::uint8; // of a list's length
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

enum class PlyEncoding { ascii, little_endian, big_endian };

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    std::vector<std::string> textures; // of comments "TextureFile", as MeshLab writes them
    std::size_t size = 0;              // bytes, to where the data begin
    long lines = 0;                    // of the header
};

// Throws Error(file), naming the line; also where the counts promise more than the file can hold.
PlyHeader read_ply_header(std::string_view bytes, const std::filesystem::path& path);

// Where in the bytes the numbers stand that a new shape changes. Null where a vertex or a face has none.
struct PlyPlaces {
    std::vector<const char*> positions;    // x y z a vertex
    std::vector<const char*> normals;      // nx ny nz a vertex; or empty
    std::vector<const char*> face_normals; // nx ny nz a polygon that is part of the surface; or empty
};

// The body of the file; notes where its numbers stand where `places` is given. Throws Error(file).
PolygonMesh read_ply_body(std::string_view bytes, const std::filesystem::path& path, const PlyHeader& header,
                          PlyPlaces* places = nullptr);

struct Move;

// Whether its vertices have coordinates of a whole-number type, which cannot hold another shape.
bool has_whole_coordinates(const PlyHeader& header);

// The mesh's file with its positions. The mesh is_rewritable as PLY.
void rewrite_ply(const Mesh& mesh, const PlyHeader& header, const Move& move, std::ostream& stream);

} // namespace meshtween
