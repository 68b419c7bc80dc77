// glTF 2.0 specification (Khronos, 2021): 3.5 scenes and nodes, 3.7 meshes. The default scene's triangles, one
// primitive after another, placed by their nodes. Skins, morph targets and animations are passed over: what is read is
// the mesh as it was modelled.
#include "meshtween/io/formats.h"
#include "meshtween/io/gltf_data.h"

#include "meshtween/core/color.h"
#include "meshtween/io/text.h"

#include <Eigen/Geometry>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <ranges>

namespace meshtween {
namespace {

using nlohmann::json;

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
constexpr std::size_t most_vertices = 100'000'000; // a small file can ask for any number by repeating a mesh

// glTF's vertex colours are linear, those of all other mesh formats are what a screen shows. A colour that was a byte
// before it was written comes back as that byte.
float shown_color(double linear) {
    const double srgb = srgb_from_linear(linear);
    const double byte = std::round(srgb * 255);
    return static_cast<float>(std::abs(srgb * 255 - byte) < 1e-3 ? byte / 255 : srgb);
}

class GltfReader {
public:
    GltfReader(std::string_view bytes, const std::filesystem::path& path) : data_(bytes, path) {}

    PolygonMesh read() {
        visited_.resize(data_.root().contains("nodes") ? data_.root()["nodes"].size() : 0);
        std::vector<Placed> stack;
        push(stack, roots(), Eigen::Matrix4d::Identity());
        while (!stack.empty()) {
            const Placed placed = stack.back();
            stack.pop_back();
            visit(placed, stack);
        }
        const std::size_t vertices = mesh_.coordinates.size() / 3;
        if (!mesh_.colors.empty()) mesh_.colors.resize(4 * vertices, 1);
        if (!mesh_.texcoords.empty()) {
            mesh_.texcoords.resize(2 * vertices, 0);
            mesh_.texcoord_corners = mesh_.corners;
        }
        return std::move(mesh_);
    }

private:
    struct Placed {
        std::size_t node;
        Eigen::Matrix4d parent; // of the node's parent in the world
    };

    std::vector<std::size_t> indices(const json& object, const char* key) const {
        std::vector<std::size_t> result;
        const auto found = object.find(key);
        if (found == object.end()) return result;
        for (const json& index : *found) {
            if (!index.is_number_unsigned()) data_.fail(fmt::format("'{}' holds no list of numbers", key));
            result.push_back(index.get<std::size_t>());
        }
        return result;
    }

    // The nodes of the default scene; without scenes, those that are nobody's child.
    std::vector<std::size_t> roots() const {
        if (data_.root().contains("scenes"))
            return indices(data_.item("scenes", data_.number(data_.root(), "scene", 0)), "nodes");
        std::vector<char> child(visited_.size());
        for (std::size_t node = 0; node < child.size(); ++node)
            for (const std::size_t c : indices(data_.item("nodes", node), "children"))
                if (c < child.size()) child[c] = 1;
        std::vector<std::size_t> result;
        for (std::size_t node = 0; node < child.size(); ++node)
            if (child[node] == 0) result.push_back(node);
        return result;
    }

    template <std::size_t Count>
    std::array<double, Count> numbers(const json& object, const char* key, std::array<double, Count> otherwise) const {
        const auto found = object.find(key);
        if (found == object.end()) return otherwise;
        if (!found->is_array() || found->size() != Count) data_.fail(fmt::format("a node's '{}' is damaged", key));
        for (std::size_t i = 0; i < Count; ++i) {
            if (!(*found)[i].is_number()) data_.fail(fmt::format("a node's '{}' is damaged", key));
            otherwise[i] = (*found)[i].get<double>();
        }
        return otherwise;
    }

    Eigen::Matrix4d local(const json& node) const {
        if (node.contains("matrix")) {
            const auto matrix = numbers<16>(node, "matrix", {});
            return Eigen::Map<const Eigen::Matrix4d>(matrix.data()); // column by column, both
        }
        const auto t = numbers<3>(node, "translation", {0, 0, 0}), s = numbers<3>(node, "scale", {1, 1, 1});
        const auto r = numbers<4>(node, "rotation", {0, 0, 0, 1});
        const Eigen::Quaterniond rotation(r[3], r[0], r[1], r[2]);
        Eigen::Affine3d result = Eigen::Translation3d(t[0], t[1], t[2]) * rotation.normalized();
        result.scale(Eigen::Vector3d(s[0], s[1], s[2]));
        return result.matrix();
    }

    void visit(const Placed& placed, std::vector<Placed>& stack) {
        const json& node = data_.item("nodes", placed.node);
        if (visited_[placed.node] != 0)
            data_.fail(fmt::format("nodes[{}] has two parents; the file is damaged", placed.node));
        visited_[placed.node] = 1;
        const Eigen::Matrix4d world = placed.parent * local(node);
        if (node.contains("mesh")) // a skin's joints, not the node, say where its mesh is
            read_mesh_of(data_.number(node, "mesh"), node.contains("skin") ? Eigen::Matrix4d::Identity() : world);
        push(stack, indices(node, "children"), world);
    }

    // So that the first of them is the next to be visited.
    static void push(std::vector<Placed>& stack, const std::vector<std::size_t>& nodes, const Eigen::Matrix4d& world) {
        for (const std::size_t node : nodes | std::views::reverse) stack.push_back({node, world});
    }

