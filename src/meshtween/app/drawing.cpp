#include "meshtween/app/drawing.h"

#include "meshtween/core/color.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

std::uint8_t srgb_byte(float linear_value) {
    const float shown = srgb_from_linear(std::clamp(linear_value, 0.0F, 1.0F));
    return static_cast<std::uint8_t>(std::lround(shown * 255));
}

// Highlights bend towards white instead of breaking off; the lower half stays as it is.
float toned(float v) {
    return v < 0.6F ? v : 0.6F + 0.4F * (1 - std::exp(-(v - 0.6F) / 0.4F));
}

// A place seen in some of a pixel's samples, with the colours of the surface there added up.
struct Fragment {
    SurfaceSpot place;
    Eigen::Vector3f albedo;
    int pixel = 0;
    int samples = 0;
};

Eigen::Vector3f albedo_at(const Dress& dress, int triangle, const Eigen::Vector3f& shares, bool inside) {
    if (inside) return {0.55F, 0.16F, 0.13F};
    const Eigen::Vector3f color = dress.look.at(triangle, shares);
    if (dress.other == nullptr) return color;
    return (1 - dress.faded) * color + dress.faded * dress.other->at(triangle, shares);
}

// The surface under a sample. Normals face the eye; where the triangle itself does not, its inside is seen.
Fragment fragment_at(const Dress& dress, const Shape& shape, const CornerNormals& normals, const Camera& camera,
                     const Samples& samples, std::size_t at) {
    const int t = samples.triangle[at];
    const Eigen::RowVector3i corners = shape.triangles.row(t);
    const Eigen::Vector2f bc = samples.barycentric[at];
    const Eigen::Vector3f shares(1 - bc[0] - bc[1], bc[0], bc[1]);
    Fragment fragment;
    Eigen::Vector3d normal(0, 0, 0), position(0, 0, 0);
    for (int c = 0; c < 3; ++c) {
        position += shares[c] * shape.positions.row(corners[c]).transpose();
        normal += shares[c] * normals.block<1, 3>(t, 3 * c).transpose().cast<double>();
    }
    const Eigen::Vector3d to_eye = (camera.eye() - position).normalized();
    const bool inside = double_area_normal(shape.positions, shape.triangles, t).dot(to_eye.transpose()) < 0;
    if (inside) normal = -normal;
    // A smooth normal may look away near the outline: lean it back to the edge of what can be seen.
    normal.normalize();
    if (const double away = normal.dot(to_eye); away < 0.02) normal = (normal + (0.02 - away) * to_eye).normalized();
    fragment.place = {position, normal};
    fragment.albedo =
        albedo_at(dress, shape.kept.empty() ? t : shape.kept[static_cast<std::size_t>(t)], shares, inside);
    return fragment;
}

// Pixel by pixel what is seen, samples of nearly equal place joined: light is worked out once for them.
std::vector<Fragment> fragments(const Dress& dress, const Shape& shape, const Camera& camera, const Samples& samples) {
    const CornerNormals normals = corner_normals(shape.positions, shape.triangles);
    const int width = samples.width / supersample, height = samples.height / supersample;
    const double close = 3 * supersample / camera.scale;
    std::vector<std::vector<Fragment>> rows(static_cast<std::size_t>(height));
    const auto gather_row = [&](std::ptrdiff_t y) {
        auto& row = rows[static_cast<std::size_t>(y)];
        for (int x = 0; x < width; ++x) {
            const std::size_t first = row.size();
            for (int s = 0; s < supersample * supersample; ++s) {
                const auto at = static_cast<std::size_t>((y * supersample + s / supersample) * samples.width +
                                                         x * supersample + s % supersample);
                if (samples.triangle[at] < 0) continue;
                Fragment found = fragment_at(dress, shape, normals, camera, samples, at);
                const auto same =
                    std::find_if(row.begin() + static_cast<std::ptrdiff_t>(first), row.end(), [&](auto& f) {
                        return f.place.normal.dot(found.place.normal) > 0.98 &&
                               (f.place.position - found.place.position).norm() < close;
                    });
                if (same == row.end()) {
                    found.pixel = static_cast<int>(y) * width + x;
                    found.samples = 1;
                    row.push_back(found);
                } else {
                    same->albedo += found.albedo;
                    ++same->samples;
                }
            }
        }
    };
    parallel_for(height, gather_row, 8);
    std::vector<Fragment> all;
    for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
    return all;
}

