#include "frame.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/weld.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace meshtween::studio {
namespace {

static_assert(std::endian::native == std::endian::little, "buffers go out as they lie in memory");

template <typename Value>
std::string bytes(Eigen::Index count, const auto& value_at) {
    std::string text(static_cast<std::size_t>(count) * sizeof(Value), '\0');
    auto* out = reinterpret_cast<Value*>(text.data());
    for (Eigen::Index i = 0; i < count; ++i) out[i] = value_at(i);
    return text;
}

Frame frame_of(const Eigen::AlignedBox3d& box) {
    if (box.isEmpty()) return {};
    const double length = box.diagonal().norm();
    return {box.center().transpose(), length > 0 ? length : 1};
}

} // namespace

Frame frame_of(const Mesh& mesh) {
    return frame_of(bounding_box(mesh.positions, mesh.triangles));
}

Frame frame_of(const Mesh& mesh, const Mesh& other) {
    return frame_of(
        bounding_box(mesh.positions, mesh.triangles).merged(bounding_box(other.positions, other.triangles)));
}

Json to_json(const Frame& frame) {
    return {{"centre", {frame.centre[0], frame.centre[1], frame.centre[2]}}, {"scale", frame.scale}};
}

std::string position_bytes(const Points& positions, const Frame& frame) {
    const double* in = positions.data();
    return bytes<float>(positions.size(),
                        [&](Eigen::Index i) { return float((in[i] - frame.centre[i % 3]) / frame.scale); });
}

std::string normal_bytes(const Points& positions, const Triangles& triangles) {
    return direction_bytes(vertex_normals(positions, triangles, weld({positions, triangles, {}, {}, {}})));
}

std::string direction_bytes(const Points& directions) {
    return bytes<std::int16_t>(4 * directions.rows(), [&](Eigen::Index i) {
        return i % 4 == 3 ? std::int16_t(0) : std::int16_t(std::lround(32767 * directions(i / 4, i % 4)));
    });
}

std::string index_bytes(const Triangles& triangles) {
    return bytes<std::uint32_t>(triangles.size(),
                                [&](Eigen::Index i) { return static_cast<std::uint32_t>(triangles.data()[i]); });
}

std::string color_bytes(const Colors& colors) {
    return bytes<std::uint8_t>(colors.size(), [&](Eigen::Index i) {
        return static_cast<std::uint8_t>(std::lround(255 * std::clamp(colors.data()[i], 0.0F, 1.0F)));
    });
}

std::string value_bytes(const Eigen::VectorXd& values) {
    return bytes<float>(values.size(), [&](Eigen::Index i) { return float(values[i]); });
}

std::string corner_uv_bytes(const Mesh& mesh) {
    return bytes<float>(2 * mesh.texcoord_triangles.size(),
                        [&](Eigen::Index i) { return mesh.texcoords(mesh.texcoord_triangles.data()[i / 2], i % 2); });
}

} // namespace meshtween::studio
