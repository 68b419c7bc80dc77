// glTF plays weights on straight lines between keys; the curve's weights are polynomials. A chord over a step h of u is
// off by at most h^2 |p''| / 8, which falls fourfold with every halving: a few chords tell how many are needed.
#include "meshtween/app/export.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/gltf_write.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

extern "C" const char meshtween_player_begin[], meshtween_player_end[]; // the page, built from apps/player

namespace meshtween {
namespace {

constexpr double key_tolerance = 1e-5; // of the diagonal: how far a viewer's frame may lie beside the curve
constexpr int most_keys = 4096;

// The largest distance between the curve and `count` chords of it, equal in time, measured at their middles.
double chord_error(const Curve& curve, Ease kind, int count) {
    const auto shapes = static_cast<Eigen::Index>(curve.nodes.size());
    Eigen::MatrixXd gaps(count, shapes); // weights in the middle less the mean of those at the ends
    const auto weights = [&](double t) -> Eigen::RowVectorXd {
        const std::vector<double> w = curve.weights(ease(kind, t));
        return Eigen::Map<const Eigen::RowVectorXd>(w.data(), shapes);
    };
    for (int i = 0; i < count; ++i) {
        const double a = static_cast<double>(i) / count, b = (i + 1.0) / count;
        gaps.row(i) = weights((a + b) / 2) - (weights(a) + weights(b)) / 2;
    }
    const Eigen::Index vertices = curve.nodes.front().rows();
    std::vector<double> worst(static_cast<std::size_t>(vertices), 0.0);
    parallel_for(vertices, [&](std::ptrdiff_t v) {
        Eigen::Matrix<double, Eigen::Dynamic, 3> places(shapes, 3);
        for (Eigen::Index k = 0; k < shapes; ++k) places.row(k) = curve.nodes[static_cast<std::size_t>(k)].row(v);
        worst[static_cast<std::size_t>(v)] = (gaps * places).rowwise().squaredNorm().maxCoeff();
    });
    return worst.empty() ? 0 : std::sqrt(*std::max_element(worst.begin(), worst.end()));
}

// How many equal steps of time keep straight weights within the tolerance.
int steps_for(const Curve& curve, Ease kind) {
    const int first = std::max<int>(16, 4 * static_cast<int>(curve.nodes.size()));
    const double error = chord_error(curve, kind, first), allowed = key_tolerance * diagonal(curve.nodes.front());
    if (!(allowed > 0) || error <= 0) return 1;
    // A tenth more: the first chords are not yet quite parabolas.
    return static_cast<int>(std::clamp(std::ceil(1.1 * first * std::sqrt(error / allowed)), 1.0, most_keys * 1.0));
}

GltfMorph animation(const Curve& curve, const PlayOptions& options) {
    GltfMorph morph;
    morph.shapes = std::span(curve.nodes).subspan(1);
    for (std::size_t k = 1; k < curve.nodes.size(); ++k)
        morph.names.push_back(fmt::format("u = {:.6g}", curve.parameters[k]));
    morph.parameters = curve.parameters;
    morph.knots = curve.knots;
    const int steps = steps_for(curve, options.ease), last = options.ping_pong ? 2 * steps : steps;
    for (int i = 0; i <= last; ++i) {
        const double t = 1 - std::abs(1 - static_cast<double>(i) / steps);
        morph.times.push_back(static_cast<float>(options.seconds * i / steps));
        const std::vector<double> weights = curve.weights(ease(options.ease, std::clamp(t, 0.0, 1.0)));
        for (std::size_t k = 1; k < weights.size(); ++k) morph.weights.push_back(static_cast<float>(weights[k]));
    }
    return morph;
}

void check(const Mesh& mesh, const Curve& curve, const PlayOptions& options) {
    if (curve.nodes.size() < 2 || curve.parameters.size() != curve.nodes.size())
        throw Error(ErrorKind::argument, "a morph to play needs at least two shapes and a parameter for each");
    for (const Points& node : curve.nodes)
        if (node.rows() != mesh.positions.rows())
            throw Error(ErrorKind::argument, fmt::format("a shape of the curve has {} vertices, but the mesh has {}",
                                                         node.rows(), mesh.positions.rows()));
    if (!(options.seconds >= 1e-3 && options.seconds <= 1e5))
        throw Error(ErrorKind::argument, fmt::format("a morph of {} seconds cannot be played", options.seconds));
}

std::string base64(std::string_view bytes) {
    constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string result;
    result.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) result += i + k <= bytes.size() ? digits[word >> (18 - 6 * k) & 63] : '=';
    }
    return result;
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

std::string morph_glb(const Mesh& mesh, const Curve& curve, const PlayOptions& options) {
    check(mesh, curve, options);
    Mesh base = mesh;
    base.positions = curve.nodes.front();
    return mesh_glb(base, animation(curve, options), options.title.empty() ? "morph" : options.title);
}

std::string morph_html(const std::string& glb, const PlayOptions& options) {
    const nlohmann::json played = {
        {"seconds", options.seconds}, {"pingPong", options.ping_pong}, {"ease", name_of(options.ease)}};
    const std::pair<std::string_view, std::string> parts[] = {
        {"@@TITLE@@", html_escaped(options.title.empty() ? "Morph" : options.title)},
        {"@@OPTIONS@@", played.dump()},
        {"@@MODEL@@", base64(glb)},
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
