// Points that turn and points that stay, for a rotational deformation.
#pragma once

#include "meshtween/core/mesh.h"

#include <filesystem>

namespace meshtween {

struct RotationMarkers {
    Points turn, hold; // a row a point
};

// Rows of name,x,y,z,role under an optional header; role is "turn" or "hold". Throws Error(file) naming the line.
RotationMarkers read_rotation_markers(const std::filesystem::path& path);

} // namespace meshtween
