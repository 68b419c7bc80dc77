// The two ways that medical programs point the axes x and y of a body: to its right and front (RAS), or to its left and
// back (LPS). From one to the other both change their sign.
#pragma once

#include "meshtween/core/mesh.h"

#include <string>
#include <string_view>

namespace meshtween {

enum class Space { unknown, ras, lps };

// What a word of a file or of a person means: "RAS", "lps", 3D Slicer's "0" (RAS) and "1" (LPS), or the axes in full
// ("left-posterior-superior"). Unknown for any other.
Space space_named(std::string_view word);

// The system that the mesh's file names in its header, as 3D Slicer writes it ("SPACE=LPS"): in PLY's and OBJ's
// comments, VTK's title, STL's header. Unknown where the file is silent or the mesh has none.
Space space_of(const Mesh& mesh);
Space space_in_header(std::string_view bytes, std::string_view format); // of a mesh's file; format: ".ply"

std::string_view name_of(Space space); // "RAS", "LPS"
inline Space other(Space space) {
    return space == Space::ras ? Space::lps : space == Space::lps ? Space::ras : Space::unknown;
}

} // namespace meshtween
