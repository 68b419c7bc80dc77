// What a marker file says, before it is laid on a mesh and paired: one reader a format.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/io/space.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace meshtween {

// A place as a file gives it: missing, a point, a vertex's index, or a point of a triangle.
using MarkerPlace = std::variant<std::monostate, Point, long long, SurfacePoint>;

struct MarkerRow {
    std::string name;                // empty where the file has none
    std::string where;               // for messages: "line 7"
    std::vector<MarkerPlace> places; // one, or the source's and the target's
};

// The landmarks of one of several shapes in a file, with one place each.
struct Specimen {
    std::string id; // empty where the file has none
    std::vector<MarkerRow> rows;
};

struct MarkerFile {
    std::vector<MarkerRow> rows;
    std::size_t sides = 0;           // 1 or 2; 0 where there are no rows
    std::vector<Specimen> specimens; // instead of rows, in formats that hold several
    Space space = Space::unknown;    // that the file names
    std::vector<std::string> notes;  // what was decided or passed over while reading
};

// Chooses the format by the extension, and by the contents where several share one.
MarkerFile read_marker_file(const std::filesystem::path& path);

MarkerFile read_marker_table(std::string_view bytes, const std::filesystem::path& path);  // rows of cells
MarkerFile read_slicer_fcsv(std::string_view bytes, const std::filesystem::path& path);   // 3D Slicer
MarkerFile read_picked_points(std::string_view bytes, const std::filesystem::path& path); // MeshLab .pp
MarkerFile read_marker_json(std::string_view bytes, const std::filesystem::path& path);   // Slicer .mrk.json, Wrap
MarkerFile read_landmark_pts(std::string_view bytes, const std::filesystem::path& path);  // IDAV Landmark
MarkerFile read_tps(std::string_view bytes, const std::filesystem::path& path);
MarkerFile read_nts(std::string_view bytes, const std::filesystem::path& path); // Landmark's .dta, NTSYS
MarkerFile read_morphologika(std::string_view bytes, const std::filesystem::path& path);
MarkerFile read_amira(std::string_view bytes, const std::filesystem::path& path);       // .landmarkAscii
MarkerFile read_point_cloud(std::string_view bytes, const std::filesystem::path& path); // PLY, OBJ without faces

// The cells of a line, cut at the first of ; , tab and blanks that is there; quotes keep a cell together.
std::vector<std::string> cells_of(std::string_view line);

} // namespace meshtween
