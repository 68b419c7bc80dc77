// Meshes as the page draws them: moved and scaled into a box of unit diagonal around the origin, so that single
// precision is enough wherever the model lies, whatever its unit.
#pragma once

#include "events.h"

#include "meshtween/core/mesh.h"

#include <string>

namespace meshtween::studio {

struct Frame {
    Point centre{0, 0, 0};
    double scale = 1; // the box's diagonal: drawn = (x - centre) / scale
};

Frame frame_of(const Mesh& mesh);
Frame frame_of(const Mesh& mesh, const Mesh& other); // of both together
Json to_json(const Frame& frame);

// Little-endian buffers for the page.
std::string position_bytes(const Points& positions, const Frame& frame);       // n x 3 float32
std::string normal_bytes(const Points& positions, const Triangles& triangles); // n x 4 int16, the fourth 0
std::string direction_bytes(const Points& directions);                         // the same; lengths of 1 at most
std::string index_bytes(const Triangles& triangles);                           // m x 3 uint32
std::string color_bytes(const Colors& colors);                                 // n x 4 uint8
std::string value_bytes(const Eigen::VectorXd& values);                        // n float32
std::string corner_uv_bytes(const Mesh& mesh);                                 // 3m x 2 float32, a corner each

} // namespace meshtween::studio
