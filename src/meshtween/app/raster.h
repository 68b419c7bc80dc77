// Triangles to samples: the z-buffer under the pictures.
#pragma once

#include "meshtween/core/mesh.h"

#include <vector>

namespace meshtween {

// What lies in front at each sample of a picture, row by row from the top.
struct Samples {
    int width = 0, height = 0;
    std::vector<int> triangle;                // -1: nothing
    std::vector<float> nearness;              // 1 / distance; 0 where there is nothing
    std::vector<Eigen::Vector2f> barycentric; // of the second and third corner, in space rather than on the picture
};

// screen: n x 3, x to the right and y downwards in samples, and the distance from the eye along the view (> 0).
// Triangles with a coordinate that is not finite or a distance of 0 or less are left out.
Samples rasterise(const Points& screen, const Triangles& triangles, int width, int height);

// The smallest third coordinate over each sample of a square picture, infinite where there is nothing.
std::vector<float> depth_map(const Points& screen, const Triangles& triangles, int side);

} // namespace meshtween
