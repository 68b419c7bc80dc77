#include "meshtween/fit/fitted_target.h"

#include "meshtween/fit/ground.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/portion.h"
#include "meshtween/io/text.h"
#include "meshtween/search/closest_point.h"

#include <fmt/format.h>

#include <algorithm>

namespace meshtween {
namespace {

constexpr double small = 0.01; // of the largest part's area
constexpr double off = 0.02;   // of the diagonal: a marker so far from the rest lies on the ground

std::size_t idx(auto i) {
    return static_cast<std::size_t>(i);
}

// A flag a part: it is small and no marker lies on it.
std::vector<char> small_parts(const Points& positions, const Triangles& triangles, const std::vector<int>& chosen,
                              const std::vector<int>& part, std::span<const Marker> markers) {
    const int count = *std::max_element(part.begin(), part.end()) + 1;
    std::vector<double> area(idx(count), 0.0);
    for (std::size_t i = 0; i < chosen.size(); ++i)
        area[idx(part[i])] += triangle_area(positions, triangles, chosen[i]);
    const double largest = *std::max_element(area.begin(), area.end());
    std::vector<char> result;
    for (const double a : area) result.push_back(a < small * largest);
    if (markers.empty() || std::ranges::none_of(result, [](char flag) { return flag != 0; })) return result;
    const ClosestPointIndex index(positions, triangles(chosen, Eigen::all));
    for (const Marker& marker : markers) result[idx(part[idx(index.closest(marker.target).where.triangle)])] = 0;
    return result;
}

// Takes the ground's triangles out, unless a marker lies on it alone; returns their part of the area.
double leave_ground(const Points& positions, const Triangles& triangles, std::span<const Marker> markers,
                    std::vector<int>& chosen) {
    const Triangles own = triangles(chosen, Eigen::all);
    const std::vector<char> ground = ground_faces(positions, own);
    if (std::ranges::none_of(ground, [](char flag) { return flag != 0; })) return 0;
    std::vector<int> rest, gone;
    for (std::size_t i = 0; i < chosen.size(); ++i) (ground[i] != 0 ? gone : rest).push_back(chosen[i]);
    const ClosestPointIndex without(positions, triangles(rest, Eigen::all));
    const double beside = off * diagonal(positions, triangles);
    for (const Marker& marker : markers)
        if (!without.closest(marker.target, Compatible{}, beside).found()) return 0;
    chosen = std::move(rest);
    return surface_area(positions, triangles(gone, Eigen::all)) / surface_area(positions, own);
}

} // namespace

FittedTarget::FittedTarget(const Mesh& given, const SoundFaces& faces, std::span<const Marker> markers,
                           const FitOptions& options, const std::vector<char>& inner)
    : target(&given) {
    if (faces.kept.empty()) return;
    std::vector<int> standing = faces.kept;
    const double ground = options.keep_parts ? 0 : leave_ground(given.positions, faces.triangles, markers, standing);
    const std::vector<int> part = parts_of(given.positions.rows(), faces.triangles, standing);
    std::vector<char> clutter(idx(*std::max_element(part.begin(), part.end()) + 1), 0);
    if (!options.keep_parts) clutter = small_parts(given.positions, faces.triangles, standing, part, markers);
    std::vector<int> chosen;
    for (std::size_t i = 0; i < part.size(); ++i)
        if (clutter[idx(part[i])] == 0 && (inner.empty() || inner[idx(standing[i])] == 0))
            chosen.push_back(standing[i]);
    if (chosen.empty() || chosen.size() == idx(given.triangles.rows())) return; // as it is, to the last bit
    all = false;
    std::vector<char> kept_flags(idx(given.triangles.rows()), 0);
    for (const int t : chosen) kept_flags[idx(t)] = 1;
    for (std::size_t t = 0; t < kept_flags.size(); ++t)
        if (kept_flags[t] == 0) left_out.push_back(static_cast<int>(t));
    Portion kept = portion(given.positions, faces.triangles, chosen);
    own.positions = std::move(kept.positions);
    own.triangles = std::move(kept.triangles);
    const auto note = [&](long count, std::string_view noun, std::string_view what) {
        if (count > 0) notes.push_back(fmt::format("{} {}", counted(idx(count), noun), what));
    };
    if (ground > 0)
        notes.push_back(fmt::format("a flat ground that reaches out from under the target, {:.0f} % of its area: left "
                                    "out (--keep-parts keeps all)",
                                    100 * ground));
    note(std::count(clutter.begin(), clutter.end(), 1), "part",
         "of the target without a marker, small beside the largest: left out (--keep-parts keeps all)");
    note(faces.collapsed, "face", "of the target without area: left out of the fit");
    note(faces.doubled, "face", "of the target that repeats another: left out of the fit");
}

} // namespace meshtween
