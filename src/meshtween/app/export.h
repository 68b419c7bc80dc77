// A morph as one playable file.
#pragma once

#include "meshtween/app/playing.h"
#include "meshtween/core/mesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace meshtween {

// Names of the curve's nodes but the first: one that lies on the path says which key it is; the others are numbered.
std::vector<std::string> shape_names(const Curve& curve);

// A binary glTF: `mesh` carries triangles, UVs and colours, the curve's nodes become morph targets with normals, and a
// weights animation plays the curve. Valid for the Khronos glTF validator without errors or warnings.
std::string morph_glb(const Mesh& mesh, const Curve& curve, const PlayOptions& options = {});
std::string morph_glb(const Mesh& mesh, const Curve& curve, const WeightKeys& keys, const std::string& title);

// A page that needs no network: the GLB and its player (three.js) inside one HTML file.
std::string morph_html(const std::string& glb, const PlayOptions& options = {});

} // namespace meshtween
