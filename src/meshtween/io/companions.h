// The files that a mesh's file names: material libraries and pictures. They are found from the folder of the mesh's
// file, and again from the folder of what is written.
#pragma once

#include "meshtween/io/mesh_file.h"
#include "meshtween/io/mesh_io.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace meshtween {

// The file that `name` means in a file of this folder: as it stands, with backslashes for slashes, or, as exporters
// write paths of their own machine, its last part in the folder. Empty where no such file is.
std::filesystem::path find_companion(const std::filesystem::path& folder, std::string_view name);

// From where to where a mesh goes, and what is said on the way.
struct Move {
    std::filesystem::path from, to; // folders
    Textures textures = Textures::copy;
    std::vector<std::string>* notes = nullptr;
};

// A move to the folder of `path`. Nothing is copied beside a device or a pipe.
Move move_to(const std::filesystem::path& path, const std::filesystem::path& from, const WriteOptions& options,
             std::vector<std::string>& notes);

// Copies the picture, or the material library with its pictures, unless it is there. A different file that is there
// already is left as it is, and a note says so. Returns the name by which a file in the new folder names it: the same,
// wherever that does.
std::string carry_picture(const Move& move, std::string_view name);
std::string carry_library(const Move& move, std::string_view name);

// The same for a picture that the mesh's file holds or names; empty where it cannot be had. `number` names what has no
// name.
std::string carry_image(const Move& move, const TextureImage& image, std::size_t number);

// Writes `bytes` as `name` or, where a different file has that name, as name_2 and so on; returns the name. A file that
// begins with `ours` was written by us and is written over.
std::string place_beside(const std::filesystem::path& folder, const std::string& name, std::string_view bytes,
                         std::string_view ours = {});

} // namespace meshtween
