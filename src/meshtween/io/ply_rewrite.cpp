// A PLY file with other positions and normals, all else byte for byte.
#include "meshtween/core/error.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/companions.h"
#include "meshtween/io/file_normals.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/patch.h"
#include "meshtween/io/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace meshtween {
namespace {

// The numbers that change, each where it stands and in its type.
struct Change {
    const char* at;
    double value;
    PlyType type;
    bool normal; // which needs no more digits than a float has
};

const PlyElement* element_named(const PlyHeader& header, std::string_view name) {
    for (const PlyElement& element : header.elements)
        if (element.name == name) return &element;
    return nullptr;
}

std::array<PlyType, 3> types_of(const PlyHeader& header, std::string_view element,
                                const std::array<std::string_view, 3>& names) {
    std::array<PlyType, 3> types{};
    if (const PlyElement* found = element_named(header, element))
        for (const PlyProperty& property : found->properties)
            for (std::size_t k = 0; k < 3; ++k)
                if (property.name == names[k] && !property.is_list) types[k] = property.type;
    return types;
}

constexpr std::array<std::string_view, 3> coordinate_names{"x", "y", "z"}, normal_names{"nx", "ny", "nz"};

void add(std::vector<Change>& changes, const std::vector<const char*>& places, const Points& values,
         const std::array<PlyType, 3>& types, bool normal) {
    for (std::size_t i = 0; i < places.size() && static_cast<Eigen::Index>(i) < values.size(); ++i)
        changes.push_back({places[i], values.data()[i], types[i % 3], normal});
}

// m x 3: unit normals of the file's polygons.
Points polygon_normals(const Mesh& mesh) {
    const std::vector<int> polygon = polygon_of_triangles(*mesh.file);
    Points normals = Points::Zero(static_cast<Eigen::Index>(mesh.file->ends.size()), 3);
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        normals.row(polygon[static_cast<std::size_t>(t)]) += double_area_normal(mesh.positions, mesh.triangles, t);
    normals.rowwise().normalize();
    return normals;
}

std::vector<Change> changes_of(const Mesh& mesh, const PlyHeader& header) {
    const MeshFile& file = *mesh.file;
    if (shape_key(mesh) == file.shape) return {};
    PlyPlaces places;
    read_ply_body(file.bytes, file.path, header, &places);
    std::vector<Change> changes;
    add(changes, places.positions, mesh.positions, types_of(header, "vertex", coordinate_names), false);
    if (!places.normals.empty())
        add(changes, places.normals, file_normals(mesh), types_of(header, "vertex", normal_names), true);
    if (!places.face_normals.empty())
        add(changes, places.face_normals, polygon_normals(mesh), types_of(header, "face", normal_names), true);
    std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.at < b.at; });
    return changes;
}

template <typename Number>
void put(char* at, double value, bool swap) {
    auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(static_cast<Number>(value));
    if (swap) std::reverse(raw.begin(), raw.end());
    std::memcpy(at, raw.data(), raw.size());
}

// What a header's comments name: pictures, found again from the new folder.
void patch_header(Patch& patch, std::string_view header, const Move& move) {
    Text text(header, {});
    while (text.next_line()) {
        if (text.word() != "comment" || text.word() != "TextureFile") continue;
        const std::string_view name = text.rest();
        if (const std::string carried = carry_picture(move, name); carried != name) patch.replace(name, carried);
    }
}

// The word that begins here.
std::string_view word_at(const char* at, const char* end) {
    const char* last = at;
    while (last<end&& * last> ' ') ++last;
    return {at, static_cast<std::size_t>(last - at)};
}

} // namespace

bool has_whole_coordinates(const PlyHeader& header) {
    const auto types = types_of(header, "vertex", coordinate_names);
    return std::any_of(types.begin(), types.end(),
                       [](PlyType type) { return type != PlyType::float32 && type != PlyType::float64; });
}

void rewrite_ply(const Mesh& mesh, const PlyHeader& header, const Move& move, std::ostream& stream) {
    const MeshFile& file = *mesh.file;
    const std::vector<Change> changes = changes_of(mesh, header);
    if (header.encoding == PlyEncoding::ascii) {
        Patch patch(file.bytes, stream);
        patch_header(patch, std::string_view(file.bytes).substr(0, header.size), move);
        for (const Change& change : changes) {
            const std::string_view word = word_at(change.at, file.bytes.data() + file.bytes.size());
            change.normal ? patch.replace(word, static_cast<float>(change.value)) : patch.replace(word, change.value);
        }
        return patch.finish();
    }
    std::string bytes = file.bytes;
    const bool swap = (header.encoding == PlyEncoding::little_endian) != (std::endian::native == std::endian::little);
    for (const auto& [at, value, type, normal] : changes) {
        char* here = bytes.data() + (at - file.bytes.data());
        if (type == PlyType::float32 && !std::isfinite(static_cast<float>(value)))
            throw Error(ErrorKind::computation,
                        fmt::format("a coordinate of {} is too large for the floats of {}; write .obj", value,
                                    file.path.string()));
        if (type == PlyType::float32) put<float>(here, value, swap);
        if (type == PlyType::float64) put<double>(here, value, swap);
    }
    Patch patch(bytes, stream);
    patch_header(patch, std::string_view(bytes).substr(0, header.size), move);
    patch.finish();
}

} // namespace meshtween
