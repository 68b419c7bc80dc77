// Materials and pictures between glTF's JSON and a MeshFile.
#pragma once

#include "meshtween/io/gltf_data.h"
#include "meshtween/io/mesh_file.h"

namespace meshtween {

// The file's materials and pictures, with its own numbers. What is damaged in them is left out: it shapes nothing.
void read_gltf_materials(const GltfData& data, MeshFile& file);

} // namespace meshtween
