// Pineda 1988, A parallel algorithm for polygon rasterization: a sample lies in a triangle where its three edge
// functions agree in sign. Rows are painted in bands, each by one thread.
#include "meshtween/fit/bake.h"

#include "meshtween/core/color.h"
#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/place_on_triangle.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace meshtween {
namespace {

constexpr int band_rows = 16, bands_at_once = 16;
constexpr int samples = 4;                                              // of a pixel
constexpr std::array<double, samples> sample_x{0.25, 0.75, 0.25, 0.75}; // of its sides
constexpr std::array<double, samples> sample_y{0.25, 0.25, 0.75, 0.75};
constexpr double touching = 0.7072; // of a pixel's side: from its middle to its corner

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// A triangle where it lies on a picture, in pixels; one that crosses the picture's edge comes in again opposite.
struct Placed {
    int triangle = 0;
    PictureTriangle corners;
};

std::vector<std::vector<Placed>> placed_by_band(const Mesh& mesh, const PictureLayout& layout, int picture, int size) {
    std::vector<std::vector<Placed>> bands(idx((size + band_rows - 1) / band_rows));
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
        if (layout.picture[idx(t)] != picture) continue;
        const PictureTriangle p = picture_triangle(mesh, t);
        const Eigen::RowVector2d high = p.colwise().maxCoeff();
        if (!p.allFinite() || (high - p.colwise().minCoeff()).maxCoeff() > 1 + 1e-6) continue;
        for (int dy = 0; dy == 0 || dy < high[1]; ++dy)
            for (int dx = 0; dx == 0 || dx < high[0]; ++dx) {
                const Placed placed{static_cast<int>(t), (p.rowwise() - Eigen::RowVector2d(dx, dy)) * size};
                const double top = placed.corners.col(1).minCoeff() - 1, low = placed.corners.col(1).maxCoeff() + 1;
                const int first = std::max(0, static_cast<int>(std::floor(top)) / band_rows);
                const int last =
                    std::min<int>(static_cast<int>(bands.size()) - 1, static_cast<int>(std::floor(low)) / band_rows);
                for (int b = first; b <= last; ++b) bands[idx(b)].push_back(placed);
            }
    }
    return bands;
}

// What the samples of a band's pixels lie in.
struct Band {
    int top = 0, rows = 0, width = 0;
    std::vector<SurfacePoint> inside;  // a sample; triangle -1: nothing
    std::vector<char> well_inside;     // a sample: not on the edge
    std::vector<SurfacePoint> nearest; // a pixel: the place of a triangle that touches it
    std::vector<double> away;          // a pixel: how far from its middle
    std::ptrdiff_t taken = 0, twice = 0;

    Band(int first, int count, int size) : top(first), rows(count), width(size) {
        const std::size_t pixels = idx(rows) * idx(width);
        inside.resize(pixels * samples), well_inside.resize(pixels * samples);
        nearest.resize(pixels), away.resize(pixels, std::numeric_limits<double>::infinity());
    }
};

// True where one of the pixel's samples lies in the triangle.
bool take_samples(Band& band, const Placed& placed, double inverse, int x, int y) {
    const PictureTriangle& q = placed.corners;
    bool any = false;
    for (int s = 0; s < samples; ++s) {
        const double px = x + sample_x[idx(s)], py = y + sample_y[idx(s)];
        const auto share = [&](int i, int j) {
            return ((q(i, 0) - px) * (q(j, 1) - py) - (q(i, 1) - py) * (q(j, 0) - px)) * inverse;
        };
        const double b = share(2, 0), c = share(0, 1), a = 1 - b - c;
        if (a < 0 || b < 0 || c < 0) continue;
        any = true;
        const bool well = std::min({a, b, c}) > 1e-6;
        const std::size_t at = (idx(y - band.top) * idx(band.width) + idx(x)) * samples + idx(s);
        ++band.taken;
        if (band.inside[at].triangle >= 0) {
            band.twice += well && band.well_inside[at] != 0 ? 1 : 0;
            continue;
        }
        band.inside[at] = {placed.triangle, {a, b, c}};
        band.well_inside[at] = well ? 1 : 0;
    }
    return any;
}

