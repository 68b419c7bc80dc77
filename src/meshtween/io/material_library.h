// OBJ's material libraries, .mtl files.
#pragma once

#include "meshtween/io/mesh_file.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace meshtween {

// The first line of those that we write.
inline constexpr std::string_view library_mark = "# written by meshtween";

// The names of a library's pictures in their order, each a part of `bytes`.
std::vector<std::string_view> picture_names(std::string_view bytes);

// The libraries that an mtllib statement names: one whose name has blanks, or several.
std::vector<std::string_view> library_names(std::string_view statement, const std::filesystem::path& folder);

// Fills the materials, which have their names only, and the pictures from file.material_libraries. What is not there is
// told in the notes.
void read_libraries(MeshFile& file, const std::filesystem::path& folder);

// A library of the file's materials; `image_names` has a name for each of its images, empty for none.
std::string material_library(const MeshFile& file, const std::vector<std::string>& image_names);

} // namespace meshtween
