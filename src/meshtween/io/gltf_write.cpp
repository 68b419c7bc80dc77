// glTF 2.0 specification (Khronos, 2021): 3.7.2.2 morph targets, 3.11 animations, 4 the GLB container.
#include "meshtween/io/gltf_write.h"

#include "meshtween/core/color.h"
#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/core/version.h"
#include "meshtween/geometry/measure.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace meshtween {
namespace {

static_assert(std::endian::native == std::endian::little, "GLB is little-endian and written as the memory has it");

using nlohmann::json;
template <typename Number, int Columns>
using Rows = Eigen::Matrix<Number, Eigen::Dynamic, Columns, Columns == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

constexpr int array_buffer = 34962, element_array_buffer = 34963, no_target = 0; // the specification's numbers
constexpr int type_uint16 = 5123, type_uint32 = 5125, type_float = 5126;

struct Glb {
    json root;
    std::string bin;
};

template <typename Number>
constexpr int component_type() {
    if constexpr (std::is_same_v<Number, float>)
        return type_float;
    else
        return sizeof(Number) == 2 ? type_uint16 : type_uint32;
}

// Adds the rows to the buffer and tells the accessor's number.
template <typename Number, int Columns>
int append(Glb& glb, const Rows<Number, Columns>& rows, int target, bool bounds = false) {
    const char* const types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    const auto bytes = static_cast<std::size_t>(rows.size()) * sizeof(Number);
    glb.bin.resize((glb.bin.size() + 3) / 4 * 4, '\0');
    json view = {{"buffer", 0}, {"byteOffset", glb.bin.size()}, {"byteLength", bytes}};
    if (target != no_target) view["target"] = target;
    json accessor = {{"bufferView", glb.root["bufferViews"].size()},
                     {"componentType", component_type<Number>()},
                     {"count", rows.rows()},
                     {"type", types[Columns]}};
    if (bounds) {
        // Doubles hold floats exactly, and JSON gives doubles all their digits: the bounds are those of the data.
        for (int c = 0; c < Columns; ++c) {
            accessor["min"].push_back(static_cast<double>(rows.col(c).minCoeff()));
            accessor["max"].push_back(static_cast<double>(rows.col(c).maxCoeff()));
        }
    }
    glb.bin.append(reinterpret_cast<const char*>(rows.data()), bytes);
    glb.root["bufferViews"].push_back(std::move(view));
    glb.root["accessors"].push_back(std::move(accessor));
    return static_cast<int>(glb.root["accessors"].size()) - 1;
}

// The mesh with one UV a vertex.
struct Unseamed {
    std::vector<int> vertices;  // the mesh's vertex for each of the file's; the first n are 0 .. n-1
    std::vector<int> texcoords; // a row of the mesh's texcoords each, or -1
    Triangles triangles;
};

Unseamed split_seams(const Mesh& mesh) {
    Unseamed result{std::vector<int>(static_cast<std::size_t>(mesh.positions.rows())), {}, mesh.triangles};
    std::iota(result.vertices.begin(), result.vertices.end(), 0);
    if (mesh.texcoords.rows() == 0) return result;
    std::vector<int> next(result.vertices.size(), -1); // the next copy of the same vertex
    result.texcoords.assign(result.vertices.size(), -1);
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int c = 0; c < 3; ++c) {
            const int wanted = mesh.texcoord_triangles(t, c);
            auto at = static_cast<std::size_t>(mesh.triangles(t, c));
            while (result.texcoords[at] >= 0 &&
                   mesh.texcoords.row(result.texcoords[at]) != mesh.texcoords.row(wanted)) {
                if (next[at] < 0) {
                    next[at] = static_cast<int>(result.vertices.size());
                    result.vertices.push_back(mesh.triangles(t, c));
                    result.texcoords.push_back(-1);
                    next.push_back(-1);
                }
                at = static_cast<std::size_t>(next[at]);
            }
            result.texcoords[at] = wanted;
            result.triangles(t, c) = static_cast<int>(at);
        }
    return result;
}