// The mean over squares of 2 * radius + 1 pixels, three times over: nearly a Gaussian.
std::vector<float> blurred(std::vector<float> image, int width, int radius) {
    const int height = static_cast<int>(image.size()) / width;
    const auto pass = [&](int lines, int length, int line_step, int step) {
        parallel_for(
            lines,
            [&](std::ptrdiff_t line) {
                float* first = image.data() + line * line_step;
                std::vector<float> sums(static_cast<std::size_t>(length) + 1, 0.0F);
                for (int i = 0; i < length; ++i)
                    sums[static_cast<std::size_t>(i) + 1] = sums[static_cast<std::size_t>(i)] + first[i * step];
                for (int i = 0; i < length; ++i) {
                    const int from = std::max(0, i - radius), to = std::min(length, i + radius + 1);
                    first[i * step] = (sums[static_cast<std::size_t>(to)] - sums[static_cast<std::size_t>(from)]) /
                                      static_cast<float>(to - from);
                }
            },
            16);
    };
    for (int repeat = 0; repeat < 3; ++repeat) {
        pass(height, width, width, 1);
        pass(width, height, 1, width);
    }
    return image;
}

// How dark the shadow on the ground is at each pixel of a tile, 0..1.
std::vector<float> ground_shadow(const Shape& shape, const Layout& layout) {
    const Camera& camera = layout.camera;
    std::vector<SurfaceSpot> places;
    std::vector<int> pixels;
    for (int y = 0; y < layout.height + layout.caption; ++y)
        for (int x = 0; x < layout.width; ++x) {
            // The ray through the pixel, in the camera's axes, meets the ground (y = 0).
            const double sx = ((x + 0.5) * supersample - camera.x) / camera.scale;
            const double sy = (camera.y - (y + 0.5) * supersample) / camera.scale;
            const Eigen::Vector3d ray = camera.axes.transpose() * Eigen::Vector3d(sx, sy, -camera.distance);
            if (ray.y() >= -1e-9 * camera.distance) continue;
            const Eigen::Vector3d ground = camera.eye() - ray * (camera.eye().y() / ray.y());
            if (ground.norm() > camera.distance / eye_distance * 2.5) continue;
            places.push_back({ground, Eigen::Vector3d::UnitY()});
            pixels.push_back(y * layout.width + x);
        }
    const std::size_t pixel_count =
        static_cast<std::size_t>(layout.width) * static_cast<std::size_t>(layout.height + layout.caption);
    std::vector<float> dome(pixel_count, 0.0F), shadow(pixel_count, 0.0F);
    if (places.empty()) return shadow;
    const auto lit = light(places, shape.positions, shape.triangles, camera.axes);
    const Lit open =
        light({{{0, 0, 0}, Eigen::Vector3d::UnitY()}}, Points::Zero(1, 3), Triangles(0, 3), camera.axes)[0];
    for (std::size_t i = 0; i < places.size(); ++i)
        dome[static_cast<std::size_t>(pixels[i])] = 1 - lit[i].dome.sum() / open.dome.sum();
    dome = blurred(dome, layout.width, std::max(1, layout.width / 40)); // the dome has few lights: hide their steps
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double x = (pixels[i] % layout.width + 0.5) / layout.width;
        const double edge = std::clamp(std::min(x, 1 - x) / 0.15, 0.0, 1.0); // fades before the tile ends
        const int rows_below = layout.height + layout.caption - pixels[i] / layout.width;
        const double y = (rows_below - 0.5) / layout.caption;
        const double fade = edge * edge * (3 - 2 * edge) * std::clamp(y / 0.6, 0.0, 1.0);
        const auto at = static_cast<std::size_t>(pixels[i]);
        shadow[at] = static_cast<float>(fade) * (0.28F * (1 - lit[i].key) + 0.62F * dome[at]);
    }
    return shadow;
}

} // namespace

