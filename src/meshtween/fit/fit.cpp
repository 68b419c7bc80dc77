#include "meshtween/fit/fit.h"

#include "meshtween/core/error.h"
#include "meshtween/fit/meet_markers.h"
#include "meshtween/fit/paper_fit.h"
#include "meshtween/fit/surface_fit.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/seams.h"

#include <fmt/format.h>

#include <cmath>

namespace meshtween {
namespace {

using Eigen::Index;

constexpr double most_marker_weight = 10; // more would leave the solver nothing but markers

void check_mesh(const Mesh& mesh, const char* which) {
    if (mesh.triangles.rows() == 0)
        throw Error(ErrorKind::computation, fmt::format("the {} has no faces: give a surface, not points", which));
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            if (mesh.triangles(t, k) < 0 || mesh.triangles(t, k) >= mesh.positions.rows())
                throw Error(ErrorKind::argument,
                            fmt::format("face {} of the {} has vertex {}, but there are {}: mend the mesh", t, which,
                                        mesh.triangles(t, k), mesh.positions.rows()));
    for (Index i = 0; i < mesh.positions.rows(); ++i)
        if (!mesh.positions.row(i).allFinite())
            throw Error(
                ErrorKind::argument,
                fmt::format("vertex {} of the {} has a coordinate that is not finite: mend the mesh", i, which));
    if (!(surface_area(mesh.positions, mesh.triangles) > 0))
        throw Error(ErrorKind::computation,
                    fmt::format("the {} has no area: all its faces are points or lines", which));
}

void check_options(const FitOptions& options) {
    if (options.max_rounds < 0)
        throw Error(ErrorKind::argument, fmt::format("{} rounds asked for: give 0 or more", options.max_rounds));
    if (!(options.threshold >= 0))
        throw Error(ErrorKind::argument, fmt::format("the threshold is {}: give 0 or more", options.threshold));
    if (!(std::abs(options.least_cosine) <= 1))
        throw Error(ErrorKind::argument, fmt::format("the least cosine is {}: give -1 to 1", options.least_cosine));
    if (!(options.marker_weight >= 0 && options.marker_weight <= most_marker_weight))
        throw Error(ErrorKind::argument, fmt::format("the marker weight is {}: give 0 to {}; for more, ask for exact "
                                                     "markers",
                                                     options.marker_weight, most_marker_weight));
}

void check_markers(const Mesh& source, std::span<const Marker> markers) {
    for (const Marker& marker : markers) {
        if (marker.source.triangle < 0 || marker.source.triangle >= source.triangles.rows())
            throw Error(ErrorKind::argument, fmt::format("marker '{}' is on face {}, but the source has {}",
                                                         marker.name, marker.source.triangle, source.triangles.rows()));
        if (!marker.source.barycentric.allFinite() || !marker.target.allFinite())
            throw Error(
                ErrorKind::argument,
                fmt::format("marker '{}' has a coordinate that is not finite: correct or remove it", marker.name));
    }
}

FitResult fit_by_method(const Mesh& source, const Mesh& target, std::span<const Marker> markers,
                        const FitOptions& options, const Progress& progress) {
    switch (options.method) {
    case FitMethod::paper:
        return paper_fit(source, target, markers, options, progress);
    case FitMethod::surface:
        return surface_fit(source, target, markers, options, progress);
    }
    throw Error(ErrorKind::argument, "no such way to fit");
}

// The file's numbering back, where seams were welded.
void expand(FitResult& result, const Weld& seams) {
    if (!seams.any()) return;
    result.positions = seams.expanded(result.positions);
    result.refused = seams.files_vertices(result.refused);
}

} // namespace

FitResult fit(const Mesh& source, const Mesh& target, std::span<const Marker> markers, const FitOptions& options,
              const Progress& progress) {
    check_options(options);
    check_mesh(source, "source");
    check_mesh(target, "target");
    check_markers(source, markers);
    const WholeMesh from(source, options.weld), to(target, options.weld);
    FitOptions inner = options;
    if (options.watch && from.seams.any())
        inner.watch = [&](const Points& x) { options.watch(from.seams.expanded(x)); };
    FitResult result = fit_by_method(from.mesh(), to.mesh(), markers, inner, progress);
    if (result.end != FitEnd::cancelled && options.markers_exact) meet_markers(result, from.mesh(), to.mesh(), markers);
    expand(result, from.seams);
    return result;
}

} // namespace meshtween
