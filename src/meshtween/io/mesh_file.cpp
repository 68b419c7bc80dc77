#include "meshtween/io/mesh_file.h"

#include "meshtween/io/file_normals.h"
#include "meshtween/io/formats.h"
#include "meshtween/io/text.h"

#include <algorithm>
#include <cstring>

namespace meshtween {

std::vector<int> polygon_of_triangles(const MeshFile& file) {
    std::vector<int> result;
    result.reserve(static_cast<std::size_t>(file.cut.rows()));
    for (Eigen::Index t = 0; t < file.cut.rows(); ++t) {
        const auto end = std::upper_bound(file.ends.begin(), file.ends.end(), file.cut(t, 0));
        result.push_back(static_cast<int>(end - file.ends.begin()));
    }
    return result;
}

namespace {

// FNV-1a over words: a check of what was read against itself, not against forgers.
std::uint64_t mixed(std::uint64_t key, const void* data, std::size_t size) {
    const char* at = static_cast<const char*>(data);
    for (std::uint64_t word = 0; size > 0;) {
        const std::size_t take = std::min(size, sizeof word);
        word = 0;
        std::memcpy(&word, at, take);
        key = (key ^ word) * 0x100000001B3U;
        key ^= key >> 32;
        at += take;
        size -= take;
    }
    return key;
}

template <typename Matrix>
std::uint64_t mixed(std::uint64_t key, const Matrix& matrix) {
    const Eigen::Index rows = matrix.rows();
    return mixed(mixed(key, &rows, sizeof rows), matrix.data(),
                 static_cast<std::size_t>(matrix.size()) * sizeof(typename Matrix::Scalar));
}

} // namespace

std::uint64_t attributes_key(const Mesh& mesh) {
    return mixed(mixed(mixed(0xCBF29CE484222325U, mesh.texcoords), mesh.texcoord_triangles), mesh.colors);
}

std::uint64_t shape_key(const Mesh& mesh) {
    return mixed(0xCBF29CE484222325U, mesh.positions);
}

bool is_described(const Mesh& mesh) {
    if (!mesh.file) return false;
    const MeshFile& file = *mesh.file;
    if (mesh.positions.rows() != file.vertices || mesh.triangles.rows() != file.cut.rows()) return false;
    for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i)
        if (mesh.triangles.data()[i] != file.corners[static_cast<std::size_t>(file.cut.data()[i])]) return false;
    return true;
}

std::vector<std::string> not_kept(const Mesh& mesh, const FormatKeeps& keeps) {
    std::vector<std::string> lost;
    if (!keeps.texcoords && mesh.texcoords.rows() > 0) lost.emplace_back("texture coordinates");
    if (!keeps.colors && mesh.colors.rows() > 0) lost.emplace_back("vertex colours");
    if (!mesh.file) return lost;
    const MeshFile& file = *mesh.file;
    const auto lose = [&](bool kept, std::size_t count, std::string_view noun) {
        if (!kept && count > 0) lost.push_back(counted(count, noun));
    };
    std::size_t large = 0;
    for (std::size_t p = 0; p < file.ends.size(); ++p) large += file.ends[p] - (p > 0 ? file.ends[p - 1] : 0) > 3;
    if (!keeps.polygons && large > 0) lost.push_back(counted(large, "polygon") + " of more than three corners");
    if (!keeps.more_texcoords && !file.more_texcoords.empty())
        lost.push_back(counted(file.more_texcoords.size(), "further set") + " of texture coordinates");
    lose(keeps.objects, file.objects.names.size(), "object");
    lose(keeps.groups, file.groups.names.size(), "group");
    lose(keeps.smoothing, file.smoothing.names.size(), "smoothing group");
    lose(keeps.materials, file.materials.size(), "material");
    lose(keeps.images, file.images.size(), "texture");
    lost.insert(lost.end(), file.only_here.begin(), file.only_here.end());
    return lost;
}

bool is_rewritable(const Mesh& mesh, std::string_view format) {
    return mesh.file && mesh.file->format == format && !mesh.file->bytes.empty() && is_described(mesh) &&
           attributes_key(mesh) == mesh.file->attributes;
}

namespace {

WrittenPolygons triangles_of(const Mesh& mesh) {
    WrittenPolygons result;
    result.corners.assign(mesh.triangles.data(), mesh.triangles.data() + mesh.triangles.size());
    for (Eigen::Index t = 1; t <= mesh.triangles.rows(); ++t) result.ends.push_back(static_cast<int>(3 * t));
    if (mesh.texcoords.rows() > 0)
        result.texcoord_corners.assign(mesh.texcoord_triangles.data(),
                                       mesh.texcoord_triangles.data() + mesh.texcoord_triangles.size());
    return result;
}

// Corners that were passed over in the cutting name the vertex of a neighbour, and take its texture coordinate.
std::vector<int> texcoords_of_corners(const Mesh& mesh) {
    const MeshFile& file = *mesh.file;
    std::vector<int> result(file.corners.size(), -1);
    for (Eigen::Index i = 0; i < file.cut.size(); ++i)
        result[static_cast<std::size_t>(file.cut.data()[i])] = mesh.texcoord_triangles.data()[i];
    for (std::size_t p = 0, begin = 0; p < file.ends.size(); ++p) {
        const auto end = static_cast<std::size_t>(file.ends[p]);
        int last = -1;
        for (std::size_t c = end; c-- > begin && last < 0;) last = result[c];
        for (std::size_t c = begin; c < end; ++c) last = result[c] = result[c] < 0 ? last : result[c];
        begin = end;
    }
    return result;
}

} // namespace

WrittenPolygons written_polygons(const Mesh& mesh) {
    if (!is_described(mesh)) return triangles_of(mesh);
    const MeshFile& file = *mesh.file;
    WrittenPolygons result;
    result.corners = file.corners;
    result.ends = file.ends;
    if (mesh.texcoords.rows() > 0) result.texcoord_corners = texcoords_of_corners(mesh);
    if (file.normals.rows() > 0) {
        result.normals = shape_key(mesh) == file.shape ? file.normals : file_normals(mesh);
        result.normal_corners = file.normal_corners;
    }
    return result;
}

} // namespace meshtween
