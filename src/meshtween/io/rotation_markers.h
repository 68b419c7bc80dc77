// Points that turn and points that stay, for a rotational deformation.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/io/markers.h"

#include <filesystem>
#include <string>
#include <vector>

namespace meshtween {

struct RotationMarkers {
    Points turn, hold;              // a row a point
    std::vector<std::string> notes; // as those of marker pairs
};

// A table of name,x,y,z,role, under a header with the columns in any order; role is "turn" or "hold". In the mesh's
// system of coordinates, as marker pairs are. Throws Error(file) naming the line.
RotationMarkers read_rotation_markers(const std::filesystem::path& path, const Mesh& mesh,
                                      const MarkerReading& reading = {});

} // namespace meshtween
