#include "meshtween/fit/finish.h"

#include "meshtween/fit/lift.h"
#include "meshtween/fit/meet_markers.h"
#include "meshtween/geometry/measure.h"

#include <fmt/format.h>

namespace meshtween {

void finish_fit(FitResult& result, const Mesh& source, const Mesh& target, std::span<const Marker> markers,
                const FitOptions& options) {
    if (options.method == FitMethod::surface && !options.on_surface) {
        const Point centre = target.positions.colwise().mean();
        const double size = diagonal(target.positions);
        const Points x = (result.positions.rowwise() - centre) / size;
        const FitTarget surface = fit_target((target.positions.rowwise() - centre) / size, target.triangles);
        const Points y = lifted(x, source.triangles, topology(x.rows(), source.triangles), surface);
        result.positions = (y * size).rowwise() + centre;
    }
    if (options.markers_exact && !markers.empty()) {
        MetMarkers met = meet_markers({result.positions, source.triangles, {}, {}, {}}, target, markers);
        result.positions = std::move(met.positions);
        for (const std::size_t k : met.missed)
            result.notes.push_back(fmt::format("marker '{}' cannot be met exactly beside its neighbours: the source "
                                               "is too coarse there, refine it or take a marker away",
                                               markers[k].name));
    }
}

} // namespace meshtween
