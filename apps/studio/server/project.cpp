#include "project.h"

#include "meshtween/core/error.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <set>

namespace meshtween::studio {
namespace {

constexpr std::size_t most_markers = 5000, longest_name = 200;
constexpr int version = 1;

// FNV-1a over 64 bits: it tells a changed file from an unchanged one and guards against nothing else.
constexpr std::uint64_t hash_of_nothing = 14695981039346656037ULL;
std::uint64_t hash_on(std::uint64_t hash, std::string_view bytes) {
    for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    return hash;
}

Json to_json(const std::optional<Point>& point) {
    if (!point) return nullptr;
    return {(*point)[0], (*point)[1], (*point)[2]};
}

std::string text_in(const Json& object, const char* key, const std::string& what) {
    const auto found = object.find(key);
    if (found == object.end()) return {};
    if (!found->is_string() || found->get_ref<const std::string&>().size() > longest_name)
        throw Error(ErrorKind::argument,
                    fmt::format("{}: {} must be text of at most {} bytes", what, key, longest_name));
    return *found;
}

std::optional<Point> point_in(const Json& object, const char* key, const std::string& what) {
    const auto found = object.find(key);
    if (found == object.end() || found->is_null()) return std::nullopt;
    Point point;
    if (!found->is_array() || found->size() != 3)
        throw Error(ErrorKind::argument, fmt::format("{}: {} must be three numbers or null", what, key));
    for (std::size_t i = 0; i < 3; ++i) {
        const Json& value = (*found)[i];
        if (!value.is_number() || !std::isfinite(value.get<double>()))
            throw Error(ErrorKind::argument, fmt::format("{}: {} must be three finite numbers", what, key));
        point[static_cast<Eigen::Index>(i)] = value;
    }
    return point;
}

PlacedMarker marker_from_json(const Json& json, std::size_t number) {
    const std::string what = fmt::format("marker {}", number);
    if (!json.is_object()) throw Error(ErrorKind::argument, what + " must be an object");
    PlacedMarker marker;
    marker.id = text_in(json, "id", what);
    if (marker.id.empty()) throw Error(ErrorKind::argument, what + " has no id");
    marker.name = text_in(json, "name", what);
    marker.twin = text_in(json, "twin", what);
    marker.source = point_in(json, "source", what);
    marker.target = point_in(json, "target", what);
    const auto locked = json.find("locked");
    marker.locked = locked != json.end() && locked->is_boolean() && locked->get<bool>();
    return marker;
}

// What older files hold: two markers of one name could not be told apart in any file of markers.
void number_doubled_names(std::vector<PlacedMarker>& markers) {
    std::set<std::string> names;
    for (const PlacedMarker& marker : markers) names.insert(marker.name);
    std::set<std::string> seen;
    for (PlacedMarker& marker : markers) {
        if (marker.name.empty() || seen.insert(marker.name).second) continue;
        int number = 2;
        while (names.contains(fmt::format("{} {}", marker.name, number))) ++number;
        marker.name = fmt::format("{} {}", marker.name, number);
        names.insert(marker.name);
        seen.insert(marker.name);
    }
}

Json object_in(const Json& json, const char* key) {
    const auto found = json.find(key);
    return found != json.end() && found->is_object() ? *found : Json::object();
}

} // namespace

Json to_json(const MeshFile& file, const std::filesystem::path& folder) {
    if (file.path.empty()) return nullptr;
    const auto relative = file.path.lexically_relative(folder);
    const bool inside = !relative.empty() && *relative.begin() != "..";
    return {{"path", (inside ? relative : file.path).string()}, {"hash", file.hash}};
}

MeshFile file_from_json(const Json& json, const std::filesystem::path& folder) {
    if (!json.is_object() || !json.contains("path") || !json["path"].is_string()) return {};
    const std::filesystem::path path = json["path"].get<std::string>();
    const auto hash = json.find("hash");
    return {(folder / path).lexically_normal(), hash != json.end() && hash->is_string() ? *hash : Json("")};
}

Side side_of(std::string_view name) {
    if (name == "source") return Side::source;
    if (name == "target") return Side::target;
    throw Error(ErrorKind::argument, fmt::format("\"{}\" is no side; use source or target", name.substr(0, 20)));
}

std::string_view name_of(Side side) {
    return side == Side::source ? "source" : "target";
}

Json to_json(const std::vector<PlacedMarker>& markers) {
    Json list = Json::array();
    for (const PlacedMarker& marker : markers) {
        Json row{{"id", marker.id},
                 {"name", marker.name},
                 {"source", to_json(marker.source)},
                 {"target", to_json(marker.target)},
                 {"locked", marker.locked}};
        if (!marker.twin.empty()) row["twin"] = marker.twin;
        list.push_back(std::move(row));
    }
    return list;
}

std::vector<PlacedMarker> markers_from_json(const Json& json) {
    if (!json.is_array()) throw Error(ErrorKind::argument, "markers must be a list");
    if (json.size() > most_markers)
        throw Error(ErrorKind::argument, fmt::format("{} markers are too many; {} at most", json.size(), most_markers));
    std::vector<PlacedMarker> markers;
    std::set<std::string> ids;
    for (const Json& row : json) {
        markers.push_back(marker_from_json(row, markers.size() + 1));
        if (!ids.insert(markers.back().id).second)
            throw Error(ErrorKind::argument, fmt::format("two markers have the id {}", markers.back().id));
    }
    return markers;
}

void refuse_doubled_names(const std::vector<PlacedMarker>& markers) {
    std::set<std::string_view> names;
    for (const PlacedMarker& marker : markers)
        if (!marker.name.empty() && !names.insert(marker.name).second)
            throw Error(ErrorKind::argument,
                        fmt::format("two markers are called \"{}\"; give one of them another name", marker.name));
}

Json to_json(const Project& project, const std::filesystem::path& folder) {
    Json named = Json::array();
    for (const auto& path : project.named) named.push_back(path.string());
    return {{"meshtween_project", version},
            {"source", to_json(project.source, folder)},
            {"target", to_json(project.target, folder)},
            {"symmetry", project.symmetry},
            {"timing", project.timing},
            {"options", project.options},
            {"markers", to_json(project.markers)},
            {"named", named},
            {"fit", project.fit}};
}

Project project_from_json(const Json& json, const std::filesystem::path& folder) {
    if (!json.is_object() || !json.contains("meshtween_project"))
        throw Error(ErrorKind::argument, "this is no meshtween project");
    if (json["meshtween_project"] != version)
        throw Error(ErrorKind::argument, fmt::format("this project is of version {}; this program reads version {}",
                                                     json["meshtween_project"].dump().substr(0, 20), version));
    Project project;
    project.source = file_from_json(json.value("source", Json()), folder);
    project.target = file_from_json(json.value("target", Json()), folder);
    project.markers = markers_from_json(json.value("markers", Json::array()));
    number_doubled_names(project.markers);
    project.symmetry = object_in(json, "symmetry");
    project.timing = object_in(json, "timing");
    project.options = object_in(json, "options");
    for (const Json& path : json.value("named", Json::array()))
        if (path.is_string()) project.named.insert(path.get<std::string>());
    project.fit = json.value("fit", Json());
    return project;
}

std::string hash_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw Error(ErrorKind::file, fmt::format("{}: cannot be read", file.string()));
    std::uint64_t hash = hash_of_nothing;
    std::string block(1 << 20, '\0');
    while (in) {
        in.read(block.data(), std::streamsize(block.size()));
        hash = hash_on(hash, std::string_view(block).substr(0, std::size_t(in.gcount())));
    }
    return fmt::format("{:016x}", hash);
}

std::string hash_of_bytes(std::string_view bytes) {
    return fmt::format("{:016x}", hash_on(hash_of_nothing, bytes));
}

} // namespace meshtween::studio
