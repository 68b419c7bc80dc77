// PLY: the mesh's own file with other positions, or a new one in binary: double coordinates, colours as bytes, texture
// coordinates a vertex as s and t, or a corner as MeshLab's face property where seams need it.
#include "meshtween/io/companions.h"
#include "meshtween/io/formats.h"
#include "meshtween/io/output.h"
#include "meshtween/io/ply.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>

namespace meshtween {
namespace {

static_assert(std::endian::native == std::endian::little, "written as memory has it");

class Bytes {
public:
    explicit Bytes(std::ostream& stream) : stream_(stream) {}
    Bytes(const Bytes&) = delete;
    Bytes& operator=(const Bytes&) = delete;
    ~Bytes() { stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size())); }

    template <typename Number>
    void put(Number value) {
        char raw[sizeof value];
        std::memcpy(raw, &value, sizeof value);
        buffer_.append(raw, sizeof value);
        if (buffer_.size() < 1 << 16) return;
        stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
        buffer_.clear();
    }

private:
    std::ostream& stream_;
    std::string buffer_;
};

// The texture coordinate of each vertex; empty where a vertex has two, on a seam.
std::vector<int> vertex_texcoords(const Mesh& mesh) {
    std::vector<int> result(static_cast<std::size_t>(mesh.positions.rows()), -1);
    for (Eigen::Index i = 0; i < mesh.texcoord_triangles.size(); ++i) {
        int& known = result[static_cast<std::size_t>(mesh.triangles.data()[i])];
        const int index = mesh.texcoord_triangles.data()[i];
        if (known >= 0 && mesh.texcoords.row(known) != mesh.texcoords.row(index)) return {};
        known = index;
    }
    return result;
}

// Readers know colours by their bytes: MeshLab and CloudCompare take floats for something else.
std::uint8_t byte_of(float color) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(color, 0.0F, 1.0F)));
}

// The one normal of each vertex; empty where a vertex has two or the file has none.
std::vector<int> vertex_normals(const WrittenPolygons& polygons, Eigen::Index vertices) {
    if (polygons.normal_corners.empty()) return {};
    std::vector<int> result(static_cast<std::size_t>(vertices), -1);
    for (std::size_t c = 0; c < polygons.corners.size(); ++c) {
        int& known = result[static_cast<std::size_t>(polygons.corners[c])];
        const int index = polygons.normal_corners[c];
        if (known >= 0 && known != index) return {};
        known = index;
    }
    return result;
}

// What is written of a mesh, decided.
struct PlyWork {
    const Mesh& mesh;
    WrittenPolygons polygons = written_polygons(mesh);
    bool colored = mesh.colors.rows() > 0, textured = mesh.texcoords.rows() > 0;
    std::vector<int> texcoord = textured ? vertex_texcoords(mesh) : std::vector<int>();
    bool seamless = textured && !texcoord.empty();
    std::vector<int> normal = vertex_normals(polygons, mesh.positions.rows());
    std::vector<std::string> textures = {};
    bool wide = false; // polygons of more than 127 corners, whose 254 texture coordinates a byte just counts

    explicit PlyWork(const Mesh& given) : mesh(given) {
        for (std::size_t p = 0; p < polygons.ends.size(); ++p)
            wide = wide || polygons.ends[p] - polygons.begin(p) > 127;
    }
    int texture_of(std::size_t polygon) const {
        const int material = mesh.file->polygon_materials[polygon];
        const int image = material < 0 ? -1 : mesh.file->materials[static_cast<std::size_t>(material)].base_color_image;
        return std::max(image, 0);
    }
    bool has_texture_numbers() const {
        return textures.size() > 1 && mesh.file->polygon_materials.size() == polygons.ends.size();
    }
};

