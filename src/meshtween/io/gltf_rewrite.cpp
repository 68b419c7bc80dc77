// glTF 2.0 specification (Khronos, 2021): 3.5 scenes and nodes, 3.7 meshes. All is kept but what the shape changes.
#include "meshtween/io/gltf_rewrite.h"

#include "meshtween/io/gltf_numbering.h"
#include "meshtween/io/gltf_plain.h"
#include "meshtween/io/gltf_scene.h"
#include "meshtween/io/gltf_shading.h"
#include "meshtween/io/mesh_file.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <fmt/format.h>

#include <map>
#include <optional>
#include <set>

namespace meshtween {
namespace {

using Eigen::Matrix3d;
using nlohmann::json;

// New numbers of one piece's vertices, as the file has them.
struct Rows {
    std::vector<float> positions, normals, tangents;
};

// Primitives of one mesh with the same key have the same vertices.
std::string user_key(std::size_t mesh, const json& primitive) {
    return fmt::format("{} {} {}", mesh, primitive["attributes"].dump(),
                       primitive.value("targets", json::array()).dump());
}

class Rewriter {
public:
    explicit Rewriter(const Mesh& mesh)
        : mesh_(mesh), data_(mesh.file->bytes, mesh.file->path), layout_(gltf_layout(data_)), glb_(plain_gltf(data_)) {
        owners_ = byte_owners(glb_);
    }

    GltfRewrite write() {
        std::vector<double> before(3 * layout_.vertices);
        for (const GltfPiece& piece : layout_.pieces)
            if (!piece.again) gltf_positions(data_, layout_, piece, gltf_placement(data_, layout_, piece), before);
        const auto triangles = static_cast<std::size_t>(mesh_.triangles.rows());
        vertices_ = gltf_numbering(data_, layout_, before, triangles).vertices;
        shading_ = gltf_shading(mesh_, vertices_, before);
        place_parts();
        find_users();
        for (const GltfPiece& piece : layout_.pieces) {
            put(piece);
        }
        add_notes();
        return {std::move(glb_), std::move(notes_)};
    }

private:
    void place_parts();
    void split_instances(std::size_t node, std::size_t first, std::size_t end);
    void find_users();
    Rows rows_of(const GltfPiece& piece);
    void tangents_of(const GltfPiece& piece, const GltfPlacement& placement, Rows& rows) const;
    void put(const GltfPiece& piece);
    std::size_t put_rows(std::size_t accessor, const std::string& user, const std::vector<float>& values,
                         std::size_t columns, bool bounds);
    void add_notes();

    Eigen::Index vertex(std::size_t i) const { return vertices_.empty() ? static_cast<Eigen::Index>(i) : vertices_[i]; }

