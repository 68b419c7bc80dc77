// glTF 2.0 specification (Khronos, 2021): 3.7.2.2 morph targets, 3.11 animations, 4 the GLB container.
#include "meshtween/io/gltf_write.h"

#include "meshtween/core/color.h"
#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/core/version.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/gltf_build.h"
#include "meshtween/io/gltf_look.h"
#include "meshtween/io/gltf_pack.h"
#include "meshtween/io/gltf_split.h"
#include "meshtween/io/mesh_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace meshtween {
namespace {

using nlohmann::json;
template <typename Number, int Columns>
using Rows = GltfColumns<Number, Columns>;

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

std::vector<int> in_order(std::size_t count) {
    std::vector<int> result(count);
    std::iota(result.begin(), result.end(), 0);
    return result;
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

// The normals of a part's vertices; (0, 1, 0) for those of no triangle.
Points part_normals(const Points& group_normals, const NormalGroups& groups, const GltfPrimitive& part) {
    Points result(static_cast<Eigen::Index>(part.corners.size()), 3);
    parallel_for(result.rows(), [&](std::ptrdiff_t i) {
        const int corner = part.corners[static_cast<std::size_t>(i)];
        result.row(i) = corner < 0 ? Point(0, 1, 0) : Point(group_normals.row(groups.of.data()[corner]));
    });
    return result;
}

void append_texcoords(Glb& glb, json& attributes, const GltfPrimitive& part, const std::vector<CornerTexcoords>& sets) {
    for (std::size_t s = 0; s < sets.size(); ++s) {
        Rows<float, 2> uv = Rows<float, 2>::Zero(static_cast<Eigen::Index>(part.corners.size()), 2);
        for (Eigen::Index i = 0; i < uv.rows(); ++i) {
            const int corner = part.corners[static_cast<std::size_t>(i)];
            const int from = corner < 0 ? -1 : sets[s].corners.data()[corner];
            if (from >= 0)
                uv.row(i) << sets[s].texcoords(from, 0), 1 - sets[s].texcoords(from, 1); // glTF counts v from the top
        }
        attributes[fmt::format("TEXCOORD_{}", s)] = append(glb, uv, gltf_array_buffer);
    }
}

void append_colors(Glb& glb, json& attributes, const GltfPrimitive& part, const Colors& colors) {
    Rows<float, 4> rgba(static_cast<Eigen::Index>(part.vertices.size()), 4);
    for (Eigen::Index i = 0; i < rgba.rows(); ++i) {
        rgba.row(i) = colors.row(part.vertices[static_cast<std::size_t>(i)]).cwiseMax(0).cwiseMin(1);
        for (int c = 0; c < 3; ++c) rgba(i, c) = linear_from_srgb(rgba(i, c));
    }
    attributes["COLOR_0"] = append(glb, rgba, gltf_array_buffer);
}

// Which vertex of the mesh each is. Names with an underscore are free for anyone, integers of 32 bits are not allowed
// there, and floats count to 2^24.
void append_numbering(Glb& glb, json& primitive, const GltfPrimitive& part, std::size_t parts) {
    constexpr int most = 1 << 24;
    Rows<float, 1> numbers(static_cast<Eigen::Index>(part.vertices.size()));
    for (Eigen::Index i = 0; i < numbers.rows(); ++i) {
        if (part.vertices[static_cast<std::size_t>(i)] > most) return;
        numbers[i] = static_cast<float>(part.vertices[static_cast<std::size_t>(i)]);
    }
    primitive["attributes"]["_VERTEX"] = append(glb, numbers, gltf_array_buffer);
    if (parts == 1) return;
    json& runs = primitive["extras"]["triangles"];
    for (const auto& [first, count] : part.runs) {
        runs.push_back(first);
        runs.push_back(count);
    }
}

int append_indices(Glb& glb, const Triangles& triangles, std::size_t vertex_count) {
    const Eigen::Map<const Rows<int, 1>> corners(triangles.data(), triangles.size());
    if (vertex_count <= 0xffff) // 65535 itself is kept for restarting a strip
        return append<std::uint16_t, 1>(glb, corners.cast<std::uint16_t>(), gltf_element_array_buffer);
    return append<std::uint32_t, 1>(glb, corners.cast<std::uint32_t>(), gltf_element_array_buffer);
}

void append_animation(Glb& glb, const GltfMorph& morph) {
    const auto keys = static_cast<Eigen::Index>(morph.times.size());
    const Eigen::Map<const Rows<float, 1>> times(morph.times.data(), keys);
    const Eigen::Map<const Rows<float, 1>> weights(morph.weights.data(),
                                                   static_cast<Eigen::Index>(morph.weights.size()));
    const int input = append<float, 1>(glb, times, gltf_no_target, true);
    const int output = append<float, 1>(glb, weights, gltf_no_target);
    glb.root["animations"] =
        json::array({{{"name", "morph"},
                      {"samplers", json::array({{{"input", input}, {"output", output}, {"interpolation", "LINEAR"}}})},
                      {"channels", json::array({{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}})}}});
}

// Vertex colours multiply a texture in glTF; in other formats they stand in for one.
bool shows_colors(const Mesh& mesh) {
    if (mesh.colors.rows() == 0) return false;
    const MeshFile* file = mesh.file.get();
    if (file == nullptr || file->format == ".glb" || file->format == ".gltf") return true;
    return std::all_of(file->materials.begin(), file->materials.end(),
                       [](const Material& material) { return material.base_color_image < 0; });
}

// The material of each triangle; none where the file has none, or one that is not told for each.
std::vector<int> triangle_materials(const Mesh& mesh) {
    const MeshFile* file = mesh.file.get();
    if (file == nullptr || file->materials.empty() || file->cut.rows() != mesh.triangles.rows()) return {};
    if (file->polygon_materials.empty()) // one material without more is everywhere
        return std::vector<int>(file->materials.size() == 1 ? static_cast<std::size_t>(mesh.triangles.rows()) : 0, 0);
    std::vector<int> result = polygon_of_triangles(*file);
    for (int& polygon : result) {
        const int material = file->polygon_materials[static_cast<std::size_t>(polygon)];
        polygon = material < static_cast<int>(file->materials.size()) ? material : -1;
    }
    return result;
}

// What the parts of one mesh are made from.
struct Source {
    const Mesh& mesh;
    const GltfMorph& morph;
    Point origin;
    std::vector<CornerTexcoords> texcoords;
    NormalGroups groups;
    std::vector<Points> normals; // a group each; of the base, then of the shapes
    bool colors = false;

    Points moved(const Points& positions) const { return positions.rowwise() - origin; }
};

json append_primitive(Glb& glb, const Source& source, const GltfPrimitive& part, const GltfParts& parts) {
    const auto positions = gathered(source.moved(source.mesh.positions), part.vertices);
    const std::vector<int> every = in_order(part.vertices.size());
    const auto normals_of = [&](std::size_t shape) { return part_normals(source.normals[shape], source.groups, part); };
    const auto normals = gathered(normals_of(0), every);
    json primitive = {{"mode", 4}};
    primitive["indices"] = append_indices(glb, part.triangles, part.vertices.size());
    json& attributes = primitive["attributes"];
    attributes["POSITION"] = append(glb, positions, gltf_array_buffer, true);
    attributes["NORMAL"] = append(glb, normals, gltf_array_buffer);
    append_texcoords(glb, attributes, part, source.texcoords);
    if (source.colors) append_colors(glb, attributes, part, source.mesh.colors);
    if (parts.renumbered) append_numbering(glb, primitive, part, parts.primitives.size());
    for (std::size_t k = 0; k < source.morph.shapes.size(); ++k) {
        const auto offsets = gathered(source.moved(source.morph.shapes[k]), part.vertices, positions);
        const auto turns = gathered(normals_of(k + 1), every, normals);
        const int position = append(glb, offsets, gltf_array_buffer, true);
        primitive["targets"].push_back({{"POSITION", position}, {"NORMAL", append(glb, turns, gltf_array_buffer)}});
    }
    return primitive;
}

// Normals of the base and all shapes, a group each.
std::vector<Points> all_normals(const Mesh& mesh, const GltfMorph& morph, const NormalGroups& groups) {
    std::vector<Points> normals{group_normals(mesh.positions, groups)};
    if (morph.normal_fit.size() == 0) {
        for (const Points& shape : morph.shapes) normals.push_back(group_normals(shape, groups));
        return normals;
    }
    normals.resize(morph.shapes.size() + 1, Points::Zero(normals.front().rows(), 3));
    for (Eigen::Index s = 0; s < morph.normal_fit.cols(); ++s) {
        const Points on = group_normals(morph.on_path(static_cast<std::size_t>(s)), groups);
        for (std::size_t k = 1; k < normals.size(); ++k)
            if (const double share = morph.normal_fit(static_cast<Eigen::Index>(k), s); share != 0)
                parallel_for(on.rows(), [&](std::ptrdiff_t i) { normals[k].row(i) += share * on.row(i); });
    }
    return normals;
}

Source source_of(const Mesh& mesh, const GltfMorph& morph) {
    Source source{
        mesh, morph, glb_origin(mesh.positions), corner_texcoords(mesh), normal_groups(mesh), {}, shows_colors(mesh)};
    source.normals = all_normals(mesh, morph, source.groups);
    return source;
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
    return packed(mesh_gltf(mesh, morph, name));
}

Glb mesh_gltf(const Mesh& mesh, const GltfMorph& morph, const std::string& name) {
    check_input(mesh, morph, name);
    const Source source = source_of(mesh, morph);
    const std::vector<int> materials = triangle_materials(mesh);
    const GltfParts parts = split_parts(mesh, source.texcoords, source.groups, materials);
    Glb glb;
    glb.root["asset"] = {{"version", "2.0"}, {"generator", std::string("meshtween ") + version()}};
    json primitives = json::array();
    for (const GltfPrimitive& part : parts.primitives) primitives.push_back(append_primitive(glb, source, part, parts));
    const bool plain = parts.primitives.front().material < 0;
    append_materials(glb, materials.empty() ? nullptr : mesh.file.get(), plain, source.colors, source.texcoords.size());
    for (std::size_t p = 0; p < parts.primitives.size(); ++p) {
        const int material = parts.primitives[p].material;
        primitives[p]["material"] = material < 0 ? static_cast<int>(glb.root["materials"].size()) - 1 : material;
    }

    json node = {{"mesh", 0}, {"name", name}};
    if (const Point& at = source.origin; !at.isZero()) node["translation"] = {at[0], at[1], at[2]};
    json part = {{"name", name}, {"primitives", std::move(primitives)}};
    if (!morph.shapes.empty()) {
        part["weights"] = std::vector<double>(morph.shapes.size(), 0);
        part["extras"] = {{"targetNames", morph.names}, {"degree", morph.degree}, {"knots", morph.knots}};
    }
    glb.root["meshes"] = json::array({part});
    glb.root["nodes"] = json::array({node});
    glb.root["scenes"] = json::array({{{"nodes", json::array({0})}}});
    glb.root["scene"] = 0;
    if (!morph.times.empty()) append_animation(glb, morph);
    return glb;
}

std::vector<std::string> mesh_glb_notes(const Mesh& mesh) {
    if (mesh.file == nullptr || triangle_materials(mesh).empty()) return {};
    Glb glb;
    return append_materials(glb, mesh.file.get(), false, false, corner_texcoords(mesh).size());
}

} // namespace meshtween
