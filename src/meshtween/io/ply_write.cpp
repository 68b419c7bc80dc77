// PLY in binary: double coordinates, colours as bytes where they came from bytes, texture coordinates a vertex as s and
// t, or a corner as MeshLab's face property where seams need it.
#include "meshtween/io/formats.h"
#include "meshtween/io/output.h"

#include <fmt/format.h>

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

std::uint8_t byte_of(float color) {
    return static_cast<std::uint8_t>(std::lround(color * 255));
}

bool fits_bytes(const Colors& colors) {
    for (Eigen::Index i = 0; i < colors.size(); ++i)
        if (!(colors.data()[i] >= 0 && colors.data()[i] <= 1) ||
            static_cast<float>(byte_of(colors.data()[i])) / 255 != colors.data()[i])
            return false;
    return true;
}

} // namespace

namespace {

void write_new(const Mesh& mesh, std::ostream& stream) {
    const bool colored = mesh.colors.rows() > 0, bytes = fits_bytes(mesh.colors), textured = mesh.texcoords.rows() > 0;
    const std::vector<int> texcoord = textured ? vertex_texcoords(mesh) : std::vector<int>();
    const bool seamless = textured && !texcoord.empty();
    stream << "ply\nformat binary_little_endian 1.0\ncomment written by meshtween\n"
           << fmt::format("element vertex {}\nproperty double x\nproperty double y\nproperty double z\n",
                          mesh.positions.rows());
    for (const char* channel : {"red", "green", "blue", "alpha"})
        if (colored) stream << fmt::format("property {} {}\n", bytes ? "uchar" : "float", channel);
    if (seamless) stream << "property float s\nproperty float t\n";
    stream << fmt::format("element face {}\nproperty list uchar int vertex_indices\n", mesh.triangles.rows());
    if (textured && !seamless) stream << "property list uchar float texcoord\n";
    stream << "end_header\n";

    Bytes out(stream);
    for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
        for (int k = 0; k < 3; ++k) out.put(mesh.positions(i, k));
        for (int k = 0; k < 4 && colored; ++k)
            if (bytes)
                out.put(byte_of(mesh.colors(i, k)));
            else
                out.put(mesh.colors(i, k));
        for (int k = 0; k < 2 && seamless; ++k) {
            const int index = texcoord[static_cast<std::size_t>(i)];
            out.put(index < 0 ? 0.0F : mesh.texcoords(index, k));
        }
    }
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
        out.put(std::uint8_t{3});
        for (int k = 0; k < 3; ++k) out.put(mesh.triangles(t, k));
        if (!textured || seamless) continue;
        out.put(std::uint8_t{6});
        for (int k = 0; k < 3; ++k)
            for (int c = 0; c < 2; ++c) out.put(mesh.texcoords(mesh.texcoord_triangles(t, k), c));
    }
}

} // namespace

std::vector<std::string> write_ply(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions&) {
    write_whole(path, [&](std::ostream& stream) { write_new(mesh, stream); });
    return {};
}

} // namespace meshtween