    const Mesh& mesh_;
    GltfData data_;
    GltfLayout layout_;
    Glb glb_;
    std::vector<char> owners_;
    std::vector<int> vertices_; // the mesh's vertex for each of the file's; empty where they are the same
    GltfShading shading_;
    std::vector<std::size_t> meshes_;                                  // a part: its mesh in the new file
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> first_; // a part's vertices: their first primitive
    std::map<std::size_t, std::set<std::string>> users_;               // an accessor: who uses it
    std::map<std::pair<std::size_t, std::string>, std::size_t> put_;   // what became of an accessor for one user
    std::size_t flat_ = 0;                                             // vertices that their matrices squash
    std::vector<std::string> notes_;
};

// Each part gets a mesh of its own: the first that shows a mesh keeps it, unless nodes outside the scene use it too.
void Rewriter::place_parts() {
    std::map<std::size_t, std::size_t> shown, all;
    for (const GltfPart& part : layout_.parts) ++shown[part.mesh];
    for (std::size_t n = 0; n < data_.count("nodes"); ++n) {
        const json& node = data_.item("nodes", n);
        if (node.contains("mesh")) ++all[data_.number(node, "mesh")];
    }
    std::set<std::size_t> taken;
    for (std::size_t p = 0; p < layout_.parts.size(); ++p) {
        const GltfPart& part = layout_.parts[p];
        if (taken.insert(part.mesh).second && shown[part.mesh] >= all[part.mesh]) {
            meshes_.push_back(part.mesh);
            continue;
        }
        meshes_.push_back(glb_.root["meshes"].size());
        json copy = glb_.root["meshes"][part.mesh];
        glb_.root["meshes"].push_back(std::move(copy));
        if (part.instance < 0) glb_.root["nodes"][part.node]["mesh"] = meshes_.back();
    }
    for (std::size_t p = 0; p < layout_.parts.size();) {
        const GltfPart& part = layout_.parts[p];
        std::size_t end = p + 1;
        while (part.instance >= 0 && end < layout_.parts.size() && layout_.parts[end].node == part.node) ++end;
        if (part.instance >= 0) split_instances(part.node, p, end);
        p = end;
    }
    forget_extension(glb_.root, "EXT_mesh_gpu_instancing");
}

// A node's instances become its children, with a mesh each.
void Rewriter::split_instances(std::size_t index, std::size_t first, std::size_t end) {
    json& nodes = glb_.root["nodes"];
    nodes[index].erase("mesh");
    nodes[index]["extensions"].erase("EXT_mesh_gpu_instancing");
    if (nodes[index]["extensions"].empty()) nodes[index].erase("extensions");
    for (std::size_t p = first; p < end; ++p) {
        const Eigen::Matrix4d& local = layout_.parts[p].local;
        json child = {{"mesh", meshes_[p]}};
        if (!local.isIdentity(0)) child["matrix"] = std::vector<double>(local.data(), local.data() + 16);
        nodes[index]["children"].push_back(nodes.size());
        nodes.push_back(std::move(child));
    }
}

// An accessor that one kind of vertices uses alone may change in its place. Points and lines go with the triangles of
// their mesh.
void Rewriter::find_users() {
    const json& meshes = glb_.root["meshes"];
    for (std::size_t m = 0; m < meshes.size(); ++m)
        for (const json& primitive : meshes[m].value("primitives", json::array())) {
            if (!has_triangles(data_, primitive)) continue;
            const std::string user = user_key(m, primitive);
            for (const auto& [name, accessor] : primitive["attributes"].items())
                if (accessor.is_number_unsigned()) users_[accessor.get<std::size_t>()].insert(user);
        }
}

Rows Rewriter::rows_of(const GltfPiece& piece) {
    const json& primitive = layout_.primitive(data_, piece);
    const GltfPlacement placement = gltf_placement(data_, layout_, piece);
    const GltfRows old = data_.attribute(primitive, "POSITION");
    Rows rows;
    Eigen::Matrix4d inverse;
    bool invertible = false;
    Matrix3d turn;
    for (std::size_t i = 0; i < piece.count; ++i) {
        if (i == 0 || placement.matrices.size() > 1) {
            const Eigen::Matrix4d& matrix = placement.matrix(i);
            inverse = matrix.inverse();
            invertible = inverse.allFinite();
            turn = matrix.topLeftCorner<3, 3>().transpose(); // takes normals back
        }
        Eigen::Vector4d p(0, 0, 0, 1);
        p.head<3>() = mesh_.positions.row(vertex(piece.first + i)).transpose();
        p = inverse * p;
        for (std::size_t c = 0; c < 3; ++c) {
            const double offset = placement.offsets.empty() ? 0 : placement.offsets[3 * i + c];
            rows.positions.push_back(
                static_cast<float>(invertible ? p[static_cast<Eigen::Index>(c)] - offset : old.values[3 * i + c]));
        }
        flat_ += invertible ? 0 : 1;
        if (shading_.normals.rows() == 0) continue;
        const auto row = static_cast<Eigen::Index>(piece.first + i);
        Eigen::Vector3d n = (turn * shading_.normals.row(row).transpose()).stableNormalized();
        if (!(n.squaredNorm() > 0.5)) n = Eigen::Vector3d(0, 1, 0);
        for (const double x : n) rows.normals.push_back(static_cast<float>(x));
    }
    if (primitive["attributes"].contains("TANGENT")) tangents_of(piece, placement, rows);
    return rows;
}

// Tangents are carried along by their triangles; their handedness stays.
void Rewriter::tangents_of(const GltfPiece& piece, const GltfPlacement& placement, Rows& rows) const {
    const GltfRows old = data_.attribute(layout_.primitive(data_, piece), "TANGENT");
    if (old.columns != 4 || old.size() != piece.count || rows.normals.empty()) return;
    for (std::size_t i = 0; i < piece.count; ++i) {
        const Matrix3d m = placement.matrix(i).topLeftCorner<3, 3>();
        const Eigen::Vector3d before = Eigen::Map<const Eigen::Vector3d>(old.values.data() + 4 * i);
        const Matrix3d& change = shading_.changes[piece.first + i];
        const Eigen::Vector3d n = Eigen::Map<const Eigen::Vector3f>(rows.normals.data() + 3 * i).cast<double>();
        Eigen::Vector3d t = m.inverse() * change * m * before;
        if (!t.allFinite()) t = before;
        t = (t - n * n.dot(t)).stableNormalized();
        if (!(t.squaredNorm() > 0.5)) t = n.unitOrthogonal();
        for (const double x : t) rows.tangents.push_back(static_cast<float>(x));
        rows.tangents.push_back(old.values[4 * i + 3] < 0 ? -1.0F : 1.0F);
    }
}

void Rewriter::put(const GltfPiece& piece) {
    json& mesh = glb_.root["meshes"][meshes_[piece.part]];
    json& primitive = mesh["primitives"][piece.primitive];
    if (piece.again) {
        primitive["attributes"] = mesh["primitives"][first_[{piece.part, piece.first}]]["attributes"];
        return;
    }
    first_[{piece.part, piece.first}] = piece.primitive;
    const Rows rows = rows_of(piece);
    const std::string user = user_key(meshes_[piece.part], primitive);
    const auto replace = [&](const char* name, const std::vector<float>& values, std::size_t columns) {
        if (values.empty() || !primitive["attributes"].contains(name)) return;
        const auto old = primitive["attributes"][name].get<std::size_t>();
        const std::size_t now = put_rows(old, user, values, columns, columns == 3 && *name == 'P');
        for (json& other : mesh["primitives"]) // lines over the surface go with it
            if (!has_triangles(data_, other) && other.value("attributes", json::object()).value(name, json()) == old)
                other["attributes"][name] = now;
        primitive["attributes"][name] = now;
    };
    replace("POSITION", rows.positions, 3);
    replace("NORMAL", rows.normals, 3);
    replace("TANGENT", rows.tangents, 4);
    if (primitive["attributes"].contains("TANGENT") && rows.tangents.empty()) primitive["attributes"].erase("TANGENT");
}

// The accessor that has the values now: the old one where nobody else uses it, else a new one.
std::size_t Rewriter::put_rows(std::size_t accessor, const std::string& user, const std::vector<float>& values,
                               std::size_t columns, bool bounds) {
    const auto [known, fresh] = put_.emplace(std::pair(accessor, user), accessor);
    if (!fresh) return known->second;
    if (users_[accessor].size() > 1 || users_[accessor].count(user) == 0) {
        known->second = glb_.root["accessors"].size();
        json copy = glb_.root.at("accessors").at(accessor);
        for (const char* key : {"bufferView", "sparse"}) copy.erase(key);
        glb_.root["accessors"].push_back(std::move(copy));
    }
    replace_rows(glb_, known->second, owners_, values, columns, bounds);
    return known->second;
}

void Rewriter::add_notes() {
    if (flat_ > 0)
        notes_.push_back(fmt::format("{} vertices that their nodes or joints squash flat stay as they were", flat_));
}

} // namespace

GltfRewrite rewritten_gltf(const Mesh& mesh) {
    return Rewriter(mesh).write();
}

} // namespace meshtween
