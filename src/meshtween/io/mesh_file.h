// What a mesh's file holds beside the shape. It travels with the mesh from reading to writing, so that people get their
// polygons, groups, materials and all else back.
#pragma once

#include "meshtween/core/mesh.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace meshtween {

// A picture: its bytes where the mesh's file holds it, else the file where it lies.
struct TextureImage {
    std::string name;
    std::string mime;  // "image/png", "image/jpeg"; empty where it is not known
    std::string bytes; // encoded; empty where the picture is a file of its own
    std::filesystem::path path;
};

struct Material {
    std::string name;
    std::array<float, 4> base_color{1, 1, 1, 1}; // linear RGBA, multiplies the texture
    float metallic = 0;
    float roughness = 0.6F;
    bool double_sided = true;
    int base_color_image = -1; // of MeshFile::images; -1: none
};

// One name for each polygon: names[of[polygon]], or none where of[polygon] is -1. Both are empty where the file has
// none.
struct PolygonNames {
    std::vector<std::string> names;
    std::vector<int> of;
};

// A further set of texture coordinates; the first set is the mesh's own.
struct TexcoordSet {
    std::string name;
    Texcoords texcoords;
    std::vector<int> corners; // beside MeshFile::corners: a row of texcoords, or -1
};

// Indices are those of the mesh's vertices; a corner is a place in `corners`.
struct MeshFile {
    std::filesystem::path path;
    std::string format; // the extension in lower case: ".obj"
    std::string bytes;  // the file, for writing the same format again

    std::vector<int> corners; // vertices, polygon after polygon
    std::vector<int> ends;    // a polygon: where its corners end
    Triangles cut;            // beside the mesh's triangles: their corners
    Eigen::Index vertices = 0;
    std::uint64_t attributes = 0; // attributes_key of the mesh as it was read
    std::uint64_t shape = 0;      // shape_key of it

    Points normals;                  // as the file had them, unit length or not
    std::vector<int> normal_corners; // beside corners: a row of normals, or -1; empty with normals
    std::vector<TexcoordSet> more_texcoords;

    PolygonNames objects, groups, smoothing; // smoothing: "1", "off"
    std::vector<Material> materials;
    std::vector<int> polygon_materials; // a polygon: its material, or -1; empty where the file has none
    std::vector<TextureImage> images;
    std::vector<std::string> material_libraries; // OBJ's mtllib, as written

    // What no other format holds, each as a sentence names it: "the property 'quality'", "2 animations".
    std::vector<std::string> only_here;

    std::vector<std::string> notes; // what was passed over, counted or decided while reading; sentences for people
};

// The polygon of each of the mesh's triangles. m numbers.
std::vector<int> polygon_of_triangles(const MeshFile& file);

// A number that tells texture coordinates and colours from others.
std::uint64_t attributes_key(const Mesh& mesh);
// A number that tells positions from others.
std::uint64_t shape_key(const Mesh& mesh);

// Whether the mesh's file describes it still: vertices and triangles are those that were read. False without a file.
bool is_described(const Mesh& mesh);

// Whether a file of this format ("a lower-case extension") can be written as the mesh's own file with other positions:
// it is of that format and describes the mesh, and texture coordinates and colours are those that were read.
bool is_rewritable(const Mesh& mesh, std::string_view format);

// Polygons to write: those of the mesh's file where it describes the mesh, else the triangles.
struct WrittenPolygons {
    std::vector<int> corners, ends;    // as in MeshFile
    std::vector<int> texcoord_corners; // beside corners: a row of the mesh's texture coordinates; or empty
    Points normals;                    // for the shape as it is; empty where the file has none
    std::vector<int> normal_corners;   // beside corners: a row of normals, or -1; or empty

    int begin(std::size_t polygon) const { return polygon == 0 ? 0 : ends[polygon - 1]; }
};
WrittenPolygons written_polygons(const Mesh& mesh);

} // namespace meshtween
