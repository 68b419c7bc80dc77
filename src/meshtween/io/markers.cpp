#include "meshtween/io/markers.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/io/marker_distance.h"
#include "meshtween/io/marker_files.h"
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

// Where a place lies on the mesh; nothing where it is missing.
std::optional<Point> resolve(const MarkerPlace& place, const Mesh& mesh, const fs::path& path, const MarkerRow& row) {
    const auto refuse = [&](const char* what, long long index, Eigen::Index count) {
        bad_file(path,
                 fmt::format("{}: {} {} is out of range: the mesh has {}, 0 to {}; is this file for another mesh?",
                             row.where, what, index, count, count - 1));
    };
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

void refuse_repeated_names(const MarkerFile& file, const fs::path& path) {
    std::map<std::string_view, const MarkerRow*> seen;
    for (const MarkerRow& row : file.rows) {
        if (row.name.empty()) continue;
        const auto [first, is_new] = seen.emplace(row.name, &row);
        if (!is_new)
            bad_file(path, fmt::format("marker '{}' comes twice, {} and {}; rename or delete one", row.name,
                                       first->second->where, row.where));
    }
}

bool is_named(const MarkerFile& file) {
    return std::none_of(file.rows.begin(), file.rows.end(), [](const MarkerRow& row) { return row.name.empty(); });
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
    const double near_source = 1e-9 * diagonal(source.positions), near_target = 1e-9 * diagonal(target.positions);
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
            markers.notes.push_back(
                fmt::format("marker '{}' says the same as '{}' and is left out", pairs[b].name, pairs[a].name));
        repeated[b] = 1;
    });
    sweep(&MarkerPair::target, near_target, [&](std::size_t a, std::size_t b) {
        if (repeated[a] == 0 && repeated[b] == 0)
            markers.notes.push_back(fmt::format("markers '{}' and '{}' lie at one place of the target: the surface "
                                                "between them will be pressed together",
                                                pairs[a].name, pairs[b].name));
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (repeated[i] == 0) {
            if (kept != i) pairs[kept] = std::move(pairs[i]);
            ++kept;
        }
    pairs.resize(kept);
}

MarkerPairs finish(Collector collector, const Mesh& source, const Mesh& target, const fs::path& path) {
    MarkerPairs result = std::move(collector.result);
    if (!collector.missing.empty())
        result.notes.push_back(fmt::format("{} markers have no place on one side and are left out: {}",
                                           collector.missing.size(), some_of(collector.missing)));
    settle_coincident(result, source, target, path);
    MarkerDistances distances = marker_distances(result.pairs, source, target);
    if (distances.elsewhere) bad_file(path, fmt::format("{}", fmt::join(distances.notes, "; and ")));
    for (std::string& note : distances.notes) result.notes.push_back(std::move(note));
    return result;
}

// Pairs by name; what is on one side only counts as missing.
Collector pair_by_name(const MarkerFile& a, const MarkerFile& b, const auto& source_place, const auto& target_place,
                       const fs::path& source_path, const fs::path& target_path) {
    std::map<std::string_view, const MarkerRow*> others;
    for (const MarkerRow& row : b.rows) others.emplace(row.name, &row);
    Collector collector;
    for (const MarkerRow& row : a.rows) {
        const auto other = others.find(row.name);
        collector.add(row.name, source_place(row), other == others.end() ? std::nullopt : target_place(*other->second));
        if (other != others.end()) others.erase(other);
    }
    if (others.size() == b.rows.size() && !a.rows.empty() && !b.rows.empty())
        bad_file(target_path,
                 fmt::format("none of its names is in {} ('{}' here, '{}' there); give corresponding markers "
                             "the same name",
                             source_path.string(), b.rows[0].name, a.rows[0].name));
    for (const MarkerRow& row : b.rows)
        if (others.count(row.name) != 0) collector.missing.push_back(row.name);
    return collector;
}

} // namespace

MarkerPairs read_marker_pairs(const fs::path& path, const Mesh& source, const Mesh& target) {
    const MarkerFile file = read_marker_file(path);
    if (file.sides == 1) bad_file(path, "holds points of one side only; give two files, the source's and the target's");
    refuse_repeated_names(file, path);
    Collector collector;
    for (const MarkerRow& row : file.rows)
        collector.add(row.name, resolve(row.places[0], source, path, row), resolve(row.places[1], target, path, row));
    return finish(std::move(collector), source, target, path);
}

Landmarks read_landmarks(const fs::path& path, const Mesh& mesh) {
    const MarkerFile file = read_marker_file(path);
    if (file.sides == 2) bad_file(path, "holds both sides of pairs; a list of points of one side is needed here");
    refuse_repeated_names(file, path);
    Landmarks result;
    for (const MarkerRow& row : file.rows)
        result.points.push_back({row.name.empty() ? std::to_string(result.points.size() + 1) : row.name,
                                 resolve(row.places[0], mesh, path, row)});
    return result;
}

MarkerPairs read_marker_pairs(const fs::path& source_path, const fs::path& target_path, const Mesh& source,
                              const Mesh& target) {
    const MarkerFile a = read_marker_file(source_path), b = read_marker_file(target_path);
    for (const auto& [file, path] : {std::pair(&a, &source_path), std::pair(&b, &target_path)}) {
        if (file->sides == 2) bad_file(*path, "holds both sides already; give it alone");
        refuse_repeated_names(*file, *path);
    }
    const auto source_place = [&](const MarkerRow& row) { return resolve(row.places[0], source, source_path, row); };
    const auto target_place = [&](const MarkerRow& row) { return resolve(row.places[0], target, target_path, row); };
    if (is_named(a) && is_named(b))
        return finish(pair_by_name(a, b, source_place, target_place, source_path, target_path), source, target,
                      source_path);
    if (a.rows.size() != b.rows.size())
        bad_file(target_path,
                 fmt::format("holds {} markers, but {} holds {}; without names on both sides their numbers "
                             "must agree",
                             b.rows.size(), source_path.string(), a.rows.size()));
    Collector collector;
    for (std::size_t i = 0; i < a.rows.size(); ++i)
        collector.add(a.rows[i].name.empty() ? b.rows[i].name : a.rows[i].name, source_place(a.rows[i]),
                      target_place(b.rows[i]));
    return finish(std::move(collector), source, target, source_path);
}

} // namespace meshtween
