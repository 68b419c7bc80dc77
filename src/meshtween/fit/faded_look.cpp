#include "meshtween/fit/faded_look.h"

#include "meshtween/core/color.h"
#include "meshtween/fit/appearance.h"
#include "meshtween/io/mesh_file.h"

#include <algorithm>

namespace meshtween {

bool shows_materials(const Mesh& mesh) {
    if (!mesh.file) return false;
    const auto shows = [&](int m) {
        if (m < 0 || m >= std::ssize(mesh.file->materials)) return false;
        const Material& material = mesh.file->materials[static_cast<std::size_t>(m)];
        return material.base_color_image >= 0 || material.base_color[0] != 1 || material.base_color[1] != 1 ||
               material.base_color[2] != 1;
    };
    return std::ranges::any_of(mesh.file->polygon_materials, shows);
}

Colors linear_colors(const Mesh& mesh) {
    Colors colors(mesh.positions.rows(), 4);
    if (mesh.colors.rows() == 0) {
        colors.rowwise() = Eigen::RowVector4f(plain_color[0], plain_color[1], plain_color[2], 1);
        return colors;
    }
    colors = mesh.colors.cwiseMax(0).cwiseMin(1);
    for (Eigen::Index i = 0; i < colors.rows(); ++i)
        for (int c = 0; c < 3; ++c) colors(i, c) = linear_from_srgb(colors(i, c));
    return colors;
}

Colors plain_colors(Eigen::Index count) {
    Colors colors(count, 4);
    colors.rowwise() = Eigen::RowVector4f(srgb_from_linear(plain_color[0]), srgb_from_linear(plain_color[1]),
                                          srgb_from_linear(plain_color[2]), 1);
    return colors;
}

Mesh faded_look(const Mesh& mesh, const Mesh& other, double u) {
    Mesh result = mesh;
    if (u <= 0) return result;
    const bool materials = shows_materials(mesh) || shows_materials(other);
    if (materials && u < 0.5) return result;
    result.file = other.file;
    result.colors = other.colors;
    if (materials || u >= 1) return result;
    const auto share = static_cast<float>(u);
    result.colors = (1 - share) * linear_colors(mesh) + share * linear_colors(other);
    for (Eigen::Index i = 0; i < result.colors.rows(); ++i)
        for (int c = 0; c < 3; ++c) result.colors(i, c) = srgb_from_linear(result.colors(i, c));
    return result;
}

} // namespace meshtween
