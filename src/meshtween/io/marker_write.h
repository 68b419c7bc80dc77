// Markers and landmarks to files, in the format that the file's name says.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/io/markers.h"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace meshtween {

// A pair either side of which may be missing.
struct PartialPair {
    std::string name;
    std::optional<Point> source, target;
};

// A number for each landmark, which tables hold in a column of their own; none where it is empty.
struct LandmarkNumbers {
    std::string name;
    std::vector<double> values;
};

// The formats, by the end of a name in any case:
//   .csv .tsv         name,x,y,z or name,sx,sy,sz,tx,ty,tz; missing: empty cells
//   .pp               MeshLab's picked points; missing: active="0"
//   .fcsv .mrk.json   3D Slicer; missing: the position's status
//   .json             Wrap: [triangle, u, v] in the order of the points; missing ones are left out
//   .pts              IDAV Landmark; missing: 9999
//   .dta .tps .txt    Landmark's table, tps, morphologika: without names; missing: 9999, NA, NA
//   .landmarkAscii    Amira, Avizo: without names; missing: NaN
// .csv .tsv .dta .tps .txt and .landmarkAscii hold both sides in one file, the others one side a file.
bool is_marker_format(const std::filesystem::path& path);
bool holds_both_sides(const std::filesystem::path& path);
bool holds_names(const std::filesystem::path& path);

// The mesh, where it is known, says the specimen's name and the coordinate system that the headers of .fcsv and
// .mrk.json name (LPS where the mesh names none, as Slicer takes such a mesh). Wrap's .json cannot do without it. What
// the format cannot hold is told in the sentences that come back. Throws Error(argument): a format that is not known,
// that needs the mesh, or that holds one side only.
std::vector<std::string> write_landmarks(std::span<const Landmark> landmarks, const std::filesystem::path& path,
                                         const Mesh* mesh = nullptr, const LandmarkNumbers& numbers = {});
std::vector<std::string> write_markers(std::span<const PartialPair> pairs, const std::filesystem::path& path,
                                       const Mesh* source = nullptr, const Mesh* target = nullptr);

// A file a side; one that is missing on either side is left out of both where the format cannot mark it as missing, so
// that the order still pairs them.
std::vector<std::string> write_markers(std::span<const PartialPair> pairs, const std::filesystem::path& source_path,
                                       const std::filesystem::path& target_path, const Mesh* source = nullptr,
                                       const Mesh* target = nullptr);

// CSV whatever the name.
void write_marker_csv(std::span<const PartialPair> pairs, const std::filesystem::path& path);

} // namespace meshtween
