// glTF 2.0 specification (Khronos, 2021): 3.5 scenes and nodes, 3.7.2.2 morph targets, 3.7.3 skins;
// EXT_mesh_gpu_instancing. A skin is read in its rest pose, as a viewer shows it that plays no animation.
#include "meshtween/io/gltf_scene.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <ranges>
#include <utility>

namespace meshtween {
namespace {

using Eigen::Matrix4d;
using nlohmann::json;

// A small file can ask for any number by repeating a mesh.
constexpr std::size_t most_vertices = 100'000'000, most_parts = 2'000'000;
constexpr int most_sets = 16; // of joints

using Joints = std::shared_ptr<const std::vector<Matrix4d>>;
using Weights = std::shared_ptr<const std::vector<double>>;

template <std::size_t Count>
std::array<double, Count> numbers(const GltfData& data, const json& object, const char* key,
                                  std::array<double, Count> otherwise) {
    const auto found = object.find(key);
    if (found == object.end()) return otherwise;
    if (!found->is_array() || found->size() != Count) data.fail(fmt::format("a node's '{}' is damaged", key));
    for (std::size_t i = 0; i < Count; ++i) {
        if (!(*found)[i].is_number()) data.fail(fmt::format("a node's '{}' is damaged", key));
        otherwise[i] = (*found)[i].get<double>();
    }
    return otherwise;
}

Matrix4d placed(const Eigen::Vector3d& t, const Eigen::Vector4d& r, const Eigen::Vector3d& s) {
    Eigen::Quaterniond rotation(r[3], r[0], r[1], r[2]);
    if (!(rotation.squaredNorm() > 0)) rotation.setIdentity();
    Eigen::Affine3d result = Eigen::Translation3d(t) * rotation.normalized();
    result.scale(s);
    return result.matrix();
}

Matrix4d local_matrix(const GltfData& data, const json& node) {
    if (node.contains("matrix")) {
        const auto matrix = numbers<16>(data, node, "matrix", {});
        return Eigen::Map<const Matrix4d>(matrix.data()); // column by column, both
    }
    const auto t = numbers<3>(data, node, "translation", {0, 0, 0}), s = numbers<3>(data, node, "scale", {1, 1, 1});
    const auto r = numbers<4>(data, node, "rotation", {0, 0, 0, 1});
    return placed({t[0], t[1], t[2]}, {r[0], r[1], r[2], r[3]}, {s[0], s[1], s[2]});
}

// Walks the nodes from roots to leaves.
class Scene {
public:
    explicit Scene(const GltfData& data) : data_(data), nodes_(data.count("nodes")) {
        worlds_.resize(nodes_);
        parents_.assign(nodes_, nodes_);
        for (std::size_t node = 0; node < nodes_; ++node)
            for (const std::size_t child : children(node)) {
                data_.item("nodes", child);
                if (parents_[child] != nodes_ || child == node)
                    data_.fail(fmt::format("nodes[{}] has two parents; the file is damaged", child));
                parents_[child] = node;
            }
        known_.assign(nodes_, 0);
    }

    std::vector<std::size_t> children(std::size_t node) const {
        return data_.numbers(data_.item("nodes", node), "children");
    }

    // The nodes of the default scene; without scenes, those that are nobody's child.
    std::vector<std::size_t> roots() const {
        if (data_.root().contains("scenes"))
            return data_.numbers(data_.item("scenes", data_.number(data_.root(), "scene", 0)), "nodes");
        std::vector<std::size_t> result;
        for (std::size_t node = 0; node < nodes_; ++node)
            if (parents_[node] == nodes_) result.push_back(node);
        return result;
    }

    // All nodes that the scene shows, parents before their children, siblings in order.
    std::vector<std::size_t> visited() const {
        std::vector<std::size_t> order, stack;
        std::vector<char> seen(nodes_);
        const auto push = [&](const std::vector<std::size_t>& nodes) {
            for (const std::size_t node : nodes | std::views::reverse) stack.push_back(node);
        };
        push(roots());
        while (!stack.empty()) {
            const std::size_t node = stack.back();
            stack.pop_back();
            data_.item("nodes", node);
            if (std::exchange(seen[node], 1) != 0)
                data_.fail(fmt::format("nodes[{}] has two parents; the file is damaged", node));
            order.push_back(node);
            push(children(node));
        }
        return order;
    }

