#include "meshtween/io/gltf_numbering.h"

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

using nlohmann::json;

// The numbers in _VERTEX, of all pieces; empty where one has none.
std::vector<int> told_vertices(const GltfData& data, const GltfLayout& layout) {
    std::vector<int> result(layout.vertices, -1);
    for (const GltfPiece& piece : layout.pieces) {
        const json& primitive = layout.primitive(data, piece);
        if (piece.part != layout.pieces.front().part || !primitive["attributes"].contains("_VERTEX")) return {};
        const GltfRows rows = data.attribute(primitive, "_VERTEX");
        if (rows.columns != 1 || rows.size() != piece.count) return {};
        for (std::size_t i = 0; i < piece.count; ++i) {
            const double value = rows.values[i];
            if (!(value >= 0 && value < static_cast<double>(layout.vertices)) || value != std::floor(value)) return {};
            result[piece.first + i] = static_cast<int>(value);
        }
    }
    return result;
}

// Whether all numbers are there, and what has one number lies in one place.
bool consistent(const std::vector<int>& vertices, int count, const std::vector<double>& coordinates) {
    std::vector<std::ptrdiff_t> first(static_cast<std::size_t>(count), -1);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        std::ptrdiff_t& seen = first[static_cast<std::size_t>(vertices[i])];
        if (seen < 0) seen = static_cast<std::ptrdiff_t>(i);
        for (std::size_t c = 0; c < 3; ++c)
            if (coordinates[3 * i + c] != coordinates[3 * static_cast<std::size_t>(seen) + c]) return false;
    }
    return std::find(first.begin(), first.end(), -1) == first.end();
}

// Pairs of a first triangle and how many follow it, a primitive after the other.
std::vector<int> told_triangles(const GltfData& data, const GltfLayout& layout, std::size_t triangles) {
    std::vector<int> result;
    for (const GltfPiece& piece : layout.pieces) {
        const json& primitive = layout.primitive(data, piece);
        const json extras = primitive.value("extras", json::object());
        if (!extras.is_object() || !extras.contains("triangles")) return {};
        const std::vector<std::size_t> runs = data.numbers(extras, "triangles");
        for (std::size_t r = 0; r + 1 < runs.size(); r += 2) {
            if (runs[r] > triangles || runs[r + 1] > triangles - result.size()) return {};
            for (std::size_t t = 0; t < runs[r + 1]; ++t) result.push_back(static_cast<int>(runs[r] + t));
        }
    }
    std::vector<int> sorted = result;
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t t = 0; t < sorted.size(); ++t)
        if (sorted[t] != static_cast<int>(t)) return {};
    return result.size() == triangles ? result : std::vector<int>();
}

// values, `columns` a triangle, in the mesh's order.
void reorder(std::vector<int>& values, const std::vector<int>& places, std::size_t columns) {
    if (values.size() != places.size() * columns) return;
    std::vector<int> result(values.size());
    for (std::size_t t = 0; t < places.size(); ++t)
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(t * columns), columns,
                    result.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(places[t]) * columns));
    values = std::move(result);
}

// rows[i] becomes row vertices[i] of the result.
template <typename Number>
void gather(std::vector<Number>& rows, const GltfNumbering& numbering, std::size_t columns) {
    if (rows.empty()) return;
    std::vector<Number> result(static_cast<std::size_t>(numbering.count) * columns);
    for (std::size_t i = 0; i < numbering.vertices.size(); ++i)
        for (std::size_t c = 0; c < columns; ++c)
            result[static_cast<std::size_t>(numbering.vertices[i]) * columns + c] = rows[i * columns + c];
    rows = std::move(result);
}

} // namespace

GltfNumbering gltf_numbering(const GltfData& data, const GltfLayout& layout, const std::vector<double>& coordinates,
                             std::size_t triangles) {
    GltfNumbering result;
    if (layout.pieces.empty()) return result;
    std::vector<int> vertices = told_vertices(data, layout);
    if (vertices.empty() || std::find(vertices.begin(), vertices.end(), -1) != vertices.end()) return result;
    const int count = *std::max_element(vertices.begin(), vertices.end()) + 1;
    if (!consistent(vertices, count, coordinates)) return result;
    result.vertices = std::move(vertices);
    result.count = count;
    result.polygons = told_triangles(data, layout, triangles);
    return result;
}

void apply_numbering(const GltfNumbering& numbering, PolygonMesh& mesh) {
    if (numbering.vertices.empty()) return;
    const auto vertex = [&](int i) { return numbering.vertices[static_cast<std::size_t>(i)]; };
    std::vector<float> wedges; // u v a corner
    if (!mesh.texcoords.empty())
        for (const int c : mesh.texcoord_corners)
            for (std::size_t k = 0; k < 2; ++k) wedges.push_back(mesh.texcoords[2 * static_cast<std::size_t>(c) + k]);
    if (!numbering.polygons.empty()) {
        std::vector<float> moved(wedges.size());
        for (std::size_t t = 0; t < numbering.polygons.size() && !wedges.empty(); ++t)
            std::copy_n(wedges.begin() + static_cast<std::ptrdiff_t>(6 * t), 6,
                        moved.begin() + 6 * static_cast<std::ptrdiff_t>(numbering.polygons[t]));
        wedges = std::move(moved);
        reorder(mesh.corners, numbering.polygons, 3);
        reorder(mesh.file.normal_corners, numbering.polygons, 3);
        reorder(mesh.file.polygon_materials, numbering.polygons, 1);
        reorder(mesh.file.objects.of, numbering.polygons, 1);
        for (TexcoordSet& set : mesh.file.more_texcoords) reorder(set.corners, numbering.polygons, 3);
    }
    std::transform(mesh.corners.begin(), mesh.corners.end(), mesh.corners.begin(), vertex);
    gather(mesh.coordinates, numbering, 3);
    gather(mesh.colors, numbering, 4);
    if (wedges.empty()) return;
    mesh.texcoords.clear();
    mesh.texcoord_corners.clear();
    share_texcoords(mesh, wedges);
}

} // namespace meshtween
