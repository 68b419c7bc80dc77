#include "meshtween/fit/fitted_source.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/io/text.h"
#include "meshtween/search/closest_point.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

namespace meshtween {
namespace {

std::size_t idx(auto i) {
    return static_cast<std::size_t>(i);
}

std::vector<int> marked_triangles(std::span<const Marker> markers) {
    std::vector<int> marked;
    for (const Marker& marker : markers) marked.push_back(marker.source.triangle);
    std::sort(marked.begin(), marked.end());
    return marked;
}

// The markers on the fitted mesh: on their own triangle where it is there, else on the nearest place.
std::vector<Marker> moved_to(const Portion& fitted, const Mesh& source, std::span<const Marker> markers) {
    std::vector<int> of(idx(source.triangles.rows()), -1);
    for (std::size_t t = 0; t < fitted.triangle.size(); ++t) of[idx(fitted.triangle[t])] = static_cast<int>(t);
    std::vector<Marker> moved(markers.begin(), markers.end());
    std::optional<ClosestPointIndex> index;
    for (Marker& marker : moved) {
        const int t = of[idx(marker.source.triangle)];
        if (t >= 0) {
            marker.source.triangle = t;
            continue;
        }
        if (!index) index.emplace(fitted.positions, fitted.triangles);
        marker.source = index->closest(position(source.positions, source.triangles, marker.source)).where;
    }
    return moved;
}

// Without the connected patches of free triangles that a marker lies on.
void keep_marked(const Triangles& triangles, Eigen::Index vertices, const std::vector<int>& marked,
                 std::vector<char>& free) {
    std::vector<int> all;
    for (std::size_t t = 0; t < free.size(); ++t)
        if (free[t] != 0) all.push_back(static_cast<int>(t));
    const std::vector<int> patch = parts_of(vertices, triangles, all);
    std::set<int> kept;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (std::binary_search(marked.begin(), marked.end(), all[i])) kept.insert(patch[i]);
    for (std::size_t i = 0; i < all.size(); ++i)
        if (kept.contains(patch[i])) free[idx(all[i])] = 0;
}

// Small pieces of what is fitted that hang on a free region alone belong to it.
void move_islands(const Mesh& mesh, const Triangles& triangles, const std::vector<int>& marked, PartsMode mode,
                  std::vector<int>& chosen, std::vector<int>& region) {
    const std::vector<int> part = parts_of(mesh.positions.rows(), triangles, chosen);
    const std::vector<char> none(idx(triangles.rows()), 0);
    const std::vector<char> island = following_parts(mesh.positions, triangles, chosen, part, marked, none,
                                                     mode == PartsMode::fit ? PartsMode::automatic : mode);
    std::vector<int> kept;
    for (std::size_t i = 0; i < chosen.size(); ++i) (island[idx(part[i])] != 0 ? region : kept).push_back(chosen[i]);
    std::sort(region.begin(), region.end());
    chosen = std::move(kept);
}

} // namespace

FittedSource::FittedSource(const Mesh& given, const SoundFaces& faces, std::span<const Marker> given_markers,
                           const FitOptions& options, const std::vector<char>& free_faces)
    : source(&given), markers(given_markers.begin(), given_markers.end()) {
    const std::vector<int> marked = marked_triangles(markers);
    const std::vector<int> part = parts_of(given.positions.rows(), faces.triangles, faces.kept);
    std::vector<char> free = free_faces;
    free.resize(idx(given.triangles.rows()), 0);
    keep_marked(faces.triangles, given.positions.rows(), marked, free);
    const std::vector<char> follows =
        following_parts(given.positions, faces.triangles, faces.kept, part, marked, free, options.parts);
    std::vector<int> chosen, region;
    std::vector<std::vector<int>> loose(follows.size());
    for (std::size_t i = 0; i < faces.kept.size(); ++i) {
        const int t = faces.kept[i];
        (follows[idx(part[i])] != 0 ? loose[idx(part[i])] : free[idx(t)] != 0 ? region : chosen).push_back(t);
    }
    if (!region.empty()) move_islands(given, faces.triangles, marked, options.parts, chosen, region);
    if (chosen.empty() || chosen.size() == idx(given.triangles.rows())) return; // as it is, to the last bit
    all = false;
    fitted = portion(given.positions, faces.triangles, chosen);
    own.positions = fitted.positions;
    own.triangles = fitted.triangles;
    std::vector<char> taken(faces.vertex.size(), 0);
    const auto taking = [&](Portion some) {
        for (const int v : some.vertex) taken[idx(v)] = 1;
        return some;
    };
    taking(fitted);
    for (const std::vector<int>& triangles : loose)
        if (!triangles.empty()) carried.parts.push_back(taking(portion(given.positions, faces.triangles, triangles)));
    if (!region.empty()) {
        carried.region = taking(portion(given.positions, faces.triangles, region));
        for (const int v : carried.region.vertex)
            if (const int own_number = fitted.of_vertex[idx(v)]; own_number >= 0) cut_off.push_back(own_number);
    }
    stand_in = faces.vertex;
    for (std::size_t v = 0; v < taken.size(); ++v)
        if (stand_in[v] == static_cast<int>(v) && taken[v] == 0) carried.strays.push_back(static_cast<int>(v));
    markers = moved_to(fitted, given, given_markers);
    const auto note = [&](long count, std::string_view noun, std::string_view what) {
        if (count > 0) notes.push_back(fmt::format("{} {}", counted(idx(count), noun), what));
    };
    note(std::ssize(carried.parts), "loose part",
         "of the source without a marker, small or inside: carried along by the surface around instead of fitted "
         "(--parts fit fits all)");
    if (!region.empty())
        notes.push_back(fmt::format("{:.0f} % of the source's area is hidden from outside, and the target has no such "
                                    "part: it is not drawn to the target but goes along with the rest",
                                    100 * surface_area(carried.region.positions, carried.region.triangles) /
                                        surface_area(given.positions, given.triangles)));
    note(faces.collapsed, "face", "of the source without area: left out of the fit");
    note(faces.doubled, "face", "of the source that repeats another: left out of the fit");
}

Points FittedSource::whole(const Points& now) const {
    if (all) return now;
    Points x = source->positions;
    put_rows(fitted, now, x);
    carry(fitted, now, carried, source->positions, x);
    return x(stand_in, Eigen::all);
}

void FittedSource::give_back(FitResult& result) const {
    if (all) return;
    result.positions = whole(result.positions);
    std::vector<char> is_fitted(stand_in.size(), 0);
    for (const int v : fitted.vertex) is_fitted[idx(v)] = 1;
    for (std::size_t v = 0; v < stand_in.size(); ++v)
        if (is_fitted[idx(stand_in[v])] == 0) result.carried.push_back(static_cast<int>(v));
    const auto renamed = [](const std::vector<int>& names, std::vector<int>& list) {
        for (int& i : list) i = names[idx(i)];
        std::sort(list.begin(), list.end());
    };
    renamed(fitted.vertex, result.refused);
    renamed(fitted.triangle, result.mended);
    renamed(fitted.triangle, result.flipped);
    for (auto& pair : result.cuts) pair = {fitted.triangle[idx(pair[0])], fitted.triangle[idx(pair[1])]};
    result.notes.insert(result.notes.begin(), notes.begin(), notes.end());
}

} // namespace meshtween
