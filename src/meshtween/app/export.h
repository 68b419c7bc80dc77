// A morph as one playable file.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/morph/curve.h"
#include "meshtween/morph/timing.h"

#include <filesystem>
#include <string>

namespace meshtween {

struct PlayOptions {
    double seconds = 2;       // from one end to the other
    bool ping_pong = true;    // and back again
    Ease ease = Ease::linear; // of the time from one end to the other
    std::string title;        // shown by the page
};

// A binary glTF: `mesh` carries triangles, UVs and colours, the curve's nodes become morph targets with normals, and a
// weights animation plays the curve. Valid for the Khronos glTF validator without errors or warnings.
std::string morph_glb(const Mesh& mesh, const Curve& curve, const PlayOptions& options = {});

// A page that needs no network: the GLB and its player (three.js) inside one HTML file.
std::string morph_html(const std::string& glb, const PlayOptions& options = {});

} // namespace meshtween
