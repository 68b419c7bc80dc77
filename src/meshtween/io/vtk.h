// What the two formats of VTK share: cells as polygons, and what arrays of point data mean.
#pragma once

#include "meshtween/io/polygons.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meshtween {

enum class VtkType { unknown, bit, int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64, text };

std::size_t size_of(VtkType type); // bytes of a number; 0 where numbers have no size of their own
bool is_float(VtkType type);

// Values as they lie in memory here (little-endian) to doubles, and back.
double number_at(const char* bytes, VtkType type);
void append_number(std::string& bytes, double value, VtkType type);

// The numbers of VTK's cell types that can be met here.
enum VtkCellType { vtk_triangle = 5, vtk_strip = 6, vtk_polygon = 7 };

// The polygons of a surface and what was passed over on the way.
struct VtkSurface {
    PolygonMesh mesh;
    std::filesystem::path path;
    std::uint64_t strips = 0, loose = 0, short_faces = 0; // loose: vertices and lines

    // Adds a cell. Corners count from 0, `base` is added to them. Throws Error(file) for a cell of a volume.
    void add(int type, std::span<const std::int64_t> cell, std::int64_t base = 0);

    // Notes on what add passed over or took apart.
    void tell();

private:
    void add_polygon(std::span<const std::int64_t> cell, std::int64_t base);
};

// What a point's array is to a mesh. `attribute` is what the file says that it is: "SCALARS", "TCOORDS", "NORMALS".
enum class VtkRole { none, colors, texcoords, normals };
VtkRole vtk_role(std::string_view name, std::string_view attribute, VtkType type, int components);

// An array of point data, in the order of points. What it is not used for is named in the file's only_here.
struct VtkArray {
    std::string name, attribute;
    VtkType type = VtkType::unknown;
    int components = 1;
    std::vector<double> values;
};
void take_point_arrays(VtkSurface& surface, std::vector<VtkArray>&& arrays);

// Normals for the mesh's shape, as file_normals; they point inwards where the file's did. `read` is the mesh as it was.
Points renewed_normals(const Mesh& read, const Mesh& mesh);

// One row of texture coordinates a vertex; none where some vertex has two, on a seam.
Texcoords texcoords_of_vertices(const Mesh& mesh);

// A sentence where texture coordinates have seams, which neither format can hold without more vertices.
std::vector<std::string> seams_left_behind(const Mesh& mesh, const std::filesystem::path& path);

} // namespace meshtween
