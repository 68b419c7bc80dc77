#include "meshtween/app/export.h"

#include "meshtween/core/error.h"
#include "meshtween/io/base64.h"
#include "meshtween/io/gltf_write.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string_view>

extern "C" const char meshtween_player_begin[], meshtween_player_end[]; // the page, built from apps/player

namespace meshtween {
namespace {

GltfMorph animation(const Curve& curve, const WeightKeys& keys) {
    GltfMorph morph;
    morph.shapes = std::span(curve.nodes).subspan(1);
    morph.names = shape_names(curve);
    morph.degree = curve.basis.degree;
    morph.knots = curve.basis.knots;
    morph.times = keys.times;
    morph.weights = keys.weights;
    const CurveSites sites = curve_sites(curve);
    morph.normal_fit = sites.fit;
    morph.on_path = [&curve, at = sites.sites](std::size_t s) { return curve.at(at[s]); };
    return morph;
}

void check(const Mesh& mesh, const Curve& curve) {
    for (const Points& node : curve.nodes)
        if (node.rows() != mesh.positions.rows())
            throw Error(ErrorKind::argument, fmt::format("a shape of the curve has {} vertices, but the mesh has {}",
                                                         node.rows(), mesh.positions.rows()));
}

std::string html_escaped(std::string_view text) {
    std::string result;
    for (const char c : text) switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        case '\'':
            result += "&#39;";
            break;
        default:
            result += c;
        }
    return result;
}

} // namespace

std::vector<std::string> shape_names(const Curve& curve) {
    std::vector<std::string> names;
    const std::vector<bool> on = nodes_on_path(curve);
    int key = 1, control = 0; // the base is the first key
    for (std::size_t k = 1; k < on.size(); ++k)
        names.push_back(on[k] ? fmt::format("key {}", ++key) : fmt::format("control {}", ++control));
    return names;
}

std::string morph_glb(const Mesh& mesh, const Curve& curve, const PlayOptions& options) {
    check(mesh, curve);
    return morph_glb(mesh, curve, weight_keys(curve, options), options.title);
}

std::string morph_glb(const Mesh& mesh, const Curve& curve, const WeightKeys& keys, const std::string& title) {
    check(mesh, curve);
    Mesh base = mesh;
    base.positions = curve.nodes.front();
    return mesh_glb(base, animation(curve, keys), title.empty() ? "morph" : title);
}

std::string morph_html(const std::string& glb, const PlayOptions& options) {
    const nlohmann::json played = {
        {"seconds", options.seconds}, {"pingPong", options.ping_pong}, {"ease", name_of(options.ease)}};
    const std::pair<std::string_view, std::string> parts[] = {
        {"@@TITLE@@", html_escaped(options.title.empty() ? "Morph" : options.title)},
        {"@@OPTIONS@@", played.dump()},
        {"@@MODEL@@", to_base64(glb)},
    };
    std::string_view rest(meshtween_player_begin,
                          static_cast<std::size_t>(meshtween_player_end - meshtween_player_begin));
    std::string result;
    result.reserve(rest.size() + parts[2].second.size() + 2 * parts[0].second.size() + 100);
    while (true) {
        const std::size_t at = rest.find("@@");
        result += rest.substr(0, at);
        if (at == std::string_view::npos) return result;
        rest.remove_prefix(at);
        const auto part =
            std::find_if(std::begin(parts), std::end(parts), [&](const auto& p) { return rest.starts_with(p.first); });
        result += part == std::end(parts) ? rest.substr(0, 1) : std::string_view(part->second);
        rest.remove_prefix(part == std::end(parts) ? 1 : part->first.size());
    }
}

} // namespace meshtween
