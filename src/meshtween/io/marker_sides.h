// The markers of one mesh, before the two sides are paired: chosen among specimens, in the mesh's system of
// coordinates.
#pragma once

#include "meshtween/io/marker_files.h"
#include "meshtween/io/markers.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace meshtween {

struct MarkerSide {
    std::filesystem::path path;
    std::vector<MarkerRow> rows; // of one place each
    Space space = Space::unknown;
    const Mesh* mesh = nullptr;
    Space mesh_space = Space::unknown; // what its file says, or what was found out
    bool turned = false;               // x and y are negated
};

// The rows of the specimen that is named as the mesh's file is, else the one of this number among those not `taken`.
std::vector<MarkerRow> choose_specimen(const MarkerFile& file, const std::filesystem::path& path, const Mesh& mesh,
                                       std::size_t number, std::optional<std::size_t>& taken,
                                       std::vector<std::string>& notes);

// Brings each side into its mesh's system: x and y are negated where the markers and the mesh name different ones. A
// mesh that names none has, where the rest names two: that in which the markers lie on it; else the other mesh's; else
// LPS, as 3D Slicer takes it. `said` is the person's word for each side's file, over what the file says; beside it a
// silent mesh is in LPS.
void settle_systems(std::span<MarkerSide> sides, const MarkerReading& said, std::vector<std::string>& notes);

// Where the row's place lies; nothing where it is missing. Throws Error(file) for an index that the mesh has not.
std::optional<Point> resolve(const MarkerSide& side, const MarkerRow& row);
std::vector<std::optional<Point>> resolve(const MarkerSide& side);

// Whether nearly all of the side's points lie on the mesh.
bool lies_on(const MarkerSide& side, const Mesh& mesh);

// What to give with --markers-system so that x and y of the sides that do not lie on their mesh
// change their signs and the others stay: "RAS", or "LPS,RAS" for two that differ.
std::string systems_to_say(std::span<const MarkerSide> sides);

} // namespace meshtween
