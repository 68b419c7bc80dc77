// Pineda 1988, A parallel algorithm for polygon rasterization: a sample lies in a triangle where its three edge
// functions agree in sign.
#include "meshtween/app/raster.h"

#include "meshtween/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshtween {
namespace {

struct Box {
    int left, right, top, bottom; // first and one past the last sample
};

// The samples that a triangle can cover, their centres at half numbers; empty where it is not finite.
Box box_of(const Points& screen, const Triangles& triangles, Eigen::Index t, int width, int height) {
    const auto a = screen.row(triangles(t, 0)), b = screen.row(triangles(t, 1)), c = screen.row(triangles(t, 2));
    if (!a.allFinite() || !b.allFinite() || !c.allFinite()) return {0, 0, 0, 0};
    const auto first = [](double low, int size) {
        return static_cast<int>(std::clamp(std::ceil(low - 0.5), 0.0, size * 1.0));
    };
    const auto last = [](double high, int size) {
        return static_cast<int>(std::clamp(std::floor(high - 0.5) + 1, 0.0, size * 1.0));
    };
    return {first(std::min({a[0], b[0], c[0]}), width), last(std::max({a[0], b[0], c[0]}), width),
            first(std::min({a[1], b[1], c[1]}), height), last(std::max({a[1], b[1], c[1]}), height)};
}

// Calls visit(x, y, wa, wb, wc) with the corners' shares for each sample of triangle t inside the box.
template <typename Visit>
void cover(const Points& screen, const Triangles& triangles, Eigen::Index t, const Box& box, const Visit& visit) {
    const auto a = screen.row(triangles(t, 0)), b = screen.row(triangles(t, 1)), c = screen.row(triangles(t, 2));
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (area == 0) return;
    const double inverse = 1 / area;
    const double step_a = (b[1] - c[1]) * inverse, step_b = (c[1] - a[1]) * inverse;
    for (int y = box.top; y < box.bottom; ++y) {
        const double px = box.left + 0.5, py = y + 0.5;
        double wa = ((b[0] - px) * (c[1] - py) - (b[1] - py) * (c[0] - px)) * inverse;
        double wb = ((c[0] - px) * (a[1] - py) - (c[1] - py) * (a[0] - px)) * inverse;
        for (int x = box.left; x < box.right; ++x, wa += step_a, wb += step_b)
            if (const double wc = 1 - wa - wb; wa >= 0 && wb >= 0 && wc >= 0) visit(x, y, wa, wb, wc);
    }
}

constexpr int band_rows = 64;

// The triangles that touch each band of rows, ascending.
std::vector<std::vector<int>> triangles_by_band(const Points& screen, const Triangles& triangles, int width,
                                                int height) {
    std::vector<std::vector<int>> bands(static_cast<std::size_t>((height + band_rows - 1) / band_rows));
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
        const Box box = box_of(screen, triangles, t, width, height);
        if (box.left >= box.right || box.top >= box.bottom) continue;
        for (int band = box.top / band_rows; band <= (box.bottom - 1) / band_rows; ++band)
            bands[static_cast<std::size_t>(band)].push_back(static_cast<int>(t));
    }
    return bands;
}

} // namespace

Samples rasterise(const Points& screen, const Triangles& triangles, int width, int height) {
    const auto size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    Samples samples{width, height, std::vector<int>(size, -1), std::vector<float>(size, 0),
                    std::vector<Eigen::Vector2f>(size, Eigen::Vector2f::Zero())};
    const auto bands = triangles_by_band(screen, triangles, width, height);
    const auto draw_band = [&](std::ptrdiff_t band) {
        for (const int t : bands[static_cast<std::size_t>(band)]) {
            const Eigen::Array3d nearness(1 / screen(triangles(t, 0), 2), 1 / screen(triangles(t, 1), 2),
                                          1 / screen(triangles(t, 2), 2));
            if (!(nearness > 0).all()) continue;
            Box box = box_of(screen, triangles, t, width, height);
            box.top = std::max(box.top, static_cast<int>(band) * band_rows);
            box.bottom = std::min(box.bottom, static_cast<int>(band + 1) * band_rows);
            cover(screen, triangles, t, box, [&](int x, int y, double wa, double wb, double wc) {
                const double near = wa * nearness[0] + wb * nearness[1] + wc * nearness[2]; // linear on the picture
                const auto at =
                    static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
                if (static_cast<float>(near) <= samples.nearness[at]) return;
                samples.nearness[at] = static_cast<float>(near);
                samples.triangle[at] = t;
                samples.barycentric[at] =
                    Eigen::Vector2d(wb * nearness[1], wc * nearness[2]).cast<float>() / static_cast<float>(near);
            });
        }
    };
    parallel_for(static_cast<std::ptrdiff_t>(bands.size()), draw_band, 1);
    return samples;
}

std::vector<float> depth_map(const Points& screen, const Triangles& triangles, int side) {
    std::vector<float> depth(static_cast<std::size_t>(side) * static_cast<std::size_t>(side),
                             std::numeric_limits<float>::infinity());
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
        const double za = screen(triangles(t, 0), 2), zb = screen(triangles(t, 1), 2), zc = screen(triangles(t, 2), 2);
        cover(screen, triangles, t, box_of(screen, triangles, t, side, side),
              [&](int x, int y, double wa, double wb, double wc) {
                  const auto at =
                      static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x);
                  depth[at] = std::min(depth[at], static_cast<float>(wa * za + wb * zb + wc * zc));
              });
    }
    return depth;
}

} // namespace meshtween
