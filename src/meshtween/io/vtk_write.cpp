// Version 4.2 of the legacy format, which every reader reads, in binary: numbers are big-endian.
#include "meshtween/core/version.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/formats.h"
#include "meshtween/io/output.h"
#include "meshtween/io/seams.h"
#include "meshtween/io/space.h"
#include "meshtween/io/vtk_legacy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>

namespace meshtween {
namespace {

template <typename Derived>
std::string big_endian(const Eigen::MatrixBase<Derived>& rows, VtkType type) {
    const std::size_t size = size_of(type);
    std::string bytes;
    bytes.reserve(size * static_cast<std::size_t>(rows.size()));
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
        for (Eigen::Index k = 0; k < rows.cols(); ++k) {
            append_number(bytes, static_cast<double>(rows(i, k)), type);
            std::reverse(bytes.end() - static_cast<std::ptrdiff_t>(size), bytes.end());
        }
    return bytes;
}

// A float that is nearly zero stops VTK's reader of text.
double in_range(double value, VtkType type) {
    return type == VtkType::float32 && std::abs(value) < std::numeric_limits<float>::min() ? 0 : value;
}

std::string as_text(const Points& rows, VtkType type) {
    fmt::memory_buffer text;
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
        fmt::format_to(std::back_inserter(text), "{}{} {} {}", i > 0 ? "\n" : "", in_range(rows(i, 0), type),
                       in_range(rows(i, 1), type), in_range(rows(i, 2), type));
    return fmt::to_string(text);
}

// The file with other numbers in a block.
void splice(std::string& bytes, const VtkBlock& block, std::size_t type_at, const Points& rows, bool ascii) {
    const VtkType type = is_float(block.type) ? block.type : VtkType::float64;
    bytes.replace(block.begin, block.end - block.begin, ascii ? as_text(rows, type) : big_endian(rows, type));
    if (type != block.type) bytes.replace(type_at, block.type_name.size(), "double");
}

std::string rewritten(const Mesh& mesh) {
    if (shape_key(mesh) == mesh.file->shape) return mesh.file->bytes;
    const std::string& file = mesh.file->bytes;
    VtkLegacyFile scanned = scan_vtk(file, mesh.file->path);
    const bool has_normals = scanned.normals.begin != 0;
    Points normals;
    if (has_normals) {
        const Triangles cut = mesh.file->cut;
        normals = renewed_normals(cut_mesh(std::move(scanned.mesh), cut), mesh);
    }
    const auto at = [&](std::string_view word) { return static_cast<std::size_t>(word.data() - file.data()); };
    std::string bytes = file;
    // From behind, so that what lies before stays where it is.
    if (has_normals) splice(bytes, scanned.normals, at(scanned.normals.type_name), normals, scanned.ascii);
    splice(bytes, scanned.points, at(scanned.points.type_name), mesh.positions, scanned.ascii);
    return bytes;
}

void write_colors(const Colors& colors, std::ostream& stream) {
    const bool opaque = (colors.col(3).array() == 1).all();
    const Eigen::Index channels = opaque ? 3 : 4;
    stream << fmt::format("COLOR_SCALARS {} {}\n", opaque ? "RGB" : "RGBA", channels)
           << big_endian((colors.leftCols(channels).cwiseMax(0).cwiseMin(1) * 255).eval(), VtkType::uint8) << '\n';
}

void write_new(const Mesh& mesh, std::ostream& stream) {
    const WrittenPolygons polygons = written_polygons(mesh);
    const Space space = space_of(mesh);
    stream << fmt::format("# vtk DataFile Version 4.2\nwritten by meshtween {}{}{}\nBINARY\nDATASET POLYDATA\n",
                          version(),
                          space == Space::unknown ? "" : " SPACE=", space == Space::unknown ? "" : name_of(space))
           << fmt::format("POINTS {} double\n", mesh.positions.rows()) << big_endian(mesh.positions, VtkType::float64);
    Eigen::VectorXd cells(static_cast<Eigen::Index>(polygons.corners.size() + polygons.ends.size()));
    Eigen::Index next = 0;
    int begin = 0;
    for (const int end : polygons.ends) {
        cells[next++] = end - begin;
        for (; begin < end; ++begin) cells[next++] = polygons.corners[static_cast<std::size_t>(begin)];
    }
    stream << fmt::format("\nPOLYGONS {} {}\n", polygons.ends.size(), cells.size()) << big_endian(cells, VtkType::int32)
           << '\n';
    const Texcoords texcoords = texcoords_of_vertices(mesh);
    const bool normals = is_described(mesh) && mesh.file->normals.rows() > 0;
    if (mesh.colors.rows() == 0 && texcoords.rows() == 0 && !normals) return;
    stream << fmt::format("POINT_DATA {}\n", mesh.positions.rows());
    if (mesh.colors.rows() > 0) write_colors(mesh.colors, stream);
    if (normals)
        stream << "NORMALS Normals float\n"
               << big_endian(vertex_normals(mesh.positions, mesh.triangles, seams(mesh)), VtkType::float32) << '\n';
    if (texcoords.rows() > 0)
        stream << "TEXTURE_COORDINATES TCoords 2 float\n" << big_endian(texcoords, VtkType::float32) << '\n';
}

} // namespace

std::vector<std::string> write_vtk(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions&) {
    if (is_rewritable(mesh, ".vtk")) {
        write_whole(path, rewritten(mesh));
        return {};
    }
    write_whole(path, [&](std::ostream& stream) { write_new(mesh, stream); });
    return seams_left_behind(mesh, path);
}

} // namespace meshtween