void take_triangle(Band& band, const Placed& placed) {
    const PictureTriangle& q = placed.corners;
    const double area = (q(1, 0) - q(0, 0)) * (q(2, 1) - q(0, 1)) - (q(1, 1) - q(0, 1)) * (q(2, 0) - q(0, 0));
    if (area == 0) return;
    const auto corner = [&](int k) { return Point(q(k, 0), q(k, 1), 0); };
    const Eigen::RowVector2d low = q.colwise().minCoeff(), high = q.colwise().maxCoeff();
    const int left = std::max(0, static_cast<int>(std::floor(low[0] - touching)));
    const int right = std::min(band.width - 1, static_cast<int>(std::floor(high[0] + touching)));
    const int top = std::max(band.top, static_cast<int>(std::floor(low[1] - touching)));
    const int bottom = std::min(band.top + band.rows - 1, static_cast<int>(std::floor(high[1] + touching)));
    for (int y = top; y <= bottom; ++y)
        for (int x = left; x <= right; ++x) {
            if (take_samples(band, placed, 1 / area, x, y)) continue;
            const PlaceOnTriangle near = place_on_triangle({x + 0.5, y + 0.5, 0}, corner(0), corner(1), corner(2));
            const std::size_t at = idx(y - band.top) * idx(band.width) + idx(x);
            if (near.squared_distance > touching * touching || near.squared_distance >= band.away[at]) continue;
            band.away[at] = near.squared_distance;
            band.nearest[at] = {placed.triangle, {1 - near.v - near.w, near.v, near.w}};
        }
}

std::uint8_t srgb_byte(float linear) {
    return static_cast<std::uint8_t>(std::lround(255 * srgb_from_linear(std::clamp(linear, 0.0F, 1.0F))));
}

void paint_band(const Band& band, const Painter& paint, Image& image, std::vector<char>& covered) {
    std::vector<SurfacePoint> places;
    std::vector<Eigen::Vector3f> colors;
    std::vector<int> first(idx(band.width) + 1); // a pixel's places in the row
    for (int row = 0; row < band.rows; ++row) {
        places.clear();
        for (int x = 0; x < band.width; ++x) {
            const std::size_t pixel = idx(row) * idx(band.width) + idx(x);
            first[idx(x)] = static_cast<int>(places.size());
            for (std::size_t s = 0; s < samples; ++s)
                if (band.inside[pixel * samples + s].triangle >= 0) places.push_back(band.inside[pixel * samples + s]);
            if (first[idx(x)] == std::ssize(places) && band.nearest[pixel].triangle >= 0)
                places.push_back(band.nearest[pixel]);
        }
        first.back() = static_cast<int>(places.size());
        colors.assign(places.size(), Eigen::Vector3f::Zero());
        paint(places, colors);
        for (int x = 0; x < band.width; ++x) {
            const int count = first[idx(x) + 1] - first[idx(x)];
            if (count == 0) continue;
            Eigen::Vector3f sum(0, 0, 0);
            for (int i = first[idx(x)]; i < first[idx(x) + 1]; ++i) sum += colors[idx(i)];
            const std::size_t at = idx(band.top + row) * idx(band.width) + idx(x);
            covered[at] = 1;
            for (int c = 0; c < 3; ++c) image.rgb[3 * at + idx(c)] = srgb_byte(sum[c] / static_cast<float>(count));
        }
    }
}

} // namespace

Baked bake(const Mesh& mesh, const PictureLayout& layout, const BakeOptions& options, const Painter& paint,
           const Progress& progress) {
    if (options.size < 16 || options.size > 8192)
        throw Error(ErrorKind::argument,
                    fmt::format("a picture of {} pixels a side: 16 to 8192 can be painted", options.size));
    Baked baked;
    std::ptrdiff_t taken = 0, twice = 0;
    const int size = options.size;
    for (int picture = 0; picture < layout.count; ++picture) {
        const auto placed = placed_by_band(mesh, layout, picture, size);
        Image image{size, size, std::vector<std::uint8_t>(3 * idx(size) * idx(size))};
        std::vector<char> covered(idx(size) * idx(size), 0);
        std::vector<std::array<std::ptrdiff_t, 2>> counts(placed.size());
        const auto count = std::ssize(placed);
        for (std::ptrdiff_t begin = 0; begin < count; begin += bands_at_once) {
            const double done = (picture + double(begin) / double(count)) / layout.count;
            if (!keep_going(progress, done, "painting")) {
                baked.cancelled = true;
                return baked;
            }
            parallel_for(
                std::min<std::ptrdiff_t>(bands_at_once, count - begin),
                [&](std::ptrdiff_t i) {
                    const std::ptrdiff_t b = begin + i;
                    const int top = static_cast<int>(b) * band_rows;
                    Band band(top, std::min(band_rows, size - top), size);
                    for (const Placed& p : placed[idx(b)]) take_triangle(band, p);
                    paint_band(band, paint, image, covered);
                    counts[idx(b)] = {band.taken, band.twice};
                },
                1);
        }
        for (const auto& c : counts) taken += c[0], twice += c[1];
        fill_around(image, std::move(covered), options.margin);
        baked.pictures.push_back(std::move(image));
    }
    baked.twice = taken > 0 ? double(twice) / double(taken) : 0;
    return baked;
}

} // namespace meshtween
