#include "meshtween/fit/picture_layout.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/io/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <map>

namespace meshtween {
namespace {

constexpr int side = 256; // of the grid on which overlaps are looked for
constexpr std::size_t most_pictures = 16;
constexpr double overlap_let_pass = 0.01; // of the smaller set's cells
constexpr double area_let_pass = 0.02;    // of the surface: triangles that cannot be painted

using Cells = std::bitset<side * side>;
using Key = std::array<int, 4>; // kind and number of what it is painted with, tile

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

double doubled_area(const PictureTriangle& p) {
    const Eigen::RowVector2d b = p.row(1) - p.row(0), c = p.row(2) - p.row(0);
    return b[0] * c[1] - b[1] * c[0];
}

bool is_tiled(const PictureTriangle& p) {
    return (p.colwise().maxCoeff() - p.colwise().minCoeff()).maxCoeff() > 1 + 1e-6;
}

std::string problem_of(const Mesh& mesh) {
    if (mesh.texcoords.rows() == 0) return "has no texture coordinates";
    double whole = 0, tiled = 0, flat = 0;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
        const double area = triangle_area(mesh.positions, mesh.triangles, t);
        const PictureTriangle p = picture_triangle(mesh, t);
        whole += area;
        if (!p.allFinite() || is_tiled(p)) tiled += area;
        if (doubled_area(p) == 0) flat += area;
    }
    if (tiled > area_let_pass * whole) return "has texture coordinates that show a picture several times over (tiles)";
    if (flat > 0.5 * whole) return "has texture coordinates without area";
    return {};
}

// What each triangle is painted with, and the tile; the same for all triangles of a polygon.
std::vector<Key> keys_of(const Mesh& mesh) {
    std::vector<Key> keys(idx(mesh.triangles.rows()), Key{});
    const MeshFile* file = mesh.file && mesh.file->cut.rows() == mesh.triangles.rows() && !mesh.file->ends.empty()
                               ? mesh.file.get()
                               : nullptr;
    const std::vector<int> polygon = file != nullptr ? polygon_of_triangles(*file) : std::vector<int>();
    std::map<int, std::size_t> first; // a polygon's first triangle
    for (std::size_t t = 0; t < keys.size(); ++t) {
        if (file != nullptr) {
            const auto [entry, fresh] = first.try_emplace(polygon[t], t);
            if (!fresh) {
                keys[t] = keys[entry->second];
                continue;
            }
            const int m =
                polygon[t] < std::ssize(file->polygon_materials) ? file->polygon_materials[idx(polygon[t])] : -1;
            if (m >= 0 && m < std::ssize(file->materials)) {
                const int image = file->materials[idx(m)].base_color_image;
                keys[t][0] = image >= 0 ? 1 : 2;
                keys[t][1] = image >= 0 ? image : m;
            }
        }
        Eigen::RowVector2d centre(0, 0);
        for (int k = 0; k < 3; ++k)
            centre += mesh.texcoords.row(mesh.texcoord_triangles(static_cast<Eigen::Index>(t), k)).cast<double>() / 3;
        if (!centre.allFinite()) continue;
        keys[t][2] = static_cast<int>(std::clamp(std::floor(centre[0]), -1e6, 1e6));
        keys[t][3] = static_cast<int>(std::clamp(std::floor(centre[1]), -1e6, 1e6));
    }
    return keys;
}

// Marks the cells whose middles lie in the triangle.
void mark(Cells& cells, const PictureTriangle& p) {
    const double area = doubled_area(p);
    if (area == 0 || !p.allFinite() || is_tiled(p)) return;
    const PictureTriangle q = p * side;
    const Eigen::RowVector2d low = q.colwise().minCoeff(), high = q.colwise().maxCoeff();
    const double inverse = 1 / (area * side * side);
    for (int y = static_cast<int>(std::ceil(low[1] - 0.5)); y + 0.5 <= high[1]; ++y)
        for (int x = static_cast<int>(std::ceil(low[0] - 0.5)); x + 0.5 <= high[0]; ++x) {
            const auto share = [&](int i, int j) {
                return ((q(i, 0) - x - 0.5) * (q(j, 1) - y - 0.5) - (q(i, 1) - y - 0.5) * (q(j, 0) - x - 0.5)) *
                       inverse;
            };
            if (share(1, 2) > 0 && share(2, 0) > 0 && share(0, 1) > 0)
                cells.set(idx((y % side + side) % side * side + (x % side + side) % side));
        }
}

} // namespace

PictureTriangle picture_triangle(const Mesh& mesh, Eigen::Index t) {
    PictureTriangle p;
    for (int k = 0; k < 3; ++k) {
        const auto uv = mesh.texcoords.row(mesh.texcoord_triangles(t, k)).cast<double>();
        p.row(k) << uv[0], 1 - uv[1]; // v counts upwards
    }
    const Eigen::RowVector2d low = p.colwise().minCoeff();
    return p.rowwise() - Eigen::RowVector2d(std::floor(low[0]), std::floor(low[1]));
}

PictureLayout picture_layout(const Mesh& mesh) {
    PictureLayout layout;
    layout.problem = problem_of(mesh);
    if (!layout.problem.empty()) return layout;
    const std::vector<Key> keys = keys_of(mesh);
    std::map<Key, int> numbers;
    std::vector<Key> order; // of first appearance
    for (const Key& key : keys)
        if (numbers.try_emplace(key, -1).second) order.push_back(key);
    if (order.size() > 4096) {
        layout.problem = fmt::format("has texture coordinates on {} tiles", order.size());
        return layout;
    }
    std::map<Key, Cells> of_key;
    for (std::size_t t = 0; t < keys.size(); ++t)
        mark(of_key[keys[t]], picture_triangle(mesh, static_cast<Eigen::Index>(t)));
    std::vector<Cells> pictures;
    for (const Key& key : order) {
        if (pictures.size() > most_pictures) break;
        const Cells& own = of_key[key];
        const auto fits = std::find_if(pictures.begin(), pictures.end(), [&](const Cells& taken) {
            const auto least = static_cast<double>(std::min(own.count(), taken.count()));
            return static_cast<double>((own & taken).count()) <= overlap_let_pass * least;
        });
        numbers[key] = static_cast<int>(fits - pictures.begin());
        if (fits == pictures.end())
            pictures.push_back(own);
        else
            *fits |= own;
    }
    if (pictures.size() > most_pictures) {
        layout.problem = fmt::format("has texture coordinates that would take more than {} pictures", most_pictures);
        return layout;
    }
    layout.count = static_cast<int>(pictures.size());
    for (const Key& key : keys) layout.picture.push_back(numbers[key]);
    return layout;
}

} // namespace meshtween