void refuse(const std::string& message) {
    throw Error(ErrorKind::argument, message);
}

void check_indices(const Triangles& triangles, Eigen::Index count, const char* what) {
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        for (int c = 0; c < 3; ++c)
            if (triangles(t, c) < 0 || triangles(t, c) >= count)
                refuse(fmt::format("triangle {} names {} {}, but there are {}", t, what, triangles(t, c), count));
}

void check_finite(const Eigen::Ref<const Points>& points, const std::string& whose) {
    for (Eigen::Index i = 0; i < points.rows(); ++i)
        if (!points.row(i).allFinite())
            refuse(fmt::format("glTF cannot hold vertex {} of {}: a coordinate is not a finite number", i, whose));
}

void check_input(const Mesh& mesh, const GltfMorph& morph, const std::string& name) {
    if (mesh.triangles.rows() == 0) refuse(fmt::format("\"{}\" has no faces, so there is no glTF to write", name));
    check_indices(mesh.triangles, mesh.positions.rows(), "vertex");
    check_finite(mesh.positions, name);
    if (mesh.texcoords.rows() > 0) {
        if (mesh.texcoord_triangles.rows() != mesh.triangles.rows()) refuse("not every triangle has UVs");
        check_indices(mesh.texcoord_triangles, mesh.texcoords.rows(), "UV");
        if (!mesh.texcoords.allFinite()) refuse("a UV is not a finite number");
    }
    if (mesh.colors.rows() > 0 && (mesh.colors.rows() != mesh.positions.rows() || !mesh.colors.allFinite()))
        refuse("vertex colours must be finite and as many as vertices");
    const std::size_t count = morph.shapes.size();
    if (morph.names.size() != count || morph.weights.size() != count * morph.times.size() ||
        (count > 0 && morph.knots.size() != count + 2 + static_cast<std::size_t>(std::max(0, morph.degree))))
        refuse("names, knots and weights of the shapes do not agree in number");
    for (std::size_t k = 0; k < count; ++k) {
        if (morph.shapes[k].rows() != mesh.positions.rows())
            refuse(fmt::format("shape \"{}\" has {} vertices, but the mesh has {}", morph.names[k],
                               morph.shapes[k].rows(), mesh.positions.rows()));
        check_finite(morph.shapes[k], "shape \"" + morph.names[k] + '"');
    }
    const double rows = static_cast<double>(mesh.positions.rows()) + 3.0 * static_cast<double>(mesh.texcoords.rows());
    if (rows * 24 * static_cast<double>(count + 1) > 4e9)
        refuse(fmt::format("{} shapes of {} vertices do not fit into one GLB, which ends at 4 GiB: use fewer shapes",
                           count + 1, mesh.positions.rows()));
}

// Unit normals for all vertices: the validator refuses a zero, which vertices without area have.
Points shading_normals(const Points& positions, const Triangles& triangles) {
    Points normals = vertex_normals(positions, triangles);
    parallel_for(normals.rows(), [&](std::ptrdiff_t i) {
        if (normals.row(i).squaredNorm() < 0.25) normals.row(i) = Point(0, 1, 0);
    });
    return normals;
}

// rows[map[i]] as float, less `base` (if any), which is already float: base + delta is then rounded once.
Rows<float, 3> gathered(const Points& rows, const std::vector<int>& map, const Rows<float, 3>& base = {}) {
    Rows<float, 3> result(static_cast<Eigen::Index>(map.size()), 3);
    parallel_for(result.rows(), [&](std::ptrdiff_t i) {
        Point row = rows.row(map[static_cast<std::size_t>(i)]);
        if (base.rows() > 0) row -= base.row(i).cast<double>();
        result.row(i) = row.cast<float>();
    });
    return result;
}

