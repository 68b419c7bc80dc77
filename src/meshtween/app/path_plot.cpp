#include "meshtween/app/path_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace meshtween {
namespace {

constexpr double panel_width = 300, panel_height = 180, margin = 46;
// Okabe and Ito's colours, which colour-blind readers can tell apart.
constexpr std::array colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000"};
constexpr std::array dashes{"none", "6 3", "2 2", "8 3 2 3"};

struct Panel {
    std::string title;
    std::function<double(const FrameQuality&)> value;
    double least, most; // the span shown at least
};

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '<')
            result += "&lt;";
        else if (c == '&')
            result += "&amp;";
        else
            result += c;
    }
    return result;
}

std::string panel_svg(const Panel& panel, const std::vector<PlottedPath>& paths, double left, double top) {
    double low = panel.least, high = panel.most;
    for (const PlottedPath& path : paths)
        for (const FrameQuality& frame : path.quality.frames)
            if (const double v = panel.value(frame); std::isfinite(v)) {
                low = std::min(low, v);
                high = std::max(high, v);
            }
    const auto x = [&](double u) { return left + u * panel_width; };
    const auto y = [&](double v) { return top + panel_height * (1 - (v - low) / (high - low)); };
    std::string svg = fmt::format(R"(<text x="{}" y="{}" font-weight="bold">{}</text>)", left, top - 8, panel.title);
    svg += fmt::format(R"(<rect x="{}" y="{}" width="{}" height="{}" fill="none" stroke="#888"/>)", left, top,
                       panel_width, panel_height);
    for (const double v : {low, (low + high) / 2, high})
        svg += fmt::format(R"(<text x="{}" y="{:.1f}" text-anchor="end">{:.4g}</text>)", left - 5, y(v) + 4, v);
    for (const double u : {0.0, 0.5, 1.0})
        svg += fmt::format(R"(<text x="{}" y="{}" text-anchor="middle">{}</text>)", x(u), top + panel_height + 15, u);
    for (std::size_t k = 0; k < paths.size(); ++k) {
        std::string points;
        for (const FrameQuality& frame : paths[k].quality.frames)
            if (const double v = panel.value(frame); std::isfinite(v))
                points += fmt::format("{:.1f},{:.1f} ", x(frame.u), y(v));
        svg +=
            fmt::format(R"(<polyline points="{}" fill="none" stroke="{}" stroke-width="1.6" stroke-dasharray="{}"/>)",
                        points, colours[k % colours.size()], dashes[k / colours.size() % dashes.size()]);
    }
    return svg + "\n";
}

} // namespace

std::string path_plot(const std::vector<PlottedPath>& paths) {
    const std::array panels{
        Panel{"volume / straight line", [](const FrameQuality& f) { return f.volume_ratio; }, 0.99, 1.01},
        Panel{"area / straight line", [](const FrameQuality& f) { return f.area_ratio; }, 0.99, 1.01},
        Panel{"mean edge strain, %", [](const FrameQuality& f) { return 100 * f.edge_strain_mean; }, 0, 0.1},
        Panel{"flipped faces + cuts",
              [](const FrameQuality& f) { return static_cast<double>(f.flipped.size() + f.self_intersections.size()); },
              0, 1}};
    const double width = 2 * panel_width + 3 * margin;
    const double rows = 2 * (panel_height + margin) + margin;
    const double height = rows + 18 * static_cast<double>(paths.size());
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
        "font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
        width, height);
    for (std::size_t k = 0; k < panels.size(); ++k)
        svg += panel_svg(panels[k], paths, margin + static_cast<double>(k % 2) * (panel_width + margin),
                         margin / 2 + static_cast<double>(k / 2) * (panel_height + margin));
    for (std::size_t k = 0; k < paths.size(); ++k) {
        const double line = rows - margin / 2 + 18 * static_cast<double>(k);
        svg += fmt::format("<line x1=\"{}\" x2=\"{}\" y1=\"{}\" y2=\"{}\" stroke=\"{}\" stroke-width=\"2\" "
                           "stroke-dasharray=\"{}\"/><text x=\"{}\" y=\"{}\">{}</text>\n",
                           margin, margin + 30, line, line, colours[k % colours.size()],
                           dashes[k / colours.size() % dashes.size()], margin + 38, line + 4, escaped(paths[k].name));
    }
    return svg + "</svg>\n";
}

} // namespace meshtween
