// Pairs of corresponding points, and lists of points, from files: CSV and other tables, MeshLab .pp, Slicer .fcsv and
// .mrk.json, Wrap .json, IDAV .pts and .dta, tps, morphologika, .landmarkAscii, vertices of PLY and OBJ, lists of
// indices.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/io/space.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace meshtween {

struct MarkerPair {
    std::string name;
    Point source{0, 0, 0}; // on or near the source's surface
    Point target{0, 0, 0};
};

struct MarkerPairs {
    std::vector<MarkerPair> pairs;
    std::vector<std::string> notes; // what was left out or looks wrong, a sentence each, for people; it names the file
    std::vector<std::string> far_names; // of pairs that lie off a mesh, as the notes say
    bool exchanged = false;             // the two files came in the other order
};

// What the person says about the files: the system that their coordinates are in, over what the files say.
struct MarkerReading {
    std::array<Space, 2> systems{Space::unknown, Space::unknown}; // the source's file and the target's
    bool anywhere = false; // points of another model are read too, to find out which model they are of
};

// One file for both sides. Names pairs by the file's names, else by their number from 1. Index and barycentric formats
// are resolved on the meshes, counted from 0. Pairs with a missing side, and pairs that say the same as another, are
// left out and told in the notes; so are markers that lie off their mesh, with the likely cause. Where markers and
// meshes name different systems of coordinates, x and y are negated, and a note says so. Of a file of several specimens
// those named as the meshes' files are taken, else the first two. Throws Error(file)
// naming file and line: a name that comes twice, an index out of range, two pairs that contradict each other, markers
// most of which lie further from their mesh than a quarter of its diagonal. How many are enough is for the fit to say.
MarkerPairs read_marker_pairs(const std::filesystem::path& path, const Mesh& source, const Mesh& target,
                              const MarkerReading& reading = {});

// One file a side, matched by name, or by what is the same in the names (by order where neither has names; then their
// numbers must agree). Files that lie on each other's mesh are exchanged, and a note says so.
MarkerPairs read_marker_pairs(const std::filesystem::path& source_path, const std::filesystem::path& target_path,
                              const Mesh& source, const Mesh& target, const MarkerReading& reading = {});

void write_marker_pairs(const std::vector<MarkerPair>& pairs, const std::filesystem::path& path); // our CSV

// A named point of one side; no position where it is missing.
struct Landmark {
    std::string name;
    std::optional<Point> position;
};

struct LandmarkList {
    std::vector<Landmark> points;              // in the file's order, missing ones too
    std::vector<std::string> notes, far_names; // as those of pairs
};

// A file of one side on or near a mesh, in any of the formats. Throws as read_marker_pairs.
LandmarkList read_landmarks(const std::filesystem::path& path, const Mesh& mesh, const MarkerReading& reading = {});

// Rows x,y,z under an optional header, n x 3: a known correspondence, a row a vertex.
Points read_points(const std::filesystem::path& path);
void write_points(const Points& points, const std::filesystem::path& path);

} // namespace meshtween
