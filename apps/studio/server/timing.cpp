#include "timing.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/measure.h"

#include <fmt/format.h>

#include <cmath>

namespace meshtween::studio {
namespace {

constexpr std::size_t most_dabs = 20000;

struct Dab {
    Point at;
    double radius = 0, start = 0, end = 1;
};

double number_in(const Json& object, const char* key, std::size_t number) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_number() || !std::isfinite(found->get<double>()))
        throw Error(ErrorKind::argument, fmt::format("dab {} of the timing needs a number {}", number, key));
    return *found;
}

Dab dab_from_json(const Json& json, std::size_t number) {
    const auto wrong = [&](const char* what) {
        return Error(ErrorKind::argument, fmt::format("dab {} of the timing {}", number, what));
    };
    if (!json.is_object()) throw wrong("must be an object");
    Dab dab;
    dab.radius = number_in(json, "radius", number);
    dab.start = number_in(json, "start", number);
    dab.end = number_in(json, "end", number);
    if (!(dab.radius > 0)) throw wrong("must have a radius above 0");
    if (!(dab.start >= 0 && dab.start < dab.end && dab.end <= 1))
        throw wrong("must start before it ends, within 0 to 1");
    const auto at = json.find("at");
    if (at == json.end() || !at->is_array() || at->size() != 3) throw wrong("must be at three numbers");
    for (std::size_t k = 0; k < 3; ++k) {
        if (!(*at)[k].is_number()) throw wrong("must be at three numbers");
        dab.at[static_cast<Eigen::Index>(k)] = (*at)[k];
    }
    return dab;
}

} // namespace

std::optional<RegionTiming> painted_timing(const Json& timing, const Mesh& source) {
    if (timing.is_null()) return std::nullopt;
    if (!timing.is_object()) throw Error(ErrorKind::argument, "the timing must be an object");
    const Json dabs = timing.value("dabs", Json::array());
    if (!dabs.is_array() || dabs.size() > most_dabs)
        throw Error(ErrorKind::argument, fmt::format("the timing's dabs must be a list of {} at most", most_dabs));
    if (dabs.empty()) return std::nullopt;
    std::vector<TimedVertex> vertices(static_cast<std::size_t>(source.positions.rows()));
    for (std::size_t i = 0; i < vertices.size(); ++i) vertices[i].vertex = static_cast<int>(i);
    const double size = diagonal(source);
    for (std::size_t i = 0; i < dabs.size(); ++i) {
        const Dab dab = dab_from_json(dabs[i], i + 1);
        const double reach = dab.radius * size;
        for (TimedVertex& v : vertices)
            if ((source.positions.row(v.vertex) - dab.at).squaredNorm() <= reach * reach)
                v.start = dab.start, v.end = dab.end;
    }
    return region_timing(source, vertices);
}

} // namespace meshtween::studio
