// FBX, Collada and 3MF through the Open Asset Import Library (assimp 5), where that was found when this was built. It
// reads FBX and Collada without the file's own numbering: a vertex a corner. Vertices of one object that lie in one
// place are joined again, in order of their first use; texture coordinates and normals stay with the corners.
#include "meshtween/core/error.h"
#include "meshtween/io/formats.h"
#include "meshtween/io/text.h"

#include <Eigen/LU>
#include <fmt/format.h>

#ifdef MESHTWEEN_ASSIMP

#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace meshtween {
namespace {

using Matrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

Matrix matrix_of(const aiMatrix4x4& m) {
    Matrix result;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) result(r, c) = static_cast<double>(m[static_cast<unsigned>(r)][c]);
    return result;
}

std::string text_of(const aiString& text) {
    return {text.data, text.length};
}

class SceneReader {
public:
    SceneReader(const aiScene& scene, const std::filesystem::path& path) : scene_(scene), path_(path) {}

    PolygonMesh read() {
        read_materials();
        if (scene_.mRootNode != nullptr) read_node(*scene_.mRootNode, Matrix::Identity(), 0);
        finish();
        tell();
        return std::move(mesh_);
    }

private:
    void read_materials() {
        for (unsigned i = 0; i < scene_.mNumMaterials; ++i) {
            const aiMaterial& from = *scene_.mMaterials[i];
            Material material;
            aiString name;
            if (from.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) material.name = text_of(name);
            aiColor4D color;
            if (from.Get(AI_MATKEY_COLOR_DIFFUSE, color) == aiReturn_SUCCESS)
                material.base_color = {color.r, color.g, color.b, 1};
            aiString picture;
            if (from.GetTexture(aiTextureType_DIFFUSE, 0, &picture) == aiReturn_SUCCESS)
                material.base_color_image = image(text_of(picture));
            mesh_.file.materials.push_back(std::move(material));
        }
    }

    // The number of the picture with this name, a file's or one inside the scene.
    int image(const std::string& name) {
        TextureImage found;
        found.name = std::filesystem::path(name).filename().string();
        if (const aiTexture* inside = scene_.GetEmbeddedTexture(name.c_str());
            inside != nullptr && inside->mHeight == 0) { // encoded; of a known size otherwise
            found.bytes.assign(reinterpret_cast<const char*>(inside->pcData), inside->mWidth);
            found.mime = std::string_view(inside->achFormatHint) == "jpg" ? "image/jpeg" : "image/png";
        } else {
            std::string file = name;
            std::replace(file.begin(), file.end(), '\\', '/');
            found.path = path_.parent_path() / file;
            std::error_code missing; // paths of the machine that wrote the file: the picture lies beside it now
            if (!std::filesystem::exists(found.path, missing))
                found.path = path_.parent_path() / std::filesystem::path(file).filename();
        }
        mesh_.file.images.push_back(std::move(found));
        return static_cast<int>(mesh_.file.images.size()) - 1;
    }

    void read_node(const aiNode& node, const Matrix& parent, int depth) {
        constexpr int deepest = 1000;
        if (depth > deepest) bad_file(path_, "its objects are nested too deeply; the file is damaged");
        const Matrix place = parent * matrix_of(node.mTransformation);
        places_.clear(); // vertices are joined within an object
        if (node.mNumMeshes > 0) mesh_.file.objects.names.push_back(text_of(node.mName));
        for (unsigned i = 0; i < node.mNumMeshes; ++i) read_part(*scene_.mMeshes[node.mMeshes[i]], place);
        for (unsigned i = 0; i < node.mNumChildren; ++i) read_node(*node.mChildren[i], place, depth + 1);
    }

    void read_part(const aiMesh& part, const Matrix& place) {
        std::size_t corners = 0;
        for (unsigned f = 0; f < part.mNumFaces; ++f) corners += part.mFaces[f].mNumIndices;
        const bool unshared = corners == part.mNumVertices; // a vertex a corner: no numbering of the file's own
        joined_ = joined_ || unshared;
        skins_ += part.HasBones();
        shapes_ += part.mNumAnimMeshes;
        const std::size_t row = normal_rows_.size() / 3;
        const bool mirrored = place.topLeftCorner<3, 3>().determinant() < 0;
        std::vector<int> vertices(part.mNumVertices);
        for (unsigned v = 0; v < part.mNumVertices; ++v) vertices[v] = vertex(part, v, place, unshared);
        read_values(part, place);
        for (unsigned f = 0; f < part.mNumFaces; ++f) {
            const aiFace& face = part.mFaces[f];
            if (face.mNumIndices < 3) {
                ++loose_;
                continue;
            }
            for (unsigned k = 0; k < face.mNumIndices; ++k) {
                const unsigned v = face.mIndices[mirrored ? face.mNumIndices - 1 - k : k];
                if (v >= part.mNumVertices)
                    bad_file(path_, fmt::format("a face names vertex {}, but there are {}", v, part.mNumVertices));
                mesh_.corners.push_back(vertices[v]);
                rows_.push_back(static_cast<int>(row + v));
            }
            mesh_.end_polygon();
            mesh_.file.polygon_materials.push_back(static_cast<int>(part.mMaterialIndex));
            mesh_.file.objects.of.push_back(static_cast<int>(mesh_.file.objects.names.size()) - 1);
        }
    }

