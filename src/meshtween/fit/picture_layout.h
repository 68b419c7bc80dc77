// Which pictures a mesh's own texture coordinates want, and whether they can be painted at all.
#pragma once

#include "meshtween/core/mesh.h"

#include <string>
#include <vector>

namespace meshtween {

struct PictureLayout {
    int count = 0;            // of pictures
    std::vector<int> picture; // a triangle: on which one it lies
    std::string problem;      // why nothing can be painted, as the end of a sentence about the mesh; else empty
};

// Triangles go by their material's picture, else by their material, and by the tile of their texture coordinates
// (UDIM); what does not overlap shares a picture. Beyond 0..1 coordinates repeat, as viewers have it. There is a
// problem where there are no coordinates, where they have no area, where triangles show a picture more than once
// (tiling), and where more than 16 pictures would be needed.
PictureLayout picture_layout(const Mesh& mesh);

// A triangle's corners on the picture in units of its sides, x to the right and y downwards, so moved by whole numbers
// that the least coordinates are in 0..1.
using PictureTriangle = Eigen::Matrix<double, 3, 2>;
PictureTriangle picture_triangle(const Mesh& mesh, Eigen::Index t);

} // namespace meshtween
