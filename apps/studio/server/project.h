// What a person has made in the studio, as one readable JSON file.
#pragma once

#include "events.h"

#include "meshtween/core/mesh.h"

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace meshtween::studio {

enum class Side { source, target };
Side side_of(std::string_view name); // "source" or "target"; throws Error(argument)
std::string_view name_of(Side side);

// A marker may have one side only; points are in the mesh's own coordinates.
struct PlacedMarker {
    std::string id, name;
    std::optional<Point> source, target;
    bool locked = false;
    std::string twin; // id of its mirror twin; empty where it has none

    const std::optional<Point>& on(Side side) const { return side == Side::source ? source : target; }
};

struct MeshFile {
    std::filesystem::path path; // absolute; empty where none is open
    std::string hash;           // of the file's bytes
};

struct Project {
    MeshFile source, target;
    std::vector<PlacedMarker> markers;
    Json symmetry = Json::object();        // the page's own: plane and switch
    Json timing = Json::object();          // when each part moves, see timing.h
    Json options = Json::object();         // {"fit": {...}, "morph": {...}}
    std::set<std::filesystem::path> named; // files elsewhere that were its models before: undo may bring them back
    Json fit;                              // what the last fit found out; null where there is none

    MeshFile& file(Side side) { return side == Side::source ? source : target; }
    const MeshFile& file(Side side) const { return side == Side::source ? source : target; }
};

// {path, hash}, the path relative where the file lies in `folder`; null where there is none.
Json to_json(const MeshFile& file, const std::filesystem::path& folder);
MeshFile file_from_json(const Json& json, const std::filesystem::path& folder);

Json to_json(const std::vector<PlacedMarker>& markers);
// Throws Error(argument) naming the marker: no or a repeated id, a coordinate that is not a finite number, too many.
std::vector<PlacedMarker> markers_from_json(const Json& json);
// Throws Error(argument) where two markers have one name. Names may be empty: such markers go by their number.
void refuse_doubled_names(const std::vector<PlacedMarker>& markers);

// Paths inside `folder`, where the file lies, are written relative to it.
Json to_json(const Project& project, const std::filesystem::path& folder);
// Of several markers with one name all but the first get a number behind it. Throws Error(argument).
Project project_from_json(const Json& json, const std::filesystem::path& folder);

// 16 hexadecimal digits, of a file's bytes (throws Error(file)) and of these bytes.
std::string hash_of(const std::filesystem::path& file);
std::string hash_of_bytes(std::string_view bytes);

} // namespace meshtween::studio