    void read_mesh_of(std::size_t index, const Eigen::Matrix4d& world);
    void read_primitive(const json& primitive, const Eigen::Matrix4d& world);
    struct Range {
        std::size_t first = 0, count = 0;
    };
    Range read_vertices(const json& attributes, const Eigen::Matrix4d& world);
    void read_triangles(const std::vector<double>& corners, std::size_t mode, std::size_t first, bool mirrored);

    GltfData data_;
    std::vector<char> visited_;
    PolygonMesh mesh_;
    std::map<std::array<std::size_t, 3>, Range> known_; // the vertices of this node's attributes
};

void GltfReader::read_mesh_of(std::size_t index, const Eigen::Matrix4d& world) {
    known_.clear();
    const json& mesh = data_.item("meshes", index);
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array()) return;
    for (const json& primitive : *primitives) read_primitive(primitive, world);
}

void GltfReader::read_primitive(const json& primitive, const Eigen::Matrix4d& world) {
    if (!primitive.is_object() || !primitive.contains("attributes") || !primitive["attributes"].contains("POSITION"))
        return;
    const std::size_t mode = data_.number(primitive, "mode", 4);
    if (mode < 4) return; // points and lines
    const Range vertices = read_vertices(primitive["attributes"], world);
    std::vector<double> corners;
    if (primitive.contains("indices"))
        corners = data_.rows(data_.number(primitive, "indices")).values;
    else
        for (std::size_t i = 0; i < vertices.count; ++i) corners.push_back(static_cast<double>(i));
    for (const double corner : corners)
        if (!(corner >= 0 && corner < static_cast<double>(vertices.count)))
            data_.fail(fmt::format("an index names vertex {}, but its part has {}; the file is damaged", corner,
                                   vertices.count));
    if (mesh_.corners.size() + 3 * corners.size() > 3 * most_vertices)
        data_.fail(fmt::format("has more than {} triangles once its parts are laid out", most_vertices));
    read_triangles(corners, mode, vertices.first, world.topLeftCorner<3, 3>().determinant() < 0);
}

// Appends the vertices and says where. Parts that share their attributes share their vertices.
GltfReader::Range GltfReader::read_vertices(const json& attributes, const Eigen::Matrix4d& world) {
    const std::array<std::size_t, 3> key{data_.number(attributes, "POSITION"),
                                         data_.number(attributes, "TEXCOORD_0", none),
                                         data_.number(attributes, "COLOR_0", none)};
    const std::size_t first = mesh_.coordinates.size() / 3;
    if (const auto known = known_.find(key); known != known_.end()) return known->second;
    const GltfRows positions = data_.rows(key[0]);
    if (positions.columns != 3) data_.fail("a POSITION has not three coordinates; the file is damaged");
    if (first + positions.size() > most_vertices)
        data_.fail(fmt::format("has more than {} vertices once its parts are laid out", most_vertices));
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Eigen::Vector4d local(positions.values[3 * i], positions.values[3 * i + 1], positions.values[3 * i + 2],
                                    1);
        const Eigen::Vector4d p = world * local;
        mesh_.coordinates.insert(mesh_.coordinates.end(), {p[0], p[1], p[2]});
    }
    if (key[1] != none) {
        const GltfRows uv = data_.rows(key[1]);
        if (uv.columns != 2 || uv.size() != positions.size()) data_.fail("TEXCOORD_0 does not agree with POSITION");
        mesh_.texcoords.resize(2 * first, 0);
        for (std::size_t i = 0; i < uv.values.size(); ++i) {
            const auto value = std::isfinite(uv.values[i]) ? static_cast<float>(uv.values[i]) : 0.0F;
            mesh_.texcoords.push_back(i % 2 == 0 ? value : 1 - value); // glTF counts v from the top
        }
    }
    if (key[2] != none) {
        const GltfRows color = data_.rows(key[2]);
        if (color.columns < 3 || color.size() != positions.size()) data_.fail("COLOR_0 does not agree with POSITION");
        mesh_.colors.resize(4 * first, 1);
        for (std::size_t i = 0; i < color.size(); ++i) {
            for (std::size_t c = 0; c < 3; ++c)
                mesh_.colors.push_back(shown_color(std::clamp(color.values[color.columns * i + c], 0.0, 1.0)));
            mesh_.colors.push_back(color.columns == 4 ? static_cast<float>(color.values[4 * i + 3]) : 1.0F);
        }
    }
    return known_[key] = {first, positions.size()};
}

// Mode 4: three corners each; 5: a strip, whose every second triangle is turned; 6: a fan.
void GltfReader::read_triangles(const std::vector<double>& corners, std::size_t mode, std::size_t first,
                                bool mirrored) {
    const std::size_t count = mode == 4 ? corners.size() / 3 : corners.size() < 3 ? 0 : corners.size() - 2;
    for (std::size_t t = 0; t < count; ++t) {
        std::array<std::size_t, 3> at{t, t + 1, t + 2};
        if (mode == 4)
            at = {3 * t, 3 * t + 1, 3 * t + 2};
        else if (mode == 6)
            at = {0, t + 1, t + 2};
        else if (t % 2 == 1)
            std::swap(at[1], at[2]);
        if (mirrored) std::swap(at[1], at[2]);
        for (const std::size_t i : at)
            mesh_.corners.push_back(static_cast<int>(first + static_cast<std::size_t>(corners[i])));
        mesh_.end_polygon();
    }
}

} // namespace

PolygonMesh read_gltf(std::string_view bytes, const std::filesystem::path& path) {
    try {
        return GltfReader(bytes, path).read();
    } catch (const json::exception& error) { // a value of another type than glTF wants
        bad_file(path, fmt::format("is damaged: {:.120}", error.what()));
    }
}

} // namespace meshtween
