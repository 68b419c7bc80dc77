// How one of two meshes that lie on each other looks, carried over to the other: as a picture on its own texture
// coordinates, or as vertex colours.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/core/progress.h"
#include "meshtween/fit/appearance.h"

#include <filesystem>
#include <string>
#include <vector>

namespace meshtween {

struct LookOptions {
    int texture_size = 2048;
    bool bake_colors = false; // vertex colours become a picture too, where there are texture coordinates
    std::string picture_name = "texture";
};

struct CarriedLook {
    // The receiver with the giver's look. Its file keeps polygons, groups and materials' names; colours and pictures
    // are new, the pictures' bytes (PNG) in it.
    Mesh mesh;
    double unseen = 0;      // the part of the receiver's area that the giver does not show
    double twice = 0;       // the part of it whose place on the picture is another's as well
    std::string no_picture; // why vertex colours are used though the giver has pictures; else empty
    bool cancelled = false;
};

// `receiver` lies on the giver, as fit() leaves it. What the giver does not show keeps the look of `own`, the
// receiver's before, where it has one; else it takes the colours around it. Throws Error(file) where the giver has no
// look, or pictures that cannot be read; `giver_name` is its file's. Throws as bake().
CarriedLook carried_look(const Mesh& receiver, const Mesh& giver, const std::string& giver_name,
                         const LookOptions& options, const Progress& progress = {});

} // namespace meshtween
