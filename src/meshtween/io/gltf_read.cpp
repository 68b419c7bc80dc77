// glTF 2.0 specification (Khronos, 2021): 3.7 meshes. The default scene's triangles, one primitive after another, where
// a viewer shows them that plays no animation.
#include "meshtween/io/formats.h"
#include "meshtween/io/gltf_materials.h"
#include "meshtween/io/gltf_numbering.h"
#include "meshtween/io/gltf_scene.h"

#include "meshtween/core/color.h"
#include "meshtween/io/text.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <unordered_map>

namespace meshtween {
namespace {

using nlohmann::json;

constexpr std::size_t most_corners = 300'000'000;
constexpr std::size_t most_texcoord_sets = 16, longest_name = 1000;

// glTF's vertex colours are linear, those of all other mesh formats are what a screen shows. A colour that was a byte
// before it was written comes back as that byte.
float shown_color(double linear) {
    const double srgb = srgb_from_linear(linear);
    const double byte = std::round(srgb * 255);
    return static_cast<float>(std::abs(srgb * 255 - byte) < 1e-3 ? byte / 255 : srgb);
}

class GltfReader {
public:
    GltfReader(std::string_view bytes, const std::filesystem::path& path) : data_(bytes, path) {
        require_known_extensions(data_);
        layout_ = gltf_layout(data_);
    }

    PolygonMesh read() {
        for (const GltfPiece& piece : layout_.pieces) {
            const GltfPlacement placement = gltf_placement(data_, layout_, piece);
            if (!piece.again) read_vertices(piece, placement);
            read_triangles(piece, placement);
        }
        attach_corners();
        read_gltf_materials(data_, mesh_.file);
        apply_numbering(gltf_numbering(data_, layout_, mesh_.coordinates, mesh_.ends.size()), mesh_);
        add_notes();
        return std::move(mesh_);
    }

private:
    // The place of a piece's numbers; `all` grow with the data, since a count is only a promise.
    template <typename Number>
    Number* place(std::vector<Number>& all, std::size_t columns, const GltfPiece& piece, Number otherwise) {
        all.resize(std::max(all.size(), columns * (piece.first + piece.count)), otherwise);
        return all.data() + columns * piece.first;
    }

    void read_vertices(const GltfPiece& piece, const GltfPlacement& placement);
    void read_texcoords(const GltfPiece& piece);
    void read_colors(const GltfPiece& piece);
    void read_normals(const GltfPiece& piece, const GltfPlacement& placement);
    void read_triangles(const GltfPiece& piece, const GltfPlacement& placement);
    void name_triangles(const GltfPiece& piece);
    void attach_corners();
    void add_notes();