    Matrix4d world(std::size_t node) {
        std::vector<std::size_t> chain;
        for (std::size_t at = node; at != nodes_ && known_[at] == 0; at = parents_[at]) {
            chain.push_back(at);
            if (chain.size() > nodes_) data_.fail("its nodes are their own parents; the file is damaged");
        }
        for (const std::size_t at : chain | std::views::reverse) {
            const Matrix4d local = local_matrix(data_, data_.item("nodes", at));
            worlds_[at] = parents_[at] == nodes_ ? local : Matrix4d(worlds_[parents_[at]] * local);
            known_[at] = 1;
        }
        return worlds_[node];
    }

    Joints joints(std::size_t skin_index) {
        Joints& known = skins_[skin_index];
        if (known) return known;
        const json& skin = data_.item("skins", skin_index);
        const std::vector<std::size_t> joints = data_.numbers(skin, "joints");
        GltfRows inverse;
        if (skin.contains("inverseBindMatrices")) inverse = data_.rows(data_.number(skin, "inverseBindMatrices"));
        if (inverse.columns != 0 && (inverse.columns != 16 || inverse.size() < joints.size()))
            data_.fail(
                fmt::format("skins[{}] has other inverse bind matrices than joints; the file is damaged", skin_index));
        std::vector<Matrix4d> result;
        for (std::size_t j = 0; j < joints.size(); ++j) {
            data_.item("nodes", joints[j]);
            Matrix4d matrix = world(joints[j]);
            if (inverse.columns != 0) matrix *= Eigen::Map<const Matrix4d>(inverse.values.data() + 16 * j);
            result.push_back(matrix);
        }
        return known = std::make_shared<std::vector<Matrix4d>>(std::move(result));
    }

    Weights weights(const json& node, std::size_t mesh) {
        if (node.contains("weights")) return weights_of(node);
        Weights& known = weights_[mesh];
        if (!known) known = weights_of(data_.item("meshes", mesh));
        return known;
    }

    // The matrices of a node's instances, in the node's coordinates; none where it has none.
    std::vector<Matrix4d> instances(const json& node) const {
        const auto extensions = node.find("extensions");
        if (extensions == node.end() || !extensions->contains("EXT_mesh_gpu_instancing")) return {};
        const json& attributes = extensions->at("EXT_mesh_gpu_instancing").at("attributes");
        std::optional<std::size_t> count;
        const auto rows = [&](const char* key, std::size_t columns) {
            if (!attributes.contains(key)) return GltfRows{};
            GltfRows result = data_.rows(data_.number(attributes, key));
            if (result.columns != columns || result.size() != count.value_or(result.size()))
                data_.fail(fmt::format("the instances' {} does not agree with the others", key));
            count = result.size();
            return result;
        };
        const GltfRows t = rows("TRANSLATION", 3), r = rows("ROTATION", 4), s = rows("SCALE", 3);
        std::vector<Matrix4d> result;
        for (std::size_t i = 0; i < count.value_or(1); ++i) {
            const auto row = [&](const GltfRows& of, auto otherwise) {
                for (std::size_t c = 0; c < of.columns; ++c)
                    otherwise[static_cast<Eigen::Index>(c)] = of.values[i * of.columns + c];
                return otherwise;
            };
            result.push_back(placed(row(t, Eigen::Vector3d(0, 0, 0)), row(r, Eigen::Vector4d(0, 0, 0, 1)),
                                    row(s, Eigen::Vector3d(1, 1, 1))));
        }
        return result;
    }

private:
    Weights weights_of(const json& object) const {
        std::vector<double> weights = data_.reals(object, "weights");
        if (std::all_of(weights.begin(), weights.end(), [](double w) { return w == 0; })) weights.clear();
        return std::make_shared<std::vector<double>>(std::move(weights));
    }

