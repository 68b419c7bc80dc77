#include "meshtween/fit/fit.h"

#include "meshtween/core/error.h"
#include "meshtween/fit/fitted_source.h"
#include "meshtween/fit/fitted_target.h"
#include "meshtween/fit/marker_doubts.h"
#include "meshtween/fit/meet_markers.h"
#include "meshtween/fit/paper_fit.h"
#include "meshtween/fit/surface_fit.h"
#include "meshtween/geometry/genus.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/seams.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <optional>

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

FitResult fit_by_method(const FittedSource& part, const Mesh& target, const FitOptions& options,
                        const Progress& progress) {
    switch (options.method) {
    case FitMethod::paper:
        return paper_fit(part.mesh(), target, part.markers, options, progress);
    case FitMethod::surface:
        return surface_fit(part.mesh(), target, part.markers, options, progress, part.cut_off);
    }
    throw Error(ErrorKind::argument, "no such way to fit");
}

// Empty where both shapes have as many handles.
std::string told_handles(const Mesh& source, const Mesh& target) {
    const std::optional<long> own = handles(source.positions, source.triangles),
                              other = handles(target.positions, target.triangles);
    if (!own || !other || *own == *other) return "";
    return fmt::format(
        "the source has {} and the target {}: no mesh follows both; where one is lacking, look whether a "
        "skin closes it well",
        counted(static_cast<std::size_t>(*own), "handle"), counted(static_cast<std::size_t>(*other), "handle"));
}

std::vector<std::string> told_doubts(const Mesh& source, std::span<const Marker> markers) {
    Points own(std::ssize(markers), 3), other(std::ssize(markers), 3);
    std::vector<std::string> names;
    for (std::size_t k = 0; k < markers.size(); ++k) {
        own.row(static_cast<Index>(k)) = position(source.positions, source.triangles, markers[k].source);
        other.row(static_cast<Index>(k)) = markers[k].target;
        names.push_back(markers[k].name);
    }
    return marker_doubts(own, other, names);
}

void tell_faults(FitResult& result) {
    if (!result.flipped.empty())
        result.notes.push_back(fmt::format("{} triangles look into the target's surface, the first of them {}",
                                           result.flipped.size(), result.flipped.front()));
    if (result.cuts.empty()) return;
    std::array<int, 2> first{INT_MAX, INT_MAX};
    for (const auto& [s, t] : result.cuts) first = std::min(first, {std::min(s, t), std::max(s, t)});
    result.notes.push_back(fmt::format("{} pairs of triangles cut each other where neither shape does, the first of "
                                       "them {} and {}",
                                       result.cuts.size(), first[0], first[1]));
}

// The file's numbering back, where seams were welded.
void expand(FitResult& result, const Weld& seams) {
    if (!seams.any()) return;
    result.positions = seams.expanded(result.positions);
    result.refused = seams.files_vertices(result.refused);
    result.carried = seams.files_vertices(result.carried);
}

} // namespace

FitResult fit(const Mesh& source, const Mesh& target, std::span<const Marker> markers, const FitOptions& options,
              const Progress& progress) {
    check_options(options);
    check_mesh(source, "source");
    check_mesh(target, "target");
    check_markers(source, markers);
    const WholeMesh from(source, options.weld), to(target, options.weld);
    const SoundFaces from_faces = sound_faces(from.mesh().positions, from.mesh().triangles),
                     to_faces = sound_faces(to.mesh().positions, to.mesh().triangles);
    const InnerFaces inner_walls =
        inner_faces(from.mesh().positions, from_faces, to.mesh().positions, to_faces, options.layer);
    const FittedSource part(from.mesh(), from_faces, markers, options, inner_walls.source);
    const FittedTarget onto(to.mesh(), to_faces, markers, options, inner_walls.target);
    FitOptions inner = options;
    if (options.watch && (from.seams.any() || !part.all))
        inner.watch = [&](const Points& x) {
            const Points whole = part.whole(x);
            options.watch(from.seams.any() ? from.seams.expanded(whole) : whole);
        };
    const std::string genus = told_handles(part.mesh(), onto.mesh());
    FitResult result = fit_by_method(part, onto.mesh(), inner, progress);
    if (result.end != FitEnd::cancelled && options.markers_exact)
        meet_markers(result, part.mesh(), onto.mesh(), part.markers);
    part.give_back(result);
    const std::vector<std::string> doubts = told_doubts(from.mesh(), markers);
    result.notes.insert(result.notes.begin(), doubts.begin(), doubts.end());
    if (doubts.empty() && !options.markers_exact) // else they are missed because of those, or met since
        for (const auto& [off, name] : result.missed)
            result.notes.push_back(
                fmt::format("marker '{}' ends {:.1f} % of the diagonal from its place: is it right?", name, 100 * off));
    result.left_out = onto.left_out;
    if (!genus.empty()) result.notes.insert(result.notes.begin(), genus);
    for (const auto* notes : {&onto.notes, &inner_walls.notes})
        result.notes.insert(result.notes.begin(), notes->begin(), notes->end());
    tell_faults(result);
    expand(result, from.seams);
    return result;
}

} // namespace meshtween