    GltfData data_;
    GltfLayout layout_;
    PolygonMesh mesh_;
    std::vector<std::vector<float>> texcoords_; // a set: u v a vertex of the file
    std::vector<double> normals_;               // x y z a vertex of the file
    std::unordered_map<std::string, int> names_;
    std::size_t targets_ = 0; // morph targets of the mesh that has most
    bool more_texcoords_ = false;
    bool skinned_ = false, weighted_ = false;
};

void GltfReader::read_vertices(const GltfPiece& piece, const GltfPlacement& placement) {
    gltf_positions(data_, layout_, piece, placement, mesh_.coordinates);
    const json& primitive = layout_.primitive(data_, piece);
    if (const auto targets = primitive.find("targets"); targets != primitive.end())
        targets_ = std::max(targets_, targets->size());
    skinned_ |= placement.skinned;
    weighted_ |= !placement.offsets.empty();
    read_texcoords(piece);
    read_colors(piece);
    read_normals(piece, placement);
}

void GltfReader::read_texcoords(const GltfPiece& piece) {
    const json& primitive = layout_.primitive(data_, piece);
    for (std::size_t set = 0;; ++set) {
        const std::string name = fmt::format("TEXCOORD_{}", set);
        if (!primitive["attributes"].contains(name)) return;
        if (set == most_texcoord_sets) {
            more_texcoords_ = true;
            return;
        }
        const GltfRows uv = data_.attribute(primitive, name);
        if (uv.columns != 2 || uv.size() != piece.count) data_.fail(name + " does not agree with POSITION");
        if (texcoords_.size() == set) texcoords_.emplace_back();
        float* const to = place(texcoords_[set], 2, piece, 0.0F);
        for (std::size_t i = 0; i < uv.values.size(); ++i) {
            const auto value = std::isfinite(uv.values[i]) ? static_cast<float>(uv.values[i]) : 0.0F;
            // glTF counts v from the top
            to[i] = i % 2 == 0 ? value : 1 - value;
        }
    }
}

void GltfReader::read_colors(const GltfPiece& piece) {
    const json& primitive = layout_.primitive(data_, piece);
    if (!primitive["attributes"].contains("COLOR_0")) return;
    const GltfRows color = data_.attribute(primitive, "COLOR_0");
    if (color.columns < 3 || color.size() != piece.count) data_.fail("COLOR_0 does not agree with POSITION");
    float* const to = place(mesh_.colors, 4, piece, 1.0F);
    for (std::size_t i = 0; i < color.size(); ++i) {
        float* rgba = to + 4 * i;
        for (std::size_t c = 0; c < 3; ++c)
            rgba[c] = shown_color(std::clamp(color.values[color.columns * i + c], 0.0, 1.0));
        rgba[3] = color.columns == 4 ? static_cast<float>(color.values[4 * i + 3]) : 1.0F;
    }
}

void GltfReader::read_normals(const GltfPiece& piece, const GltfPlacement& placement) {
    const json& primitive = layout_.primitive(data_, piece);
    if (!primitive["attributes"].contains("NORMAL")) return;
    const GltfRows normals = data_.attribute(primitive, "NORMAL");
    if (normals.columns != 3 || normals.size() != piece.count) return; // they do not shape anything
    double* const to = place(normals_, 3, piece, 0.0);
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity(); // cofactors: the inverse's transpose without its division
    for (std::size_t i = 0; i < piece.count; ++i) {
        if (i == 0 || placement.matrices.size() > 1) {
            const Eigen::Matrix3d m = placement.matrix(i).topLeftCorner<3, 3>();
            turn << m.col(1).cross(m.col(2)), m.col(2).cross(m.col(0)), m.col(0).cross(m.col(1));
            if (m.determinant() < 0) turn = -turn;
        }
        const Eigen::Vector3d n =
            (turn * Eigen::Map<const Eigen::Vector3d>(normals.values.data() + 3 * i)).stableNormalized();
        if (n.allFinite()) std::copy_n(n.data(), 3, to + 3 * i);
    }
}

// Mode 4: three corners each; 5: a strip, whose every second triangle is turned; 6: a fan. Triangles of a strip that
// name a vertex twice only lead from one part of it to the next. Where a matrix mirrors, its triangles are turned back.
void GltfReader::read_triangles(const GltfPiece& piece, const GltfPlacement& placement) {
    const json& primitive = layout_.primitive(data_, piece);
    const std::size_t mode = data_.number(primitive, "mode", 4);
    const std::vector<double> corners = data_.corners(primitive, piece.count);
    for (const double corner : corners)
        if (!(corner >= 0 && corner < static_cast<double>(piece.count)))
            data_.fail(
                fmt::format("an index names vertex {}, but its part has {}; the file is damaged", corner, piece.count));
    if (mesh_.corners.size() + 3 * corners.size() > most_corners)
        data_.fail(fmt::format("has more than {} triangles once its parts are laid out", most_corners / 3));
    const auto mirrors = [&](std::size_t i) { return placement.matrix(i).topLeftCorner<3, 3>().determinant() < 0; };
    const bool one = placement.matrices.size() == 1, all = one && mirrors(0);
    const std::size_t count = mode == 4 ? corners.size() / 3 : corners.size() < 3 ? 0 : corners.size() - 2;
    for (std::size_t t = 0; t < count; ++t) {
        std::array<std::size_t, 3> at{t, t + 1, t + 2};
        if (mode == 4)
            at = {3 * t, 3 * t + 1, 3 * t + 2};
        else if (mode == 6)
            at = {0, t + 1, t + 2};
        else if (t % 2 == 1)
            std::swap(at[1], at[2]);
        const double a = corners[at[0]], b = corners[at[1]], c = corners[at[2]];
        if (mode == 5 && (a == b || b == c || c == a)) continue;
        if (one ? all : mirrors(static_cast<std::size_t>(corners[at[0]]))) std::swap(at[1], at[2]);
        for (const std::size_t i : at)
            mesh_.corners.push_back(static_cast<int>(piece.first + static_cast<std::size_t>(corners[i])));
        mesh_.end_polygon();
    }
    name_triangles(piece);
}

// Their material, and the node's name (or its mesh's).
void GltfReader::name_triangles(const GltfPiece& piece) {
    const GltfPart& part = layout_.parts[piece.part];
    const json& primitive = layout_.primitive(data_, piece);
    MeshFile& file = mesh_.file;
    const std::size_t materials = data_.count("materials"), material = data_.number(primitive, "material", materials);
    if (materials > 0)
        file.polygon_materials.resize(mesh_.ends.size(), material < materials ? static_cast<int>(material) : -1);
    const auto name_in = [](const json& object) {
        const auto name = object.find("name");
        return name != object.end() && name->is_string() ? name->get_ptr<const std::string*>() : nullptr;
    };
    const std::string* name = name_in(data_.item("nodes", part.node));
    if (name == nullptr) name = name_in(data_.item("meshes", part.mesh));
    std::string text = name != nullptr ? name->substr(0, longest_name) : std::string();
    if (part.instance > 0) text += fmt::format(" {}", part.instance + 1);
    const auto [known, fresh] = names_.try_emplace(text, static_cast<int>(file.objects.names.size()));
    if (fresh) file.objects.names.push_back(text);
    file.objects.of.resize(mesh_.ends.size(), known->second);
}

void GltfReader::attach_corners() {
    if (mesh_.file.objects.names == std::vector<std::string>{""}) mesh_.file.objects = {};
    for (std::vector<float>& set : texcoords_) set.resize(2 * layout_.vertices, 0);
    if (!mesh_.colors.empty()) mesh_.colors.resize(4 * layout_.vertices, 1);
    if (!normals_.empty()) normals_.resize(3 * layout_.vertices, 0);
    if (!texcoords_.empty()) {
        mesh_.texcoords = std::move(texcoords_.front());
        mesh_.texcoord_corners = mesh_.corners;
    }
    for (std::size_t set = 1; set < texcoords_.size(); ++set) {
        const auto rows = static_cast<Eigen::Index>(layout_.vertices);
        mesh_.file.more_texcoords.push_back({fmt::format("TEXCOORD_{}", set),
                                             Eigen::Map<const Texcoords>(texcoords_[set].data(), rows, 2),
                                             mesh_.corners});
    }
    if (normals_.empty()) return;
    mesh_.file.normals = Eigen::Map<const Points>(normals_.data(), static_cast<Eigen::Index>(layout_.vertices), 3);
    mesh_.file.normal_corners = mesh_.corners;
}

void GltfReader::add_notes() {
    for (const auto& [list, noun] :
         {std::pair("skins", "skin"), std::pair("animations", "animation"), std::pair("cameras", "camera")})
        if (data_.count(list) > 0) mesh_.file.only_here.push_back(counted(data_.count(list), noun));
    if (targets_ > 0) mesh_.file.only_here.push_back(counted(targets_, "morph target"));
    std::vector<std::string>& notes = mesh_.file.notes;
    if (layout_.passed_over > 0)
        notes.push_back(
            fmt::format("{} of its parts are points or lines, not triangles: passed over", layout_.passed_over));
    if (more_texcoords_)
        notes.push_back(fmt::format("it has more than {} sets of texture coordinates: the others are passed over",
                                    most_texcoord_sets));
    if (skinned_) notes.emplace_back("its skin is read in its rest pose, as a viewer shows it without an animation");
    if (weighted_) notes.emplace_back("its morph targets are read with the file's default weights, not with 0");
}

} // namespace

PolygonMesh read_gltf(std::string_view bytes, const std::filesystem::path& path) {
    try {
        return GltfReader(bytes, path).read();
    } catch (const json::exception&) {
        bad_file(path, "is damaged: a value in its JSON is missing or of another type than glTF wants");
    }
}

} // namespace meshtween
