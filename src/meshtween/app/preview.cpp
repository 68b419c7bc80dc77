#include "meshtween/app/preview.h"

#include "meshtween/app/drawing.h"
#include "meshtween/app/text.h"
#include "meshtween/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

// A disc or a ring with soft edges. Distances in pixels.
void draw_dot(Image& image, double x, double y, double radius, Rgb color, bool hollow) {
    const int reach = static_cast<int>(std::ceil(radius + 2));
    for (int py = static_cast<int>(y) - reach; py <= static_cast<int>(y) + reach; ++py)
        for (int px = static_cast<int>(x) - reach; px <= static_cast<int>(x) + reach; ++px) {
            if (px < 0 || py < 0 || px >= image.width || py >= image.height) continue;
            const double away = std::hypot(px + 0.5 - x, py + 0.5 - y);
            const double fill = std::clamp(radius + 0.5 - away, 0.0, 1.0);
            const double core = std::clamp(radius * (hollow ? 0.55 : 0.72) + 0.5 - away, 0.0, 1.0);
            std::uint8_t* pixel = image.rgb.data() + 3 * (static_cast<std::ptrdiff_t>(py) * image.width + px);
            for (std::size_t c = 0; c < 3; ++c) {
                // Seen: a coloured core in a white rim. Hidden: a coloured ring around what is there.
                const double ink = hollow ? fill - core : core, rim = hollow ? 0 : fill - core;
                const double value = pixel[c] * (1 - ink - rim) + color[c] * ink + 255 * rim;
                pixel[c] = static_cast<std::uint8_t>(std::lround(value));
            }
        }
}

void draw_marks(Image& image, int left, int top, const Points& marks, const Samples& samples, const Layout& layout) {
    const double radius = std::max(2.5, 0.0085 * std::max(layout.width, layout.height));
    for (Eigen::Index i = 0; i < marks.rows(); ++i) {
        if (!marks.row(i).allFinite()) continue;
        const Eigen::Vector3d p = layout.camera.project(marks.row(i).transpose());
        if (!(p[0] >= 0 && p[1] >= 0 && p[0] < samples.width && p[1] < samples.height)) continue;
        const auto at =
            static_cast<std::size_t>(p[1]) * static_cast<std::size_t>(samples.width) + static_cast<std::size_t>(p[0]);
        const double front = samples.nearness[at] > 0 ? 1 / static_cast<double>(samples.nearness[at]) : p[2];
        const bool hidden = p[2] > front + 0.02 * layout.camera.distance / eye_distance;
        draw_dot(image, left + p[0] / supersample, top + p[1] / supersample, radius, {224, 82, 44}, hidden);
    }
}

void draw_caption(Image& image, int left, int top, const std::string& caption, const Layout& layout) {
    const double size = std::max(12.0, layout.caption * 0.30);
    const auto line = [&](std::string_view text, double y, double s, Rgb color) {
        const std::string fitted = fitted_text(text, s, layout.width - s);
        draw_text(image, left + (layout.width - text_width(fitted, s)) / 2, y, fitted, s, color);
    };
    const std::size_t end = std::min(caption.find('\n'), caption.size());
    const double first = top + layout.height + layout.caption * 0.5;
    line(std::string_view(caption).substr(0, end), first, size, {52, 50, 47});
    if (end < caption.size())
        line(std::string_view(caption).substr(end + 1), first + size * 1.25, size * 0.8, {128, 124, 118});
}

void check(const std::vector<Tile>& tiles, const SheetOptions& options) {
    if (tiles.empty()) throw Error(ErrorKind::argument, "a contact sheet needs at least one shape");
    if (options.tile < 16 || options.tile > 8192)
        throw Error(ErrorKind::argument, fmt::format("a tile of {} pixels: 16 to 8192 can be drawn", options.tile));
    if (static_cast<double>(options.tile) * options.tile * static_cast<double>(tiles.size()) > 1e8)
        throw Error(ErrorKind::argument,
                    fmt::format("{} tiles of {} pixels make too large a picture: take fewer or smaller ones",
                                tiles.size(), options.tile));
}

// The looks of several meshes; pictures of one file are read once.
class Wardrobe {
public:
    const Appearance& look_of(const Mesh& mesh) {
        for (const auto& [known, look] : looks_)
            if (mesh.file && known->file == mesh.file)
                return *looks_.emplace_back(&mesh, std::make_unique<Appearance>(mesh, *look)).second;
        return *looks_.emplace_back(&mesh, std::make_unique<Appearance>(mesh)).second;
    }

private:
    std::vector<std::pair<const Mesh*, std::unique_ptr<Appearance>>> looks_;
};

} // namespace

Image contact_sheet(const std::vector<Tile>& tiles, const SheetOptions& options, const Progress& progress) {
    check(tiles, options);
    const std::vector<Shape> shapes = grounded(tiles);
    const Layout layout = lay_out(shapes, options);
    const int width = 2 * layout.margin + layout.columns * layout.width;
    const int height = 2 * layout.margin + layout.rows * (layout.height + layout.caption);
    const auto left = [&](std::size_t i) {
        return layout.margin + static_cast<int>(i) % layout.columns * layout.width;
    };
    const auto top = [&](std::size_t i) {
        return layout.margin + static_cast<int>(i) / layout.columns * (layout.height + layout.caption);
    };
    Canvas canvas = backdrop(width, height);
    std::vector<Samples> samples(tiles.size());
    Wardrobe wardrobe;
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        if (!keep_going(progress, static_cast<double>(i) / static_cast<double>(tiles.size()), "drawing")) break;
        const Dress dress{wardrobe.look_of(tiles[i].mesh),
                          tiles[i].other ? &wardrobe.look_of(*tiles[i].other) : nullptr,
                          static_cast<float>(tiles[i].faded)};
        Samples seen = draw_shape(canvas, width, left(i), top(i), dress, shapes[i], layout);
        if (tiles[i].marks.rows() > 0) samples[i] = std::move(seen);
    }
    Image image = developed(canvas, width, height);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        if (tiles[i].marks.rows() > 0 && samples[i].width > 0)
            draw_marks(image, left(i), top(i), (tiles[i].marks.rowwise() - shapes[i].origin) * shapes[i].unit,
                       samples[i], layout);
        draw_caption(image, left(i), top(i), tiles[i].caption, layout);
    }
    return image;
}

} // namespace meshtween
