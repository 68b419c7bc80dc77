// Normals of a glTF file's vertices for new positions, and how the surface around each was turned and stretched.
#pragma once

#include "meshtween/core/mesh.h"

#include <vector>

namespace meshtween {

struct GltfShading {
    Points normals;                       // a row a vertex of the file; empty where the file has none
    std::vector<Eigen::Matrix3d> changes; // beside them: takes directions in the old surface to the new one
};

// `vertices`: the mesh's vertex for each of the file's, empty where they are the same; `before`: x y z of each as the
// file had them. Normals are smooth and split where the file's were.
GltfShading gltf_shading(const Mesh& mesh, const std::vector<int>& vertices, const std::vector<double>& before);

} // namespace meshtween
