// glTF 2.0 specification (Khronos, 2021), 3.9.2: base colour = factor times picture times vertex colour, in linear
// light.
#include "meshtween/fit/appearance.h"

#include "meshtween/core/color.h"
#include "meshtween/core/error.h"

#include <array>
#include <cmath>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

const std::array<float, 256>& linear_of_byte() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> t{};
        for (std::size_t i = 0; i < 256; ++i) t[i] = linear_from_srgb(static_cast<float>(i) / 255);
        return t;
    }();
    return table;
}

Eigen::Vector3f pixel(const Image& image, int x, int y) {
    const std::uint8_t* p = image.rgb.data() + 3 * (std::ptrdiff_t(y) * image.width + x);
    const auto& linear = linear_of_byte();
    return {linear[p[0]], linear[p[1]], linear[p[2]]};
}

// The whole pixel at or before x, which counts from pixels' middles, and the one after it, of a picture that repeats.
struct Neighbours {
    int first = 0, second = 0;
    float share = 0; // of the second
};

Neighbours around(double x, int size) {
    if (!(std::abs(x) < 1e12)) return {}; // no number, or one whose pixel rounding hides
    const double down = std::floor(x);
    const auto first = static_cast<int>(down - std::floor(down / size) * size) % size;
    return {first, (first + 1) % size, static_cast<float>(x - down)};
}

Eigen::Vector3f bilinear(const Image& image, double u, double v) {
    const Neighbours x = around(u * image.width - 0.5, image.width);
    const Neighbours y = around((1 - v) * image.height - 0.5, image.height);
    const auto row = [&](int at) -> Eigen::Vector3f {
        return (1 - x.share) * pixel(image, x.first, at) + x.share * pixel(image, x.second, at);
    };
    return (1 - y.share) * row(y.first) + y.share * row(y.second);
}

} // namespace

Appearance::Appearance(const Mesh& mesh) : mesh_(&mesh) {
    if (!mesh.file || mesh.file->polygon_materials.empty() || mesh.file->cut.rows() != mesh.triangles.rows()) return;
    const MeshFile& file = *mesh.file;
    multiplied_ = file.format == ".glb" || file.format == ".gltf";
    images_.resize(file.images.size());
    std::vector<char> tried(file.images.size(), 0);
    for (const int polygon : polygon_of_triangles(file)) {
        const int m = polygon < std::ssize(file.polygon_materials) ? file.polygon_materials[idx(polygon)] : -1;
        materials_.push_back(m < std::ssize(file.materials) ? m : -1);
        if (materials_.back() < 0) continue;
        const Material& material = file.materials[idx(m)];
        for (std::size_t c = 0; c < 3; ++c) tinted_ = tinted_ || material.base_color[c] != 1;
        const int i = material.base_color_image;
        if (i < 0 || i >= std::ssize(file.images) || tried[idx(i)] != 0 || mesh.texcoords.rows() == 0) continue;
        tried[idx(i)] = 1;
        try {
            images_[idx(i)] = std::make_shared<Image>(read_image(file.images[idx(i)]));
            ++pictures_;
        } catch (const Error& error) {
            problems_.emplace_back(error.what());
        }
    }
}

Appearance::Appearance(const Mesh& mesh, const Appearance& alike) : Appearance(alike) {
    mesh_ = &mesh;
}

Eigen::Vector3f Appearance::vertex_color(int triangle, const Eigen::Vector3f& shares) const {
    Eigen::Vector3f color(0, 0, 0);
    for (int k = 0; k < 3; ++k)
        color += shares[k] * mesh_->colors.row(mesh_->triangles(triangle, k)).head<3>().transpose();
    return color.unaryExpr([](float v) { return linear_from_srgb(std::clamp(v, 0.0F, 1.0F)); });
}

Eigen::Vector3f Appearance::picture_color(const Image& image, int triangle, const Eigen::Vector3f& shares) const {
    double u = 0, v = 0;
    for (int k = 0; k < 3; ++k) {
        const auto uv = mesh_->texcoords.row(mesh_->texcoord_triangles(triangle, k));
        u += double(shares[k]) * double(uv[0]);
        v += double(shares[k]) * double(uv[1]);
    }
    return bilinear(image, u, v);
}

Eigen::Vector3f Appearance::at(int triangle, const Eigen::Vector3f& shares) const {
    const int m = materials_.empty() ? -1 : materials_[idx(triangle)];
    if (m < 0) return has_colors() ? vertex_color(triangle, shares) : plain_color;
    const Material& material = mesh_->file->materials[idx(m)];
    const Eigen::Vector3f factor(material.base_color[0], material.base_color[1], material.base_color[2]);
    const Image* image = material.base_color_image < 0 || material.base_color_image >= std::ssize(images_)
                             ? nullptr
                             : images_[idx(material.base_color_image)].get();
    if (image != nullptr) {
        const Eigen::Vector3f color = factor.cwiseProduct(picture_color(*image, triangle, shares));
        return multiplied_ && has_colors() ? color.cwiseProduct(vertex_color(triangle, shares)) : color;
    }
    if (!has_colors()) return factor;
    return multiplied_ ? factor.cwiseProduct(vertex_color(triangle, shares)) : vertex_color(triangle, shares);
}

} // namespace meshtween