    int vertex(const aiMesh& part, unsigned v, const Matrix& place, bool unshared) {
        const aiVector3D& at = part.mVertices[v];
        const int next = static_cast<int>(mesh_.coordinates.size() / 3);
        if (unshared) {
            const auto [known, fresh] = places_.emplace(std::array{at.x + 0, at.y + 0, at.z + 0}, next); // -0 is 0
            if (!fresh) return known->second;
        }
        const Eigen::Vector4d world = place * Eigen::Vector4d(at.x, at.y, at.z, 1);
        mesh_.coordinates.insert(mesh_.coordinates.end(), {world[0], world[1], world[2]});
        const aiColor4D color = part.HasVertexColors(0) ? part.mColors[0][v] : aiColor4D(1, 1, 1, 1);
        colored_ = colored_ || part.HasVertexColors(0);
        mesh_.colors.insert(mesh_.colors.end(), {color.r, color.g, color.b, color.a});
        return next;
    }

    // Normals and texture coordinates of each of the part's vertices.
    void read_values(const aiMesh& part, const Matrix& place) {
        const Eigen::Matrix3d turn = place.topLeftCorner<3, 3>().inverse().transpose();
        normals_ = normals_ || part.HasNormals();
        textured_ = textured_ || part.HasTextureCoords(0);
        for (unsigned v = 0; v < part.mNumVertices; ++v) {
            Eigen::Vector3d normal(0, 0, 0);
            if (part.HasNormals()) {
                const aiVector3D& n = part.mNormals[v];
                normal = (turn * Eigen::Vector3d(n.x, n.y, n.z)).normalized();
            }
            if (!normal.allFinite()) normal.setZero();
            normal_rows_.insert(normal_rows_.end(), {normal[0], normal[1], normal[2]});
            const aiVector3D uv = part.HasTextureCoords(0) ? part.mTextureCoords[0][v] : aiVector3D(0, 0, 0);
            mesh_.texcoords.push_back(std::isfinite(uv.x) ? uv.x : 0);
            mesh_.texcoords.push_back(std::isfinite(uv.y) ? uv.y : 0);
        }
    }

    void finish() {
        if (!colored_) mesh_.colors.clear();
        normalise_colors(mesh_.colors);
        if (textured_) {
            std::vector<float> wedges;
            for (const int row : rows_)
                for (int k = 0; k < 2; ++k)
                    wedges.push_back(mesh_.texcoords[2 * static_cast<std::size_t>(row) + static_cast<std::size_t>(k)]);
            mesh_.texcoords.clear();
            share_texcoords(mesh_, wedges);
        } else {
            mesh_.texcoords.clear();
        }
        if (!normals_) return;
        mesh_.file.normals =
            Eigen::Map<const Points>(normal_rows_.data(), static_cast<Eigen::Index>(normal_rows_.size() / 3), 3);
        mesh_.file.normal_corners = rows_;
    }

    void tell() {
        std::vector<std::string>& notes = mesh_.file.notes;
        if (joined_)
            notes.emplace_back("vertices of an object that lie in one place were joined and are numbered in order of "
                               "their first use: assimp, which reads this format, does not tell the file's own order");
        if (loose_ > 0) notes.push_back(fmt::format("{} points and lines beside the surface were passed over", loose_));
        if (skins_ > 0) notes.emplace_back("skins are taken in their rest pose");
        if (shapes_ > 0) notes.push_back(fmt::format("{} shape keys were passed over", shapes_));
        if (scene_.mNumAnimations > 0)
            notes.push_back(fmt::format("{} animations were passed over", scene_.mNumAnimations));
    }

    const aiScene& scene_;
    std::filesystem::path path_;
    PolygonMesh mesh_;
    std::map<std::array<ai_real, 3>, int> places_; // of the object's vertices
    std::vector<int> rows_;                        // beside the corners: a row of normals and texture coordinates
    std::vector<double> normal_rows_;
    bool joined_ = false, colored_ = false, normals_ = false, textured_ = false;
    unsigned loose_ = 0, skins_ = 0, shapes_ = 0;
};

} // namespace

PolygonMesh read_assimp(std::string_view bytes, const std::filesystem::path& path) {
    Assimp::Importer importer;
    const std::string hint = path.extension().string().substr(1);
    const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, hint.c_str());
    if (scene == nullptr)
        bad_file(path,
                 fmt::format("assimp, which reads this format, says: {}; the file is damaged, or of a kind that it "
                             "does not know: save it as .glb or .obj",
                             importer.GetErrorString()));
    return SceneReader(*scene, path).read();
}

} // namespace meshtween

#else

namespace meshtween {

PolygonMesh read_assimp(std::string_view, const std::filesystem::path& path) {
    bad_file(path, fmt::format("{} is read through the library assimp, which was missing when this program was built; "
                               "build it again with libassimp-dev, or save the model as .glb or .obj",
                               path.extension().string()));
}

} // namespace meshtween

#endif
