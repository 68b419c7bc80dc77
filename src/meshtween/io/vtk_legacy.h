// The older of VTK's formats, .vtk: what a file holds, and where in it lie the numbers that another shape changes.
#pragma once

#include "meshtween/io/vtk_words.h"

#include <filesystem>
#include <string_view>

namespace meshtween {

struct VtkLegacyFile {
    PolygonMesh mesh;
    bool ascii = true;
    VtkBlock points, normals;
};

// Throws Error(file), naming the line, or the byte of a binary file. What comes after the faces is no part of the
// shape: where that is damaged a note says so.
VtkLegacyFile scan_vtk(std::string_view bytes, const std::filesystem::path& path);

} // namespace meshtween