void append_texcoords_and_colors(Glb& glb, json& attributes, const Mesh& mesh, const Unseamed& vertices) {
    const auto count = static_cast<Eigen::Index>(vertices.vertices.size());
    if (mesh.texcoords.rows() > 0) {
        Rows<float, 2> uv = Rows<float, 2>::Zero(count, 2);
        for (Eigen::Index i = 0; i < count; ++i)
            if (const int from = vertices.texcoords[static_cast<std::size_t>(i)]; from >= 0)
                uv.row(i) << mesh.texcoords(from, 0), 1 - mesh.texcoords(from, 1); // glTF counts v from the top
        attributes["TEXCOORD_0"] = append(glb, uv, array_buffer);
    }
    if (mesh.colors.rows() > 0) {
        Rows<float, 4> rgba(count, 4);
        for (Eigen::Index i = 0; i < count; ++i) {
            const auto color = mesh.colors.row(vertices.vertices[static_cast<std::size_t>(i)]);
            rgba.row(i) = color.cwiseMax(0).cwiseMin(1);
            for (int c = 0; c < 3; ++c) rgba(i, c) = linear_from_srgb(rgba(i, c));
        }
        attributes["COLOR_0"] = append(glb, rgba, array_buffer);
    }
}

int append_indices(Glb& glb, const Triangles& triangles, std::size_t vertex_count) {
    const Eigen::Map<const Rows<int, 1>> corners(triangles.data(), triangles.size());
    if (vertex_count <= 0xffff) // 65535 itself is kept for restarting a strip
        return append<std::uint16_t, 1>(glb, corners.cast<std::uint16_t>(), element_array_buffer);
    return append<std::uint32_t, 1>(glb, corners.cast<std::uint32_t>(), element_array_buffer);
}

void append_animation(Glb& glb, const GltfMorph& morph) {
    const auto keys = static_cast<Eigen::Index>(morph.times.size());
    const Eigen::Map<const Rows<float, 1>> times(morph.times.data(), keys);
    const Eigen::Map<const Rows<float, 1>> weights(morph.weights.data(),
                                                   static_cast<Eigen::Index>(morph.weights.size()));
    const int input = append<float, 1>(glb, times, no_target, true);
    const int output = append<float, 1>(glb, weights, no_target);
    glb.root["animations"] =
        json::array({{{"name", "morph"},
                      {"samplers", json::array({{{"input", input}, {"output", output}, {"interpolation", "LINEAR"}}})},
                      {"channels", json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}})}}});
}

// Normals of the base and all shapes.
std::vector<Points> all_normals(const Mesh& mesh, const GltfMorph& morph) {
    std::vector<Points> normals{shading_normals(mesh.positions, mesh.triangles)};
    if (morph.normal_fit.size() == 0) {
        for (const Points& shape : morph.shapes) normals.push_back(shading_normals(shape, mesh.triangles));
        return normals;
    }
    normals.resize(morph.shapes.size() + 1, Points::Zero(mesh.positions.rows(), 3));
    for (Eigen::Index s = 0; s < morph.normal_fit.cols(); ++s) {
        const Points on = shading_normals(morph.on_path(static_cast<std::size_t>(s)), mesh.triangles);
        for (std::size_t k = 1; k < normals.size(); ++k)
            if (const double share = morph.normal_fit(static_cast<Eigen::Index>(k), s); share != 0)
                parallel_for(on.rows(), [&](std::ptrdiff_t i) { normals[k].row(i) += share * on.row(i); });
    }
    return normals;
}

