// A mesh's materials as UsdPreviewSurface, and the pictures that they name.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/io/mesh_io.h"

#include <filesystem>
#include <string>
#include <vector>

namespace meshtween {

struct UsdMaterials {
    std::string text;               // the prims, to stand in /Model
    std::vector<std::string> paths; // of each material
    std::vector<std::string> notes; // sentences for people
};

// Puts the pictures beside `path` as the options say. None where the mesh's file describes it no longer.
UsdMaterials usd_materials(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions& options);

} // namespace meshtween
