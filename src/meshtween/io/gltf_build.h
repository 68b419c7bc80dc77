// What mesh_glb packs, for writers that pack it in another way.
#pragma once

#include "meshtween/io/gltf_pack.h"
#include "meshtween/io/gltf_write.h"

namespace meshtween {

Glb mesh_gltf(const Mesh& mesh, const GltfMorph& morph, const std::string& name);

} // namespace meshtween