    const GltfData& data_;
    std::size_t nodes_;
    std::map<std::size_t, Joints> skins_;
    std::map<std::size_t, Weights> weights_; // of meshes
    std::vector<Matrix4d> worlds_;
    std::vector<std::size_t> parents_; // nodes_: none
    std::vector<char> known_;          // of the worlds
};

// What two primitives must share to have the same vertices.
std::string attributes_key(const json& primitive) {
    std::string key = primitive.at("attributes").dump();
    if (primitive.contains("targets")) key += primitive["targets"].dump();
    if (primitive.contains("extensions") && primitive["extensions"].contains("KHR_draco_mesh_compression"))
        key += primitive["extensions"]["KHR_draco_mesh_compression"].dump();
    return key;
}

// Joints and weights of one of the sets (JOINTS_0, JOINTS_1 ...).
struct Influences {
    GltfRows joints, weights;
};

std::vector<Influences> influences(const GltfData& data, const json& primitive, std::size_t vertices) {
    std::vector<Influences> result;
    for (int set = 0;; ++set) {
        const std::string joints = fmt::format("JOINTS_{}", set), weights = fmt::format("WEIGHTS_{}", set);
        if (!primitive.at("attributes").contains(joints) || !primitive.at("attributes").contains(weights))
            return result;
        if (set == most_sets)
            data.fail(fmt::format("has more than {} sets of joints; export it with fewer joints a vertex", most_sets));
        result.push_back({data.attribute(primitive, joints), data.attribute(primitive, weights)});
        const auto& [j, w] = result.back();
        if (j.columns != 4 || w.columns != 4 || j.size() != vertices || w.size() != vertices)
            data.fail(fmt::format("{} does not agree with POSITION", joints));
    }
}

// The mean of the joints' matrices; where all weights are 0 the first joint's.
Matrix4d blended(const GltfData& data, const std::vector<Influences>& sets, const std::vector<Matrix4d>& joints,
                 std::size_t i) {
    Matrix4d sum = Matrix4d::Zero();
    double total = 0;
    for (const Influences& set : sets)
        for (std::size_t c = 0; c < 4; ++c) {
            const double weight = set.weights.values[4 * i + c], joint = set.joints.values[4 * i + c];
            if (weight == 0 || !std::isfinite(weight)) continue;
            if (!(joint >= 0 && joint < static_cast<double>(joints.size())))
                data.fail(fmt::format("vertex {} hangs on joint {}, but its skin has {}", i, joint, joints.size()));
            sum += weight * joints[static_cast<std::size_t>(joint)];
            total += weight;
        }
    if (total > 0) return sum / total;
    const double joint = sets[0].joints.values[4 * i];
    return joints[joint >= 0 && joint < static_cast<double>(joints.size()) ? static_cast<std::size_t>(joint) : 0];
}

std::vector<double> weighted_targets(const GltfData& data, const json& primitive, const std::vector<double>& weights,
                                     std::size_t vertices) {
    std::vector<double> offsets;
    const auto targets = primitive.find("targets");
    if (targets == primitive.end() || !targets->is_array()) return offsets;
    for (std::size_t k = 0; k < std::min(weights.size(), targets->size()); ++k) {
        if (weights[k] == 0 || !(*targets)[k].contains("POSITION")) continue;
        const GltfRows moves = data.rows(data.number((*targets)[k], "POSITION"));
        if (moves.columns != 3 || moves.size() != vertices) data.fail("a morph target does not agree with POSITION");
        offsets.resize(3 * vertices, 0.0);
        for (std::size_t i = 0; i < offsets.size(); ++i) offsets[i] += weights[k] * moves.values[i];
    }
    return offsets;
}

std::size_t vertices_of(const GltfData& data, const json& primitive) {
    const std::size_t accessor = data.number(primitive.at("attributes"), "POSITION");
    const std::size_t count = data.number(data.item("accessors", accessor), "count");
    if (count > most_vertices)
        data.fail(fmt::format("an accessor promises {} elements, more than a model has; the file is damaged", count));
    return count;
}

// Of one mesh: its primitives that have triangles.
struct Outline {
    struct Shown {
        std::size_t primitive, vertices;
        std::size_t first; // which of these has the same vertices before it; itself where none has
    };
    std::vector<Shown> shown;
    std::size_t passed_over = 0; // points and lines
};

Outline outline_of(const GltfData& data, const json& mesh) {
    Outline outline;
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array()) return outline;
    std::map<std::string, std::size_t> known;
    for (std::size_t k = 0; k < primitives->size(); ++k) {
        const json& primitive = (*primitives)[k];
        if (!has_triangles(data, primitive)) {
            ++outline.passed_over;
            continue;
        }
        const std::size_t vertices = vertices_of(data, primitive), at = outline.shown.size();
        outline.shown.push_back({k, vertices, known.emplace(attributes_key(primitive), at).first->second});
    }
    return outline;
}

void require_few(const GltfData& data, std::size_t parts) {
    if (parts > most_parts) data.fail(fmt::format("has more than {} parts once they are laid out", most_parts));
}

// Our own morphs whose look fades show the same mesh twice.
bool is_second_look(const json& node) {
    const json extras = node.value("extras", json());
    return extras.is_object() && extras.value("cover", json()) == true;
}

} // namespace

bool has_triangles(const GltfData& data, const json& primitive) {
    return primitive.is_object() && primitive.contains("attributes") && primitive["attributes"].contains("POSITION") &&
           data.number(primitive, "mode", 4) >= 4;
}

