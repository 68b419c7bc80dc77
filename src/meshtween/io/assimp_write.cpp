// Collada and 3MF through the exporters of the Open Asset Import Library (assimp 5), where that was found when
// this was built. The mesh's vertices come first and in their order; a vertex on a seam of texture coordinates is
// repeated behind all of them, because assimp has one a vertex.
#include "meshtween/core/error.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/formats.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/output.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#ifdef MESHTWEEN_ASSIMP

#include <assimp/Exporter.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <stdlib.h>

#include <memory>

namespace meshtween {
namespace {
namespace fs = std::filesystem;

// The mesh with one texture coordinate a vertex.
struct Unseamed {
    std::vector<int> vertices;  // of the mesh, a written vertex each; the first n are 0 .. n-1
    std::vector<int> texcoords; // a row of the mesh's, or -1
    WrittenPolygons polygons;   // of written vertices
};

Unseamed unseamed(const Mesh& mesh) {
    Unseamed result;
    result.polygons = written_polygons(mesh);
    const auto count = static_cast<std::size_t>(mesh.positions.rows());
    for (std::size_t v = 0; v < count; ++v) result.vertices.push_back(static_cast<int>(v));
    result.texcoords.assign(count, -1);
    if (mesh.texcoords.rows() == 0) return result;
    const std::vector<int>& wanted = result.polygons.texcoord_corners;
    std::vector<int> next(count, -1); // the next copy of the same vertex
    for (std::size_t c = 0; c < wanted.size(); ++c) {
        const int vertex = result.polygons.corners[c];
        auto at = static_cast<std::size_t>(vertex);
        while (result.texcoords[at] >= 0 && mesh.texcoords.row(result.texcoords[at]) != mesh.texcoords.row(wanted[c])) {
            if (next[at] < 0) {
                next[at] = static_cast<int>(result.vertices.size());
                result.vertices.push_back(vertex);
                result.texcoords.push_back(-1);
                next.push_back(-1);
            }
            at = static_cast<std::size_t>(next[at]);
        }
        result.texcoords[at] = wanted[c];
        result.polygons.corners[c] = static_cast<int>(at);
    }
    return result;
}

aiVector3D vector_of(const Point& point) {
    return {static_cast<ai_real>(point[0]), static_cast<ai_real>(point[1]), static_cast<ai_real>(point[2])};
}

// The caller's scene owns it.
aiMesh* part_of_scene(const Mesh& mesh, const Unseamed& written) {
    auto part = std::make_unique<aiMesh>();
    const auto count = static_cast<unsigned>(written.vertices.size());
    const Points normals = vertex_normals(mesh.positions, mesh.triangles);
    part->mNumVertices = count;
    part->mVertices = new aiVector3D[count];
    part->mNormals = new aiVector3D[count];
    if (mesh.texcoords.rows() > 0) {
        part->mTextureCoords[0] = new aiVector3D[count];
        part->mNumUVComponents[0] = 2;
    }
    if (mesh.colors.rows() > 0) part->mColors[0] = new aiColor4D[count];
    for (unsigned i = 0; i < count; ++i) {
        const int vertex = written.vertices[i], uv = written.texcoords[i];
        part->mVertices[i] = vector_of(mesh.positions.row(vertex));
        part->mNormals[i] = vector_of(normals.row(vertex));
        if (mesh.texcoords.rows() > 0 && uv >= 0)
            part->mTextureCoords[0][i] = {mesh.texcoords(uv, 0), mesh.texcoords(uv, 1), 0};
        if (mesh.colors.rows() > 0)
            part->mColors[0][i] = {mesh.colors(vertex, 0), mesh.colors(vertex, 1), mesh.colors(vertex, 2),
                                   mesh.colors(vertex, 3)};
    }
    part->mNumFaces = static_cast<unsigned>(written.polygons.ends.size());
    part->mFaces = new aiFace[part->mNumFaces];
    int begin = 0;
    for (unsigned f = 0; f < part->mNumFaces; ++f) {
        aiFace& face = part->mFaces[f];
        const int end = written.polygons.ends[f];
        face.mNumIndices = static_cast<unsigned>(end - begin);
        face.mIndices = new unsigned[face.mNumIndices];
        for (unsigned k = 0; begin < end; ++begin)
            face.mIndices[k++] = static_cast<unsigned>(written.polygons.corners[static_cast<std::size_t>(begin)]);
        part->mPrimitiveTypes |= face.mNumIndices == 3 ? aiPrimitiveType_TRIANGLE : aiPrimitiveType_POLYGON;
    }
    part->mName = "surface";
    return part.release();
}

std::unique_ptr<aiScene> scene_of(const Mesh& mesh, const Unseamed& written) {
    auto scene = std::make_unique<aiScene>();
    scene->mNumMeshes = scene->mNumMaterials = 1;
    scene->mMeshes = new aiMesh* [1] { part_of_scene(mesh, written) };
    scene->mMaterials = new aiMaterial* [1] { new aiMaterial };
    const aiString name("surface");
    const aiColor4D color(0.7F, 0.625F, 0.555F, 1);
    scene->mMaterials[0]->AddProperty(&name, AI_MATKEY_NAME);
    scene->mMaterials[0]->AddProperty(&color, 1, AI_MATKEY_COLOR_DIFFUSE);
    auto* const object = new aiNode("surface"); // below the root, where the exporters look
    object->mNumMeshes = 1;
    object->mMeshes = new unsigned[1]{0};
    scene->mRootNode = new aiNode("model");
    scene->mRootNode->addChildren(1, const_cast<aiNode**>(&object));
    return scene;
}

// assimp writes to names alone: a folder of its own, from which the file is taken whole.
struct TemporaryFolder {
    fs::path path;
    TemporaryFolder() {
        std::string name = (fs::temp_directory_path() / "meshtween-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw Error(ErrorKind::file, fmt::format("cannot make a folder in {}", fs::temp_directory_path().string()));
        path = name;
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
};

std::vector<std::string> write_assimp(const Mesh& mesh, const fs::path& path, const std::string& format) {
    Mesh held{mesh.positions, mesh.triangles, {}, {}, {}, {}}; // by 3MF
    if (format != "3mf") held = mesh;
    const std::unique_ptr<aiScene> scene = scene_of(held, unseamed(held));
    const TemporaryFolder folder;
    const fs::path made = folder.path / ("model." + format);
    Assimp::Exporter exporter;
    if (exporter.Export(scene.get(), format == "dae" ? "collada" : format, made.string()) != aiReturn_SUCCESS)
        throw Error(ErrorKind::file,
                    fmt::format("cannot write {}: assimp says: {}", path.string(), exporter.GetErrorString()));
    write_whole(path, read_whole(made));
    return {fmt::format("{}: written by assimp as floats; other programs may number its vertices anew", path.string())};
}

} // namespace

void require_assimp(const std::filesystem::path&) {}

} // namespace meshtween

#else

namespace meshtween {
namespace {

std::vector<std::string> write_assimp(const Mesh&, const std::filesystem::path& path, const std::string&) {
    require_assimp(path);
    return {};
}

} // namespace

void require_assimp(const std::filesystem::path& path) {
    throw Error(ErrorKind::argument, fmt::format("{}: {} is written through the library assimp, which was missing when "
                                                 "this program was built; build it again with libassimp-dev, or write "
                                                 ".glb or .obj",
                                                 path.string(), path.extension().string()));
}

} // namespace meshtween

#endif

namespace meshtween {

std::vector<std::string> write_dae(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions&) {
    return write_assimp(mesh, path, "dae");
}

std::vector<std::string> write_3mf(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions&) {
    return write_assimp(mesh, path, "3mf");
}

} // namespace meshtween
