// What a person has made in the studio, as one readable JSON file.
#pragma once

#include "events.h"

#include "meshtween/core/mesh.h"

#include <filesystem>
#include <optional>
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
    Json symmetry = Json::object(); // the page's own: plane and switch
    Json timing = Json::object();   // when each part moves, see timing.h
    Json options = Json::object();  // {"fit": {...}, "morph": {...}}
    Json fit;                       // what the last fit found out; null where there is none

    MeshFile& file(Side side) { return side == Side::source ? source : target; }
    const MeshFile& file(Side side) const { return side == Side::source ? source : target; }
};

Json to_json(const std::vector<PlacedMarker>& markers);
// Throws Error(argument) naming the marker: no or a repeated id, a coordinate that is not a finite number, too many.
std::vector<PlacedMarker> markers_from_json(const Json& json);

// Paths inside `folder`, where the file lies, are written relative to it.
Json to_json(const Project& project, const std::filesystem::path& folder);
Project project_from_json(const Json& json, const std::filesystem::path& folder); // throws Error(argument)

// 16 hexadecimal digits, of a file's bytes (throws Error(file)) and of these bytes.
std::string hash_of(const std::filesystem::path& file);
std::string hash_of_bytes(std::string_view bytes);

} // namespace meshtween::studio
