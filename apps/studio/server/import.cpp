#include "import.h"

#include "meshtween/core/error.h"
#include "meshtween/io/marker_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace meshtween::studio {
namespace fs = std::filesystem;
namespace {

constexpr double near_enough = 0.05; // of the diagonal, as the library's own warning

bool lies_on(const OpenMesh& mesh, const Point& point) {
    return point.allFinite() && std::sqrt(mesh.index.closest(point).squared_distance) <= near_enough * mesh.frame.scale;
}

// The part of the points that lie on a model; 0 where there are none.
double part_on(const OpenMesh& mesh, const std::vector<Point>& points) {
    const auto count = std::count_if(points.begin(), points.end(), [&](const Point& p) { return lies_on(mesh, p); });
    return points.empty() ? 0 : double(count) / double(points.size());
}

std::vector<Point> places_of(const std::vector<Landmark>& landmarks) {
    std::vector<Point> points;
    for (const Landmark& landmark : landmarks)
        if (landmark.position) points.push_back(*landmark.position);
    return points;
}

// The library leaves out what is not on both sides; here it waits for its other side.
std::vector<std::string> notes_of(const MarkerPairs& read) {
    std::vector<std::string> notes = read.notes;
    for (std::string& note : notes)
        if (const std::size_t at = note.find(" and are left out: "); at != std::string::npos)
            note.replace(at, 19, " and wait for it: ");
    return notes;
}

void take_pairs(const MarkerPairs& read, ImportedMarkers& result) {
    for (const MarkerPair& pair : read.pairs) result.markers.push_back({pair.name, pair.source, pair.target});
    for (std::string& note : notes_of(read)) result.notes.push_back(std::move(note));
}

std::optional<Point> place_of(const MarkerPlace& place, const Mesh& mesh) {
    if (const auto* point = std::get_if<Point>(&place)) return *point;
    if (const auto* vertex = std::get_if<long long>(&place)) return Point(mesh.positions.row(Eigen::Index(*vertex)));
    if (const auto* on_surface = std::get_if<SurfacePoint>(&place))
        return position(mesh.positions, mesh.triangles, *on_surface);
    return std::nullopt;
}

bool holds(const Specimen& specimen, const Point& point) {
    return std::any_of(specimen.rows.begin(), specimen.rows.end(), [&](const MarkerRow& row) {
        const auto* place = std::get_if<Point>(&row.places[0]);
        return place != nullptr && *place == point;
    });
}

// The rows of a file of pairs; two specimens side by side, in the order in which the library has taken them.
std::vector<MarkerRow> rows_of(const MarkerFile& file, const MarkerPairs& read) {
    if (file.specimens.size() != 2) return file.rows;
    const Specimen* source = file.specimens.data();
    const Specimen* target = source + 1;
    if (!read.pairs.empty() && !holds(*source, read.pairs[0].source) && holds(*target, read.pairs[0].source))
        std::swap(source, target);
    std::vector<MarkerRow> rows;
    for (std::size_t i = 0; i < std::min(source->rows.size(), target->rows.size()); ++i) {
        rows.push_back(source->rows[i]);
        rows.back().places.push_back(target->rows[i].places[0]);
    }
    return rows;
}

// Rows that have one side. The library has read the file before: indices are in range.
void take_halves(const std::vector<MarkerRow>& rows, const Mesh& source, const Mesh& target, ImportedMarkers& result) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const MarkerRow& row = rows[i];
        PartialPair pair{row.name.empty() ? std::to_string(i + 1) : row.name, place_of(row.places[0], source),
                         place_of(row.places[1], target)};
        if (pair.source.has_value() != pair.target.has_value()) result.markers.push_back(std::move(pair));
    }
}

// Points of one file that are in no pair.
void take_rest(const std::vector<Landmark>& landmarks, Side side, const MarkerPairs& read, ImportedMarkers& result) {
    for (const Landmark& landmark : landmarks) {
        if (!landmark.position) continue;
        const bool paired = std::any_of(read.pairs.begin(), read.pairs.end(), [&](const MarkerPair& pair) {
            return (side == Side::source ? pair.source : pair.target) == *landmark.position;
        });
        const bool known = std::any_of(result.markers.begin(), result.markers.end(),
                                       [&](const PartialPair& one) { return one.name == landmark.name; });
        if (paired || known) continue;
        PartialPair pair{landmark.name, {}, {}};
        (side == Side::source ? pair.source : pair.target) = landmark.position;
        result.markers.push_back(std::move(pair));
    }
}

// The side whose model the points lie on, where that is the one only.
std::optional<Side> side_by_place(const std::vector<Point>& points, const OpenMesh& source, const OpenMesh& target) {
    const double on_source = part_on(source, points), on_target = part_on(target, points);
    if (on_source >= 0.9 && on_target < 0.5) return Side::source;
    if (on_target >= 0.9 && on_source < 0.5) return Side::target;
    return std::nullopt;
}

// A list of one side. Files of indices fit whichever mesh they are read on, and are asked about.
ImportedMarkers one_side(const fs::path& file, const MarkerFile& raw, std::optional<Side> side, const OpenMesh& source,
                         const OpenMesh& target) {
    ImportedMarkers result;
    const bool of_points =
        !raw.specimens.empty() || std::any_of(raw.rows.begin(), raw.rows.end(), [](const MarkerRow& row) {
            return std::holds_alternative<Point>(row.places[0]);
        });
    const bool given = side.has_value();
    if (!given && of_points)
        side = side_by_place(places_of(read_landmarks(file, source.mesh, {.anywhere = true}).points), source, target);
    if (!side) {
        result.ask_side = true;
        return result;
    }
    const LandmarkList read = read_landmarks(file, (*side == Side::source ? source : target).mesh);
    result.notes = read.notes;
    take_rest(read.points, *side, {}, result);
    if (!given)
        result.notes.push_back(fmt::format("{} holds one side only; its points lie on the {}, and become that side of "
                                           "the markers",
                                           file.filename().string(), name_of(*side)));
    return result;
}

ImportedMarkers file_a_side(fs::path a, fs::path b, const OpenMesh& source, const OpenMesh& target) {
    ImportedMarkers result;
    const MarkerPairs read = read_marker_pairs(a, b, source.mesh, target.mesh);
    if (read.exchanged) std::swap(a, b);
    take_pairs(read, result);
    take_rest(read_landmarks(a, source.mesh, {.anywhere = true}).points, Side::source, read, result);
    take_rest(read_landmarks(b, target.mesh, {.anywhere = true}).points, Side::target, read, result);
    return result;
}

} // namespace

ImportedMarkers import_markers(const fs::path& file, const fs::path& second, std::optional<Side> side,
                               const OpenMesh& source, const OpenMesh& target) {
    if (!second.empty()) return file_a_side(file, second, source, target);
    const MarkerFile raw = read_marker_file(file);
    if (raw.sides == 1 && raw.specimens.size() != 2) return one_side(file, raw, side, source, target);
    ImportedMarkers result;
    const MarkerPairs read = read_marker_pairs(file, source.mesh, target.mesh);
    take_pairs(read, result);
    take_halves(rows_of(raw, read), source.mesh, target.mesh, result);
    return result;
}

} // namespace meshtween::studio
