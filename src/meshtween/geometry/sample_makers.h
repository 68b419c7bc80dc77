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

// Two meshes of one surface, each carried by its own smooth map of space: what belongs together is known. The truth and
// the markers are put on the flat triangles.
Sample pair_of(const SampleParts& parts);

Sample bow_sample();
Sample bow_pose_sample();
Sample build_sample();
Sample arms_sample();
Sample head_sample();
Sample torus_sample();
Sample cup_sample();

} // namespace meshtween