std::vector<GltfPart> gltf_parts(const GltfData& data) {
    Scene scene(data);
    std::vector<GltfPart> parts;
    for (const std::size_t index : scene.visited()) {
        const json& node = data.item("nodes", index);
        if (!node.contains("mesh") || is_second_look(node)) continue;
        GltfPart part;
        part.node = index;
        part.mesh = data.number(node, "mesh");
        data.item("meshes", part.mesh);
        part.world = scene.world(index);
        part.local.setIdentity();
        part.weights = scene.weights(node, part.mesh);
        if (node.contains("skin")) part.joints = scene.joints(data.number(node, "skin"));
        const std::vector<Matrix4d> instances = scene.instances(node);
        require_few(data, parts.size() + instances.size());
        if (instances.empty() && !node.value("extensions", json::object()).contains("EXT_mesh_gpu_instancing"))
            parts.push_back(part);
        for (std::size_t i = 0; i < instances.size(); ++i) {
            GltfPart copy = part;
            copy.instance = static_cast<int>(i);
            copy.local = instances[i];
            copy.world = part.world * copy.local;
            parts.push_back(std::move(copy));
        }
    }
    return parts;
}

const json& GltfLayout::primitive(const GltfData& data, const GltfPiece& piece) const {
    return data.item("meshes", parts[piece.part].mesh)["primitives"][piece.primitive];
}

GltfLayout gltf_layout(const GltfData& data) {
    GltfLayout layout;
    layout.parts = gltf_parts(data);
    std::map<std::size_t, Outline> outlines;
    std::size_t weights = 0;
    for (std::size_t p = 0; p < layout.parts.size(); ++p) {
        const GltfPart& part = layout.parts[p];
        const auto [found, fresh] = outlines.try_emplace(part.mesh);
        if (fresh) found->second = outline_of(data, data.item("meshes", part.mesh));
        const Outline& outline = found->second;
        layout.passed_over += outline.passed_over;
        const std::size_t begin = layout.pieces.size();
        require_few(data, begin + outline.shown.size());
        for (std::size_t k = 0; k < outline.shown.size(); ++k) {
            const auto& [primitive, vertices, first] = outline.shown[k];
            const bool again = first != k;
            layout.pieces.push_back(
                {p, primitive, again ? layout.pieces[begin + first].first : layout.vertices, vertices, again});
            if (again) continue;
            layout.vertices += vertices;
            weights += part.weights->size();
            for (const auto& [count, what] : {std::pair(layout.vertices, "vertices"), {weights, "weights"}})
                if (count > most_vertices)
                    data.fail(fmt::format("has more than {} {} once its parts are laid out", most_vertices, what));
        }
    }
    data.lay_out(layout.vertices);
    return layout;
}

GltfPlacement gltf_placement(const GltfData& data, const GltfLayout& layout, const GltfPiece& piece) {
    const GltfPart& part = layout.parts[piece.part];
    const json& primitive = layout.primitive(data, piece);
    GltfPlacement result;
    result.offsets = weighted_targets(data, primitive, *part.weights, piece.count);
    const bool bare = !part.joints || part.joints->empty();
    const std::vector<Influences> sets = bare ? std::vector<Influences>{} : influences(data, primitive, piece.count);
    result.skinned = !sets.empty();
    if (!result.skinned) {
        result.matrices = {part.world};
        return result;
    }
    result.matrices.reserve(piece.count);
    for (std::size_t i = 0; i < piece.count; ++i) result.matrices.push_back(blended(data, sets, *part.joints, i));
    return result;
}

void gltf_positions(const GltfData& data, const GltfLayout& layout, const GltfPiece& piece,
                    const GltfPlacement& placement, std::vector<double>& coordinates) {
    const GltfRows positions = data.attribute(layout.primitive(data, piece), "POSITION");
    if (positions.columns != 3) data.fail("a POSITION has not three coordinates; the file is damaged");
    if (positions.size() != piece.count) data.fail("a part has another number of vertices than it says");
    coordinates.resize(std::max(coordinates.size(), 3 * (piece.first + piece.count)));
    for (std::size_t i = 0; i < piece.count; ++i) {
        Eigen::Vector4d p(0, 0, 0, 1);
        for (std::size_t c = 0; c < 3; ++c)
            p[static_cast<Eigen::Index>(c)] =
                positions.values[3 * i + c] + (placement.offsets.empty() ? 0 : placement.offsets[3 * i + c]);
        const Eigen::Vector4d world = placement.matrix(i) * p;
        std::copy_n(world.data(), 3, coordinates.begin() + static_cast<std::ptrdiff_t>(3 * (piece.first + i)));
    }
}

} // namespace meshtween