Canvas backdrop(int width, int height) {
    Canvas canvas(static_cast<Eigen::Index>(width) * height, 3);
    const Eigen::Array3f top(linear_from_srgb(0.945F), linear_from_srgb(0.943F), linear_from_srgb(0.937F)),
        bottom(linear_from_srgb(0.895F), linear_from_srgb(0.888F), linear_from_srgb(0.876F));
    for (int y = 0; y < height; ++y) {
        const float down = static_cast<float>(y) / static_cast<float>(height);
        canvas.middleRows(static_cast<Eigen::Index>(y) * width, width).rowwise() =
            (top + (bottom - top) * down * down).transpose();
    }
    return canvas;
}

Samples draw_shape(Canvas& canvas, int canvas_width, int left, int top, const Dress& dress, const Shape& shape,
                   const Layout& layout) {
    const Camera& camera = layout.camera;
    Points screen(shape.positions.rows(), 3);
    parallel_for(screen.rows(), [&](std::ptrdiff_t i) {
        screen.row(i) = camera.project(shape.positions.row(i).transpose()).transpose();
    });
    const int rows = layout.height + layout.caption; // feet may reach a little into the caption's room
    Samples samples = rasterise(screen, shape.triangles, layout.width * supersample, rows * supersample);
    if (shape.triangles.rows() == 0) return samples;
    const std::vector<float> shadow = ground_shadow(shape, layout);
    const auto at = [&](int pixel) {
        return static_cast<Eigen::Index>(top + pixel / layout.width) * canvas_width + left + pixel % layout.width;
    };
    for (int pixel = 0; pixel < layout.width * rows; ++pixel)
        canvas.row(at(pixel)) *= 1 - shadow[static_cast<std::size_t>(pixel)];
    const std::vector<Fragment> seen = fragments(dress, shape, camera, samples);
    std::vector<SurfaceSpot> places(seen.size());
    std::transform(seen.begin(), seen.end(), places.begin(), [](const Fragment& f) { return f.place; });
    const std::vector<Lit> lit = light(places, shape.positions, shape.triangles, camera.axes);
    // What is behind shows through the samples that nothing covers.
    std::vector<int> covered(static_cast<std::size_t>(layout.width * rows), 0);
    for (const Fragment& f : seen) covered[static_cast<std::size_t>(f.pixel)] += f.samples;
    constexpr float share = 1.0F / (supersample * supersample);
    for (int pixel = 0; pixel < layout.width * rows; ++pixel)
        canvas.row(at(pixel)) *= 1 - share * static_cast<float>(covered[static_cast<std::size_t>(pixel)]);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const Eigen::Vector3d to_eye = (camera.eye() - seen[i].place.position).normalized();
        const Eigen::Vector3f albedo = seen[i].albedo / static_cast<float>(seen[i].samples);
        const Eigen::Vector3f color = shade(seen[i].place, lit[i], albedo, to_eye, camera.axes);
        canvas.row(at(seen[i].pixel)) +=
            share * static_cast<float>(seen[i].samples) * color.unaryExpr(&toned).transpose().array();
    }
    return samples;
}

Image developed(const Canvas& canvas, int width, int height) {
    Image image{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(canvas.size()))};
    parallel_for(canvas.size(),
                 [&](std::ptrdiff_t i) { image.rgb[static_cast<std::size_t>(i)] = srgb_byte(canvas.data()[i]); });
    return image;
}

} // namespace meshtween
