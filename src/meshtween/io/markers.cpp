#include "meshtween/io/markers.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/io/marker_distance.h"
#include "meshtween/io/marker_names.h"
#include "meshtween/io/marker_sides.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

namespace meshtween {
namespace {
namespace fs = std::filesystem;

void refuse_repeated_names(const std::vector<MarkerRow>& rows, const fs::path& path) {
    std::map<std::string_view, const MarkerRow*> seen;
    for (const MarkerRow& row : rows) {
        if (row.name.empty()) continue;
        const auto [first, is_new] = seen.emplace(row.name, &row);
        if (!is_new)
            bad_file(path, fmt::format("marker '{}' comes twice, {} and {}; rename or delete one", row.name,
                                       first->second->where, row.where));
    }
}

bool is_named(const MarkerSide& side) {
    return std::none_of(side.rows.begin(), side.rows.end(), [](const MarkerRow& row) { return row.name.empty(); });
}

std::vector<std::string> names_of(const MarkerSide& side) {
    std::vector<std::string> names;
    for (const MarkerRow& row : side.rows) names.push_back(row.name);
    return names;
}

// Collects pairs whose two sides are there, and the names of those left out.
struct Collector {
    MarkerPairs result;
    std::vector<std::string> missing;

    void add(std::string name, const std::optional<Point>& source, const std::optional<Point>& target) {
        if (name.empty()) name = std::to_string(result.pairs.size() + missing.size() + 1);
        if (source && target)
            result.pairs.push_back({std::move(name), *source, *target});
        else
            missing.push_back(std::move(name));
    }
};

std::string some_of(const std::vector<std::string>& names) {
    constexpr std::size_t most = 10;
    const std::vector<std::string> some(names.begin(),
                                        names.begin() + static_cast<std::ptrdiff_t>(std::min(most, names.size())));
    return fmt::format("{}{}", fmt::join(some, ", "), names.size() > most ? ", ..." : "");
}

// Two pairs at one place of the source say the same twice, or contradict each other.
void settle_coincident(MarkerPairs& markers, const Mesh& source, const Mesh& target, const fs::path& path) {
    const double near_source = 1e-9 * diagonal(source), near_target = 1e-9 * diagonal(target);
    std::vector<MarkerPair>& pairs = markers.pairs;
    std::vector<std::size_t> order(pairs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<char> repeated(pairs.size(), 0);
    const auto sweep = [&](Point MarkerPair::*side, double reach, const auto& meet) {
        std::stable_sort(order.begin(), order.end(),
                         [&](std::size_t a, std::size_t b) { return (pairs[a].*side)[0] < (pairs[b].*side)[0]; });
        for (std::size_t i = 0; i < order.size(); ++i)
            for (std::size_t k = i + 1; k < order.size(); ++k) {
                const Point between = pairs[order[k]].*side - pairs[order[i]].*side;
                if (between[0] > reach) break;
                if (between.norm() <= reach) meet(std::min(order[i], order[k]), std::max(order[i], order[k]));
            }
    };
    sweep(&MarkerPair::source, near_source, [&](std::size_t a, std::size_t b) {
        if ((pairs[a].target - pairs[b].target).norm() > near_target)
            bad_file(path, fmt::format("markers '{}' and '{}' lie at one place of the source but at two of the target; "
                                       "move or delete one",
                                       pairs[a].name, pairs[b].name));
        if (repeated[b] == 0)
            markers.notes.push_back(fmt::format("{}: marker '{}' says the same as '{}' and is left out", path.string(),
                                                pairs[b].name, pairs[a].name));
        repeated[b] = 1;
    });
    sweep(&MarkerPair::target, near_target, [&](std::size_t a, std::size_t b) {
        if (repeated[a] == 0 && repeated[b] == 0)
            markers.notes.push_back(fmt::format("{}: markers '{}' and '{}' lie at one place of the target: the "
                                                "surface between them will be pressed together",
                                                path.string(), pairs[a].name, pairs[b].name));
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (repeated[i] == 0) {
            if (kept != i) pairs[kept] = std::move(pairs[i]);
            ++kept;
        }
    pairs.resize(kept);
}

using TwoSides = std::array<MarkerSide, 2>;

// Tells which markers lie off their meshes, each side under its own file; refuses what belongs to other models.
void add_distances(MarkerPairs& result, const TwoSides& sides) {
    std::vector<std::string> names, told;
    for (const MarkerPair& pair : result.pairs) names.push_back(pair.name);
    const std::array<NamedMesh, 2> meshes{NamedMesh{sides[0].mesh, "source"}, NamedMesh{sides[1].mesh, "target"}};
    const std::string systems = systems_to_say(sides);
    bool elsewhere = false;
    for (std::size_t k = 0; k < 2; ++k) {
        Points places(std::ssize(result.pairs), 3);
        for (Eigen::Index i = 0; i < places.rows(); ++i) {
            const MarkerPair& pair = result.pairs[static_cast<std::size_t>(i)];
            places.row(i) = k == 0 ? pair.source : pair.target;
        }
        const MarkerDistances far = marker_distances(places, names, meshes[k], meshes[1 - k], systems);
        if (far.note.empty()) continue;
        result.notes.push_back(fmt::format("{}: {}", sides[k].path.string(), far.note));
        const bool same_file = !told.empty() && sides[0].path == sides[1].path;
        told.push_back(same_file ? far.note : result.notes.back());
        elsewhere |= far.elsewhere;
        for (const std::string& name : far.far_names)
            if (std::find(result.far_names.begin(), result.far_names.end(), name) == result.far_names.end())
                result.far_names.push_back(name);
    }
    if (elsewhere) throw Error(ErrorKind::file, fmt::format("{}", fmt::join(told, "; and ")));
}

MarkerPairs finish(Collector collector, const TwoSides& sides, std::vector<std::string> notes) {
    MarkerPairs result = std::move(collector.result);
    result.notes = std::move(notes);
    const std::string start = sides[0].path.string() + ": ";
    if (!collector.missing.empty())
        result.notes.push_back(fmt::format("{}{} markers have no place on one side and are left out: {}", start,
                                           collector.missing.size(), some_of(collector.missing)));
    settle_coincident(result, *sides[0].mesh, *sides[1].mesh, sides[0].path);
    add_distances(result, sides);
    return result;
}

// Pairs by name; what is on one side only counts as missing.
Collector pair_by_name(const TwoSides& sides, std::vector<std::string>& notes) {
    const auto& [a, b] = sides;
    const NameMatch match = match_names(names_of(a), names_of(b));
    if (!match.note.empty()) notes.push_back(fmt::format("{}: {}", b.path.string(), match.note));
    std::vector<char> met(b.rows.size(), 0);
    Collector collector;
    for (std::size_t i = 0; i < a.rows.size(); ++i) {
        const std::optional<std::size_t> other = match.of[i];
        collector.add(a.rows[i].name, resolve(a, a.rows[i]), other ? resolve(b, b.rows[*other]) : std::nullopt);
        if (other) met[*other] = 1;
    }
    if (std::count(met.begin(), met.end(), 1) == 0 && !a.rows.empty() && !b.rows.empty())
        bad_file(b.path, fmt::format("none of its names is in {} ('{}' here, '{}' there); give corresponding markers "
                                     "the same name",
                                     a.path.string(), b.rows[0].name, a.rows[0].name));
    for (std::size_t i = 0; i < met.size(); ++i)
        if (met[i] == 0) collector.missing.push_back(b.rows[i].name);
    return collector;
}

Collector pair_by_order(const TwoSides& sides) {
    const auto& [a, b] = sides;
    if (a.rows.size() != b.rows.size())
        bad_file(b.path, fmt::format("holds {} markers, but {} holds {}; without names on both sides their numbers "
                                     "must agree",
                                     b.rows.size(), a.path.string(), a.rows.size()));
    Collector collector;
    for (std::size_t i = 0; i < a.rows.size(); ++i)
        collector.add(a.rows[i].name.empty() ? b.rows[i].name : a.rows[i].name, resolve(a, a.rows[i]),
                      resolve(b, b.rows[i]));
    return collector;
}

void add_notes(std::vector<std::string>& notes, const MarkerFile& file, const fs::path& path) {
    for (const std::string& note : file.notes) notes.push_back(fmt::format("{}: {}", path.string(), note));
}

// A file of pairs as two sides, row beside row.
TwoSides split(const MarkerFile& file, const fs::path& path, const Mesh& source, const Mesh& target,
               std::vector<std::string>& notes) {
    TwoSides sides{MarkerSide{path, {}, file.space, &source}, MarkerSide{path, {}, file.space, &target}};
    std::optional<std::size_t> taken;
    for (std::size_t k = 0; k < 2; ++k) {
        if (!file.specimens.empty()) {
            sides[k].rows = choose_specimen(file, path, *sides[k].mesh, k, taken, notes);
            continue;
        }
        for (const MarkerRow& row : file.rows) sides[k].rows.push_back({row.name, row.where, {row.places[k]}});
    }
    return sides;
}

// Whether each side lies on the other's mesh and not on its own.
bool are_exchanged(const TwoSides& sides) {
    const auto& [a, b] = sides;
    return lies_on(a, *b.mesh) && !lies_on(a, *a.mesh) && lies_on(b, *a.mesh) && !lies_on(b, *b.mesh);
}

} // namespace

MarkerPairs read_marker_pairs(const fs::path& path, const Mesh& source, const Mesh& target,
                              const MarkerReading& reading) {
    const MarkerFile file = read_marker_file(path);
    if (file.sides == 1 && file.specimens.size() < 2)
        bad_file(path, "holds points of one side only; give two files, the source's and the target's");
    refuse_repeated_names(file.rows, path);
    std::vector<std::string> notes;
    add_notes(notes, file, path);
    TwoSides sides = split(file, path, source, target, notes);
    settle_systems(sides, reading, notes);
    return finish(pair_by_order(sides), sides, std::move(notes));
}

MarkerPairs read_marker_pairs(const fs::path& source_path, const fs::path& target_path, const Mesh& source,
                              const Mesh& target, const MarkerReading& reading) {
    const std::array<const fs::path*, 2> paths{&source_path, &target_path};
    const std::array<const Mesh*, 2> meshes{&source, &target};
    TwoSides sides;
    std::vector<std::string> notes;
    std::optional<std::size_t> taken;
    for (std::size_t k = 0; k < 2; ++k) {
        const MarkerFile file = read_marker_file(*paths[k]);
        if (file.sides == 2) bad_file(*paths[k], "holds both sides already; give it alone");
        add_notes(notes, file, *paths[k]);
        if (k == 1 && source_path != target_path) taken.reset();
        sides[k] = {*paths[k], {}, file.space, meshes[k]};
        sides[k].rows = choose_specimen(file, *paths[k], *meshes[k], 0, taken, notes);
        refuse_repeated_names(sides[k].rows, *paths[k]);
    }
    settle_systems(sides, reading, notes);
    const bool exchanged = are_exchanged(sides);
    if (exchanged) {
        notes.push_back(fmt::format("{} lies on the target and {} on the source: the two files are taken the other way "
                                    "round",
                                    source_path.string(), target_path.string()));
        std::swap(sides[0], sides[1]);
        std::swap(sides[0].mesh, sides[1].mesh);
    }
    const bool named = is_named(sides[0]) && is_named(sides[1]);
    Collector collector = named ? pair_by_name(sides, notes) : pair_by_order(sides);
    MarkerPairs result = finish(std::move(collector), sides, std::move(notes));
    result.exchanged = exchanged;
    return result;
}

LandmarkList read_landmarks(const fs::path& path, const Mesh& mesh, const MarkerReading& reading) {
    const MarkerFile file = read_marker_file(path);
    if (file.sides == 2) bad_file(path, "holds both sides of pairs; a list of points of one side is needed here");
    LandmarkList result;
    add_notes(result.notes, file, path);
    std::optional<std::size_t> taken;
    std::array<MarkerSide, 1> sides{MarkerSide{path, {}, file.space, &mesh}};
    MarkerSide& side = sides[0];
    side.rows = choose_specimen(file, path, mesh, 0, taken, result.notes);
    refuse_repeated_names(side.rows, path);
    settle_systems(sides, reading, result.notes);
    std::vector<std::string> names, missing;
    Points places(std::ssize(side.rows), 3);
    for (const MarkerRow& row : side.rows) {
        const std::string name = row.name.empty() ? std::to_string(result.points.size() + 1) : row.name;
        result.points.push_back({name, resolve(side, row)});
        if (const auto& place = result.points.back().position)
            places.row(std::ssize(names)) = *place, names.push_back(name);
        else
            missing.push_back(name);
    }
    if (!missing.empty())
        result.notes.push_back(
            fmt::format("{}: {} points are missing: {}", path.string(), missing.size(), some_of(missing)));
    MarkerDistances far = marker_distances(places.topRows(std::ssize(names)), names, {&mesh, "mesh"}, {},
                                           systems_to_say(sides), "points");
    if (far.elsewhere && !reading.anywhere) bad_file(path, far.note);
    if (!far.note.empty()) result.notes.push_back(fmt::format("{}: {}", path.string(), far.note));
    result.far_names = std::move(far.far_names);
    return result;
}

} // namespace meshtween
