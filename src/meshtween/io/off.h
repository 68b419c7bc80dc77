// What reading and writing OFF share.
#pragma once

#include "meshtween/io/polygons.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace meshtween {

// The words that a new shape changes.
struct OffPlaces {
    std::vector<std::string_view> positions; // x y z a vertex
    std::vector<std::string_view> normals;   // and of NOFF
};

// Throws Error(file).
PolygonMesh read_off(std::string_view bytes, const std::filesystem::path& path, OffPlaces* places);

} // namespace meshtween
