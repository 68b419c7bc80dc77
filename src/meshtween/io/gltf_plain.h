// A glTF file as one JSON and one buffer, with nothing compressed in it, and writing to its accessors.
#pragma once

#include "meshtween/io/gltf_data.h"
#include "meshtween/io/gltf_pack.h"

#include <string>
#include <vector>

namespace meshtween {

// The file's JSON and all its buffers one after another; Draco and meshopt are decoded and no longer named. Numbers of
// all items stay. Throws Error(file) where a buffer is missing or damaged.
Glb plain_gltf(const GltfData& data);

// Takes an extension's name out of extensionsUsed and extensionsRequired.
void forget_extension(nlohmann::json& root, const std::string& name);

// For each byte of the buffer how many accessors and pictures have it: 0, 1, or 2 for more.
std::vector<char> byte_owners(const Glb& glb);

// Puts float rows (`columns` each) into an accessor: into its own bytes where it holds floats and shares none, else
// into new ones. With `bounds`, min and max are set.
void replace_rows(Glb& glb, std::size_t accessor, const std::vector<char>& owners, const std::vector<float>& values,
                  std::size_t columns, bool bounds);

} // namespace meshtween
