// VTK File Formats, in "The VTK User's Guide", 11th edition, Kitware 2010; cell types after vtkCellType.h.
#include "meshtween/io/vtk.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/io/file_normals.h"
#include "meshtween/io/formats.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>

namespace meshtween {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are taken as memory has them");

template <typename Number>
double number_as(const char* bytes) {
    Number value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

template <typename Number>
void append_as(std::string& bytes, double value) {
    if constexpr (std::is_integral_v<Number>)
        value = std::clamp(std::round(value), static_cast<double>(std::numeric_limits<Number>::min()),
                           static_cast<double>(std::numeric_limits<Number>::max()));
    const auto number = static_cast<Number>(value);
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

std::string_view volume_name(int type) {
    switch (type) {
    case 10:
    case 24:
        return "tetrahedra";
    case 11:
        return "voxels";
    case 12:
    case 25:
        return "hexahedra";
    case 13:
    case 26:
        return "wedges";
    case 14:
    case 27:
        return "pyramids";
    default:
        return "";
    }
}

} // namespace

std::size_t size_of(VtkType type) {
    switch (type) {
    case VtkType::int8:
    case VtkType::uint8:
        return 1;
    case VtkType::int16:
    case VtkType::uint16:
        return 2;
    case VtkType::int32:
    case VtkType::uint32:
    case VtkType::float32:
        return 4;
    case VtkType::int64:
    case VtkType::uint64:
    case VtkType::float64:
        return 8;
    default:
        return 0;
    }
}

bool is_float(VtkType type) {
    return type == VtkType::float32 || type == VtkType::float64;
}

double number_at(const char* bytes, VtkType type) {
    switch (type) {
    case VtkType::int8:
        return number_as<std::int8_t>(bytes);
    case VtkType::uint8:
        return number_as<std::uint8_t>(bytes);
    case VtkType::int16:
        return number_as<std::int16_t>(bytes);
    case VtkType::uint16:
        return number_as<std::uint16_t>(bytes);
    case VtkType::int32:
        return number_as<std::int32_t>(bytes);
    case VtkType::uint32:
        return number_as<std::uint32_t>(bytes);
    case VtkType::int64:
        return number_as<std::int64_t>(bytes);
    case VtkType::uint64:
        return number_as<std::uint64_t>(bytes);
    case VtkType::float32:
        return number_as<float>(bytes);
    default:
        return number_as<double>(bytes);
    }
}

void append_number(std::string& bytes, double value, VtkType type) {
    switch (type) {
    case VtkType::uint8:
        return append_as<std::uint8_t>(bytes, value);
    case VtkType::int32:
        return append_as<std::int32_t>(bytes, value);
    case VtkType::int64: // a double holds every whole number that a mesh can have
        return append_as<std::int64_t>(bytes, value);
    case VtkType::float32:
        return append_as<float>(bytes, value);
    default:
        return append_as<double>(bytes, value);
    }
}

void VtkSurface::add_polygon(std::span<const std::int64_t> cell, std::int64_t base) {
    if (cell.size() < 3) {
        ++short_faces;
        return;
    }
    for (const std::int64_t index : cell) {
        if (index < 0 || index > std::numeric_limits<int>::max() - base)
            bad_file(path, fmt::format("face {} (counted from 0): {} is no vertex's number; the file is damaged",
                                       mesh.ends.size(), index));
        mesh.corners.push_back(static_cast<int>(base + index));
    }
    mesh.end_polygon();
}

void VtkSurface::add(int type, std::span<const std::int64_t> cell, std::int64_t base) {
    const auto in_order = [&](std::initializer_list<std::size_t> order) {
        if (cell.size() < order.size())
            bad_file(path, fmt::format("a cell of type {} needs {} corners, this has {}; the file is damaged", type,
                                       order.size(), cell.size()));
        std::vector<std::int64_t> turned;
        for (const std::size_t i : order) turned.push_back(cell[i]);
        add_polygon(turned, base);
    };
    if (type >= 0 && type <= 4) { // nothing, vertices and lines
        ++loose;
    } else if (type == vtk_strip) {
        ++strips;
        for (std::size_t i = 0; i + 2 < cell.size(); ++i) {
            const std::array<std::int64_t, 3> face{cell[i + i % 2], cell[i + 1 - i % 2], cell[i + 2]};
            const bool joint = face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
            if (!joint) add_polygon(face, base); // joints are how strips are hung one behind the other
        }
    } else if (type == vtk_triangle || type == vtk_polygon || type == 9) {
        add_polygon(cell, base);
    } else if (type == 8) { // a pixel, whose corners go in rows
        in_order({0, 1, 3, 2});
    } else if (type == 22) { // triangles and quads with a point in the middle of each edge
        in_order({0, 3, 1, 4, 2, 5});
    } else if (type == 23) {
        in_order({0, 4, 1, 5, 2, 6, 3, 7});
    } else {
        const std::string_view name = volume_name(type);
        bad_file(path, fmt::format("holds {}, not a surface; extract the surface first (in ParaView: Extract Surface) "
                                   "and save it as PolyData",
                                   name.empty() ? fmt::format("cells of type {}", type) : name));
    }
}

void VtkSurface::tell() {
    std::vector<std::string>& notes = mesh.file.notes;
    if (strips > 0) notes.push_back(fmt::format("{} triangle strips were read as single triangles", strips));
    if (loose > 0) notes.push_back(fmt::format("{} vertices and lines beside the surface were passed over", loose));
    if (short_faces > 0)
        notes.push_back(fmt::format("{} faces of fewer than three corners were passed over", short_faces));
}

VtkRole vtk_role(std::string_view name, std::string_view attribute, VtkType type, int components) {
    const std::string known = lower(name);
    if (attribute == "COLOR_SCALARS" && components >= 3 && components <= 4) return VtkRole::colors;
    if (type == VtkType::uint8 && (components == 3 || components == 4)) return VtkRole::colors;
    if (is_float(type) && (components == 3 || components == 4) && (known == "rgb" || known == "rgba"))
        return VtkRole::colors;
    if (attribute == "NORMALS" || (known == "normals" && attribute.empty()))
        return components == 3 && is_float(type) ? VtkRole::normals : VtkRole::none;
    if (attribute == "TCOORDS" ||
        (attribute.empty() && (known == "tcoords" || known == "texture coordinates" || known == "texturecoordinates")))
        return components == 2 || components == 3 ? VtkRole::texcoords : VtkRole::none;
    return VtkRole::none;
}

namespace {

void take_colors(PolygonMesh& mesh, const VtkArray& array) {
    const std::size_t count = mesh.coordinates.size() / 3;
    const auto components = static_cast<std::size_t>(array.components);
    const double scale = array.type == VtkType::uint8 ? 255 : 1;
    mesh.colors.assign(4 * count, 1);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < components; ++k)
            mesh.colors[4 * i + k] = static_cast<float>(array.values[components * i + k] / scale);
    normalise_colors(mesh.colors);
    if (array.attribute != "COLOR_SCALARS") return;
    for (float& color : mesh.colors) // text gives bytes as six digits between 0 and 1
        if (const float byte = std::round(color * 255); std::abs(color * 255 - byte) < 0.001F) color = byte / 255;
}

void take_texcoords(PolygonMesh& mesh, const VtkArray& array) {
    const auto components = static_cast<std::size_t>(array.components);
    for (std::size_t i = 0; i < mesh.coordinates.size() / 3; ++i)
        for (std::size_t k = 0; k < 2; ++k) {
            const double value = array.values[components * i + k];
            mesh.texcoords.push_back(std::isfinite(value) ? static_cast<float>(value) : 0);
        }
    mesh.texcoord_corners = mesh.corners;
}

} // namespace

void take_point_arrays(VtkSurface& surface, std::vector<VtkArray>&& arrays) {
    PolygonMesh& mesh = surface.mesh;
    const std::size_t count = mesh.coordinates.size() / 3;
    for (const VtkArray& array : arrays) {
        VtkRole role = vtk_role(array.name, array.attribute, array.type, array.components);
        if (array.values.size() != count * static_cast<std::size_t>(array.components)) role = VtkRole::none;
        if (role == VtkRole::colors && mesh.colors.empty())
            take_colors(mesh, array);
        else if (role == VtkRole::texcoords && mesh.texcoords.empty())
            take_texcoords(mesh, array);
        else if (role == VtkRole::normals && mesh.file.normals.rows() == 0) {
            mesh.file.normals = Eigen::Map<const Points>(array.values.data(), static_cast<Eigen::Index>(count), 3)
                                    .unaryExpr([](double x) { return std::isfinite(x) ? x : 0; });
            mesh.file.normal_corners = mesh.corners;
        }
    }
}

Points renewed_normals(const Mesh& read, const Mesh& mesh) {
    const Points normals = file_normals(mesh), before = vertex_normals(read.positions, read.triangles);
    const bool inwards = before.cwiseProduct(mesh.file->normals).sum() < 0;
    return inwards ? Points(-normals) : normals;
}

Texcoords texcoords_of_vertices(const Mesh& mesh) {
    Texcoords result = Texcoords::Zero(mesh.positions.rows(), 2);
    std::vector<int> known(static_cast<std::size_t>(mesh.positions.rows()), -1);
    if (mesh.texcoords.rows() == 0) return {};
    for (Eigen::Index i = 0; i < mesh.texcoord_triangles.size(); ++i) {
        const int vertex = mesh.triangles.data()[i], index = mesh.texcoord_triangles.data()[i];
        int& before = known[static_cast<std::size_t>(vertex)];
        if (before >= 0 && mesh.texcoords.row(before) != mesh.texcoords.row(index)) return {};
        before = index;
        result.row(vertex) = mesh.texcoords.row(index);
    }
    return result;
}

std::vector<std::string> seams_left_behind(const Mesh& mesh, const std::filesystem::path& path) {
    if (mesh.texcoords.rows() == 0 || texcoords_of_vertices(mesh).rows() > 0) return {};
    return {fmt::format("{}: left behind the texture coordinates, because VTK has one a vertex and seams need two",
                        path.string())};
}

} // namespace meshtween
