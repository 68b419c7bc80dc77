// The samples that need more than a line, each made by its own file.
#pragma once

#include "meshtween/geometry/samples.h"

#include <functional>

namespace meshtween {

using SpaceMap = std::function<Points(const Points&)>;

struct SampleParts {
    Mesh source, target; // two meshes of one surface
    SpaceMap to_source, to_target;
    std::vector<std::string> names;
    Points marks; // on that surface
};

// Two meshes of one surface, each subdivided and carried by its own smooth map of space: what belongs together is
// known. The truth and the markers are put on the flat triangles.
Sample pair_of(const SampleParts& parts, int subdivisions);

Sample bow_sample(int subdivisions);
Sample bow_pose_sample(int subdivisions);
Sample build_sample(int subdivisions);
Sample arms_sample(int subdivisions);
Sample head_sample(int subdivisions);
Sample scan_sample(int subdivisions);
Sample bust_sample(int subdivisions);
Sample torus_sample(int subdivisions);
Sample cup_sample(int subdivisions);

} // namespace meshtween