void put_header(const PlyWork& work, std::ostream& stream) {
    stream << "ply\nformat binary_little_endian 1.0\ncomment written by meshtween\n";
    for (const std::string& name : work.textures) stream << fmt::format("comment TextureFile {}\n", name);
    stream << fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n",
                          work.mesh.positions.rows());
    for (const char* name : {"nx", "ny", "nz"})
        if (!work.normal.empty()) stream << fmt::format("property float {}\n", name);
    for (const char* channel : {"red", "green", "blue", "alpha"})
        if (work.colored) stream << fmt::format("property uchar {}\n", channel);
    if (work.seamless) stream << "property float s\nproperty float t\n";
    stream << fmt::format("element face {}\nproperty list {} int vertex_indices\n", work.polygons.ends.size(),
                          work.wide ? "int" : "uchar");
    if (work.textured && !work.seamless)
        stream << fmt::format("property list {} float texcoord\n", work.wide ? "int" : "uchar");
    if (work.has_texture_numbers()) stream << "property int texnumber\n";
    stream << "end_header\n";
}

void put_vertices(const PlyWork& work, Bytes& out) {
    const Mesh& mesh = work.mesh;
    for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
        const auto v = static_cast<std::size_t>(i);
        for (int k = 0; k < 3; ++k) out.put(mesh.positions(i, k));
        for (int k = 0; k < 3 && !work.normal.empty(); ++k)
            out.put(work.normal[v] < 0 ? 0.0F : static_cast<float>(work.polygons.normals(work.normal[v], k)));
        for (int k = 0; k < 4 && work.colored; ++k) out.put(byte_of(mesh.colors(i, k)));
        for (int k = 0; k < 2 && work.seamless; ++k)
            out.put(work.texcoord[v] < 0 ? 0.0F : mesh.texcoords(work.texcoord[v], k));
    }
}

void put_faces(const PlyWork& work, Bytes& out) {
    const Mesh& mesh = work.mesh;
    const auto put_count = [&](int count) { work.wide ? out.put(count) : out.put(static_cast<std::uint8_t>(count)); };
    const WrittenPolygons& polygons = work.polygons;
    for (std::size_t p = 0; p < polygons.ends.size(); ++p) {
        const auto begin = static_cast<std::size_t>(polygons.begin(p)),
                   end = static_cast<std::size_t>(polygons.ends[p]);
        put_count(static_cast<int>(end - begin));
        for (std::size_t c = begin; c < end; ++c) out.put(polygons.corners[c]);
        if (work.textured && !work.seamless) {
            put_count(static_cast<int>(2 * (end - begin)));
            for (std::size_t c = begin; c < end; ++c)
                for (int k = 0; k < 2; ++k) out.put(mesh.texcoords(polygons.texcoord_corners[c], k));
        }
        if (work.has_texture_numbers()) out.put(work.texture_of(p));
    }
}

void write_new(const PlyWork& work, std::ostream& stream) {
    put_header(work, stream);
    Bytes out(stream);
    put_vertices(work, out);
    put_faces(work, out);
}

} // namespace

std::vector<std::string> write_ply(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions& options) {
    std::vector<std::string> notes;
    if (is_rewritable(mesh, ".ply")) {
        const PlyHeader header = read_ply_header(mesh.file->bytes, mesh.file->path);
        if (!has_whole_coordinates(header)) {
            const Move move = move_to(path, mesh.file->path, options, notes);
            write_whole(path, [&](std::ostream& stream) { rewrite_ply(mesh, header, move, stream); });
            return notes;
        }
        notes.push_back(fmt::format("{}: the coordinates of {} are whole numbers, which cannot hold another shape; "
                                    "written anew",
                                    path.string(), mesh.file->path.string()));
    }
    PlyWork work(mesh);
    if (work.textured && is_described(mesh)) {
        const Move move = move_to(path, mesh.file->path, options, notes);
        for (std::size_t i = 0; i < mesh.file->images.size(); ++i) {
            const std::string name = carry_image(move, mesh.file->images[i], i);
            if (!name.empty()) work.textures.push_back(name);
        }
        if (work.textures.size() != mesh.file->images.size()) work.textures.clear(); // numbers would be wrong
    }
    if (work.normal.empty() && !work.polygons.normal_corners.empty())
        notes.push_back(fmt::format("{}: left behind normals, of which vertices have several; write .obj to keep them",
                                    path.string()));
    write_whole(path, [&](std::ostream& stream) { write_new(work, stream); });
    return notes;
}

} // namespace meshtween
