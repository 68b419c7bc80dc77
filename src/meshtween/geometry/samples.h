// Embedded samples, made by code, whose true correspondence is known.
#pragma once

#include "meshtween/core/mesh.h"

#include <string>
#include <string_view>
#include <vector>

namespace meshtween {

// Source and target have different meshes (where `same_connectivity` is false), markers on both surfaces, and the
// place on the target's surface where each source vertex belongs; of `scan`, whose target is a part, on the whole.
struct Sample {
    std::string name, description;
    Mesh source, target;
    std::vector<std::string> marker_names;
    Points marker_source, marker_target; // M x 3; empty where same_connectivity
    Points truth;                        // n x 3, a row a source vertex
    Points middle;                       // n x 3: the known half-way shape; empty where there is none
    bool same_connectivity = false;
};

struct SampleInfo {
    std::string name, description;
};
const std::vector<SampleInfo>& samples(); // all that exist, the demo's first

// Both meshes subdivided so many times, up to 4, for one that is large: the figures have about 10,000 vertices, and 4,
// 16, 64 and 256 times as many. Throws Error(argument): an unknown name, naming those that exist; too many
// subdivisions.
Sample sample(std::string_view name, int subdivisions = 0);

} // namespace meshtween
