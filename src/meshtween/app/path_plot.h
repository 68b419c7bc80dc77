// A path's quality as a picture that any browser shows.
#pragma once

#include "meshtween/morph/path_quality.h"

#include <string>
#include <vector>

namespace meshtween {

struct PlottedPath {
    std::string name; // in the legend: a method's name
    PathQuality quality;
};

// An SVG document with four panels over u: volume and area against the straight line between the ends, mean edge strain
// in percent, and flipped triangles with self-intersections. A line a path, told apart by colour and dash.
std::string path_plot(const std::vector<PlottedPath>& paths);

} // namespace meshtween
