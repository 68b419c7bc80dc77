// A mesh's own glTF file with other positions.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/io/gltf_pack.h"

#include <string>
#include <vector>

namespace meshtween {

struct GltfRewrite {
    Glb glb;                        // pictures that lay beside the file are named as they were
    std::vector<std::string> notes; // sentences for people
};

// The file that the mesh was read from, a glTF, with the mesh's positions: nodes, skins, weights, morph targets,
// animations, materials, pictures, names and extras as they were. New are POSITION and, where the file had them, NORMAL
// and TANGENT, in their own bytes where nothing else uses those. Positions go back through what placed them: a node's
// matrix, the blend of a skin's joints in the rest pose, default weights of morph targets. A mesh that several nodes or
// instances show becomes one for each. Throws Error(file) where the file's buffers are no longer there.
GltfRewrite rewritten_gltf(const Mesh& mesh);

} // namespace meshtween
