#include "meshtween/fit/mend_level.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/untangle.h"

#include <cmath>

namespace meshtween {
namespace {

constexpr double much = 0.02;    // cuts, beside triangles
constexpr double bearable = 1.1; // of what was uncovered before

// The mean distance of the target from what looks its way.
double uncovered(const TangleSearch& search, const Points& positions) {
    const FitTarget& target = search.target;
    const ClosestPointIndex mesh(positions, search.shell.triangles, MeshIs::moving);
    return parallel_sum(target.positions.rows(), 0.0, [&](std::ptrdiff_t i) {
        const Compatible alike{target.normals.row(i), 0};
        const ClosestPoint there = mesh.closest(Point(target.positions.row(i)), alike);
        return target.area[static_cast<std::size_t>(i)] * (there.found() ? std::sqrt(there.squared_distance) : 1);
    });
}

} // namespace

std::optional<Points> mended_level(TangleSearch& search, const Points& positions, std::span<const Pin> pins,
                                   Mending mending, const Progress& progress) {
    if (mending == Mending::much) {
        const auto cuts = static_cast<double>(new_cuts(search, positions).size());
        if (cuts <= much * static_cast<double>(search.shell.triangles.rows())) return std::nullopt;
    }
    search.beyond = without_counterpart(search.shell, positions, search.target);
    const Tangles faults = tangles(search, positions);
    Untangled mended = untangle(search, positions, faults, pins, progress);
    if (mended.cancelled || mended.left.count() >= faults.count() ||
        uncovered(search, mended.positions) > bearable * uncovered(search, positions))
        return std::nullopt;
    return std::move(mended.positions);
}

} // namespace meshtween
