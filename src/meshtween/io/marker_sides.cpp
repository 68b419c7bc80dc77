#include "meshtween/io/marker_sides.h"

#include "meshtween/io/marker_distance.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace meshtween {
namespace {
namespace fs = std::filesystem;

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::string stem_of(const Mesh& mesh) {
    return mesh.file ? mesh.file->path.stem().string() : "";
}

std::string called(const Mesh& mesh) {
    return mesh.file ? mesh.file->path.string() : "the mesh";
}

MarkerPlace turned(const MarkerPlace& place) {
    if (const auto* point = std::get_if<Point>(&place)) return Point(-(*point)[0], -(*point)[1], (*point)[2]);
    return place; // a place on the mesh stays there
}

Points points_of(const std::vector<MarkerRow>& rows, bool turn) {
    Points points(std::ssize(rows), 3);
    Eigen::Index count = 0;
    for (const MarkerRow& row : rows) {
        const MarkerPlace place = turn ? turned(row.places[0]) : row.places[0];
        if (const auto* point = std::get_if<Point>(&place)) points.row(count++) = *point;
    }
    return points.topRows(count);
}

// The mesh's system, by where the markers lie as they are and turned; unknown where both or neither would do.
Space found_out(const MarkerSide& side) {
    const bool as_is = lie_on(points_of(side.rows, false), *side.mesh),
               turned_round = lie_on(points_of(side.rows, true), *side.mesh);
    if (as_is == turned_round) return Space::unknown;
    return as_is ? side.space : other(side.space);
}

bool name_two_systems(std::span<const MarkerSide> sides) {
    const auto named = [&](Space space) {
        return std::any_of(sides.begin(), sides.end(),
                           [&](const MarkerSide& side) { return side.space == space || side.mesh_space == space; });
    };
    return named(Space::ras) && named(Space::lps);
}

} // namespace

std::vector<MarkerRow> choose_specimen(const MarkerFile& file, const fs::path& path, const Mesh& mesh,
                                       std::size_t number, std::optional<std::size_t>& taken,
                                       std::vector<std::string>& notes) {
    const std::vector<Specimen>& all = file.specimens;
    if (all.empty()) return file.rows;
    if (all.size() == 1) return all[0].rows;
    const std::string stem = lower(stem_of(mesh));
    const auto named = std::find_if(all.begin(), all.end(), [&](const Specimen& s) {
        if (stem.empty() || taken == static_cast<std::size_t>(&s - all.data())) return false;
        return lower(s.id) == stem || lower(fs::path(s.id).stem().string()) == stem;
    });
    if (named != all.end()) {
        taken = static_cast<std::size_t>(named - all.begin());
        return named->rows;
    }
    std::size_t chosen = std::min(number, all.size() - 1);
    if (taken && *taken == chosen) chosen = (chosen + 1) % all.size();
    notes.push_back(fmt::format("{}: holds {} specimens, none named {} as the mesh is; number {}{} is taken",
                                path.string(), all.size(), stem.empty() ? "at all" : "'" + stem + "'", chosen + 1,
                                all[chosen].id.empty() ? "" : ", '" + all[chosen].id + "',"));
    taken = chosen;
    return all[chosen].rows;
}

void settle_systems(std::span<MarkerSide> sides, const MarkerReading& said, std::vector<std::string>& notes) {
    for (std::size_t i = 0; i < sides.size(); ++i) {
        MarkerSide& side = sides[i];
        side.mesh_space = space_of(*side.mesh);
        if (said.systems[i] == Space::unknown) continue;
        side.space = said.systems[i];
        if (side.mesh_space == Space::unknown) side.mesh_space = Space::lps;
    }
    if (!name_two_systems(sides)) return;
    std::vector<bool> silent(sides.size());
    for (std::size_t i = 0; i < sides.size(); ++i) {
        silent[i] = sides[i].mesh_space == Space::unknown && sides[i].space != Space::unknown;
        if (silent[i]) sides[i].mesh_space = found_out(sides[i]);
    }
    for (std::size_t i = 0; i < sides.size(); ++i) {
        MarkerSide& side = sides[i];
        if (side.space == Space::unknown) continue;
        if (side.mesh_space == Space::unknown && sides.size() == 2) side.mesh_space = sides[1 - i].mesh_space;
        if (side.mesh_space == Space::unknown) side.mesh_space = Space::lps;
        side.turned = side.space != side.mesh_space;
        if (!side.turned) continue;
        for (MarkerRow& row : side.rows) row.places[0] = turned(row.places[0]);
        notes.push_back(fmt::format("{}: its points are in {} and {} {} in {}: x and y are negated", side.path.string(),
                                    name_of(side.space), called(*side.mesh), silent[i] ? "seems to be" : "is",
                                    name_of(side.mesh_space)));
    }
}

std::optional<Point> resolve(const MarkerSide& side, const MarkerRow& row) {
    const Mesh& mesh = *side.mesh;
    const auto refuse = [&](const char* what, long long index, Eigen::Index count) {
        bad_file(side.path,
                 fmt::format("{}: {} {} is out of range: the mesh has {}, 0 to {}; is this file for another mesh?",
                             row.where, what, index, count, count - 1));
    };
    const MarkerPlace& place = row.places[0];
    if (const auto* point = std::get_if<Point>(&place)) return *point;
    if (const auto* vertex = std::get_if<long long>(&place)) {
        if (*vertex < 0 || *vertex >= mesh.positions.rows()) refuse("vertex", *vertex, mesh.positions.rows());
        return mesh.positions.row(static_cast<Eigen::Index>(*vertex));
    }
    if (const auto* on_surface = std::get_if<SurfacePoint>(&place)) {
        if (on_surface->triangle >= mesh.triangles.rows())
            refuse("triangle", on_surface->triangle, mesh.triangles.rows());
        return position(mesh.positions, mesh.triangles, *on_surface);
    }
    return std::nullopt;
}

std::vector<std::optional<Point>> resolve(const MarkerSide& side) {
    std::vector<std::optional<Point>> places;
    for (const MarkerRow& row : side.rows) places.push_back(resolve(side, row));
    return places;
}

bool lies_on(const MarkerSide& side, const Mesh& mesh) {
    return lie_on(points_of(side.rows, false), mesh);
}

std::string systems_to_say(std::span<const MarkerSide> sides) {
    std::string result;
    for (const MarkerSide& side : sides) {
        const Space mesh = side.mesh_space == Space::unknown ? Space::lps : side.mesh_space;
        const bool turn = !lies_on(side, *side.mesh) || have_wrong_signs(points_of(side.rows, false), *side.mesh);
        const std::string word(name_of(side.turned == turn ? mesh : other(mesh)));
        if (result != word) result += (result.empty() ? "" : ",") + word;
    }
    return result;
}

} // namespace meshtween