std::string packed(Glb glb) {
    glb.bin.resize((glb.bin.size() + 3) / 4 * 4, '\0');
    glb.root["buffers"] = json::array({{{"byteLength", glb.bin.size()}}});
    std::string text = glb.root.dump(-1, ' ', false, json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t total = 12 + 8 + text.size() + 8 + glb.bin.size();
    if (total > std::numeric_limits<std::uint32_t>::max())
        refuse("the mesh does not fit into one GLB, which ends at 4 GiB");
    std::string result;
    result.reserve(total);
    const auto number = [&](std::size_t value) {
        const auto word = static_cast<std::uint32_t>(value);
        result.append(reinterpret_cast<const char*>(&word), sizeof word);
    };
    result += "glTF";
    number(2); // version
    number(total);
    number(text.size());
    result += "JSON";
    result += text;
    number(glb.bin.size());
    result.append("BIN\0", 4);
    result += glb.bin;
    return result;
}

} // namespace

// Float has 24 bits: a mesh a few diagonals away from the origin keeps 1e-6 of its diagonal, one further away does not.
Point glb_origin(const Points& positions) {
    const Point centre = (positions.colwise().minCoeff() + positions.colwise().maxCoeff()) / 2;
    return centre.norm() > 4 * diagonal(positions) ? centre : Point(0, 0, 0);
}

std::string mesh_glb(const Mesh& mesh, const std::string& name) {
    return mesh_glb(mesh, GltfMorph{}, name);
}

std::string mesh_glb(const Mesh& mesh, const GltfMorph& morph, const std::string& name) {
    check_input(mesh, morph, name);
    const Point origin = glb_origin(mesh.positions);
    const Unseamed vertices = split_seams(mesh);
    const auto moved = [&](const Points& positions) -> Points { return positions.rowwise() - origin; };

    Glb glb;
    glb.root["asset"] = {{"version", "2.0"}, {"generator", std::string("meshtween ") + version()}};
    const auto positions = gathered(moved(mesh.positions), vertices.vertices);
    const std::vector<Points> shading = all_normals(mesh, morph);
    const auto normals = gathered(shading.front(), vertices.vertices);
    json primitive = {{"mode", 4}, {"material", 0}};
    primitive["indices"] = append_indices(glb, vertices.triangles, vertices.vertices.size());
    primitive["attributes"]["POSITION"] = append(glb, positions, array_buffer, true);
    primitive["attributes"]["NORMAL"] = append(glb, normals, array_buffer);
    append_texcoords_and_colors(glb, primitive["attributes"], mesh, vertices);
    for (std::size_t k = 0; k < morph.shapes.size(); ++k) {
        const auto offsets = gathered(moved(morph.shapes[k]), vertices.vertices, positions);
        const auto turns = gathered(shading[k + 1], vertices.vertices, normals);
        const int position = append(glb, offsets, array_buffer, true);
        primitive["targets"].push_back({{"POSITION", position}, {"NORMAL", append(glb, turns, array_buffer)}});
    }

    json node = {{"mesh", 0}, {"name", name}};
    if (!origin.isZero()) node["translation"] = {origin[0], origin[1], origin[2]};
    json part = {{"name", name}, {"primitives", json::array({primitive})}};
    if (!morph.shapes.empty()) {
        part["weights"] = std::vector<double>(morph.shapes.size(), 0);
        part["extras"] = {{"targetNames", morph.names}, {"degree", morph.degree}, {"knots", morph.knots}};
    }
    const std::array<double, 4> base =
        mesh.colors.rows() > 0 ? std::array{1.0, 1.0, 1.0, 1.0} : std::array{0.70, 0.625, 0.555, 1.0}; // clay
    glb.root["materials"] = json::array(
        {{{"name", "surface"},
          {"doubleSided", true},
          {"pbrMetallicRoughness", {{"baseColorFactor", base}, {"metallicFactor", 0}, {"roughnessFactor", 0.6}}}}});
    glb.root["meshes"] = json::array({part});
    glb.root["nodes"] = json::array({node});
    glb.root["scenes"] = json::array({{{"nodes", json::array({0})}}});
    glb.root["scene"] = 0;
    if (!morph.times.empty()) append_animation(glb, morph);
    return packed(std::move(glb));
}

} // namespace meshtween
