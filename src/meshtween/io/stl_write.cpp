// STL: the mesh's own file with other positions and normals, or a new one in binary.
#include "meshtween/geometry/measure.h"
#include "meshtween/io/formats.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/output.h"
#include "meshtween/io/patch.h"
#include "meshtween/io/stl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace meshtween {
namespace {

static_assert(std::endian::native == std::endian::little, "written as memory has it");

// m x 3: unit normals of the file's facets, by the first triangle of each that has an area.
Points facet_normals(const Mesh& mesh) {
    const std::vector<int> facet = polygon_of_triangles(*mesh.file);
    Points normals = Points::Zero(static_cast<Eigen::Index>(mesh.file->ends.size()), 3);
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        normals.row(facet[static_cast<std::size_t>(t)]) += double_area_normal(mesh.positions, mesh.triangles, t);
    normals.rowwise().normalize();
    return normals;
}

std::array<float, 3> floats(const Points& points, Eigen::Index row) {
    return {static_cast<float>(points(row, 0)), static_cast<float>(points(row, 1)), static_cast<float>(points(row, 2))};
}

// A facet without a normal keeps none.
void rewrite_binary(const Mesh& mesh, const StlLayout& layout, std::ostream& stream) {
    const MeshFile& file = *mesh.file;
    const Points normals = facet_normals(mesh);
    std::string bytes = file.bytes;
    char* here = bytes.data() + stl_header_size + 4;
    for (std::size_t facet = 0; facet < layout.facets; ++facet) {
        std::array<float, 12> values;
        std::memcpy(values.data(), here, sizeof values);
        if (values[0] != 0 || values[1] != 0 || values[2] != 0)
            std::ranges::copy(floats(normals, static_cast<Eigen::Index>(facet)), values.begin());
        for (std::size_t k = 0; k < 3; ++k)
            std::ranges::copy(floats(mesh.positions, file.corners[3 * facet + k]), values.begin() + 3 + 3 * k);
        std::memcpy(here, values.data(), sizeof values);
        here += stl_facet_length(here, layout.payloads);
    }
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void rewrite_text(const Mesh& mesh, std::ostream& stream) {
    const MeshFile& file = *mesh.file;
    const Points normals = facet_normals(mesh);
    Text text(file.bytes, file.path);
    Patch patch(file.bytes, stream);
    std::size_t corner = 0;
    Eigen::Index facet = 0;
    while (text.next_line()) {
        const StlWord word = stl_word(text);
        if (word == StlWord::vertex) {
            const int vertex = file.corners[corner++];
            for (int k = 0; k < 3; ++k) patch.replace(text.word(), mesh.positions(vertex, k));
        } else if (word == StlWord::facet) {
            text.word(); // "normal"
            const std::array<std::string_view, 3> words{text.word(), text.word(), text.word()};
            const std::array<float, 3> normal = floats(normals, facet);
            const bool none = std::ranges::all_of(words, [](std::string_view w) {
                double value = 0;
                return !parse(w, value) || value == 0;
            });
            for (std::size_t k = 0; k < 3 && !none; ++k) patch.replace(words[k], normal[k]);
        } else if (word == StlWord::end_facet) {
            ++facet;
        }
    }
    patch.finish();
}

void rewrite(const Mesh& mesh, std::ostream& stream) {
    const MeshFile& file = *mesh.file;
    const StlLayout layout = stl_layout(file.bytes, file.path);
    if (shape_key(mesh) == file.shape)
        stream << file.bytes;
    else if (layout.text)
        rewrite_text(mesh, stream);
    else
        rewrite_binary(mesh, layout, stream);
}

void write_new(const Mesh& mesh, std::ostream& stream) {
    std::string header = "binary STL, written by meshtween";
    header.resize(stl_header_size, '\0');
    const auto count = static_cast<std::uint32_t>(mesh.triangles.rows());
    stream << header;
    stream.write(reinterpret_cast<const char*>(&count), sizeof count);
    const Points normals = triangle_normals(mesh.positions, mesh.triangles);
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
        std::array<float, 12> values;
        for (Eigen::Index c = 0; c < 3; ++c) {
            values[static_cast<std::size_t>(c)] = static_cast<float>(normals(t, c));
            for (Eigen::Index k = 0; k < 3; ++k)
                values[static_cast<std::size_t>(3 + 3 * k + c)] =
                    static_cast<float>(mesh.positions(mesh.triangles(t, k), c));
        }
        std::array<char, stl_facet_size> raw{};
        std::memcpy(raw.data(), values.data(), sizeof values);
        stream.write(raw.data(), raw.size());
    }
}

} // namespace

std::vector<std::string> write_stl(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions&) {
    const bool again = is_rewritable(mesh, ".stl");
    write_whole(path, [&](std::ostream& stream) { again ? rewrite(mesh, stream) : write_new(mesh, stream); });
    return {};
}

} // namespace meshtween
