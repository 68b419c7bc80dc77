// Regions that move at times of their own, from a file.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/morph/timing.h"

#include <filesystem>

namespace meshtween {

struct RegionOptions {
    double width = 0.05; // over which times are smoothed on the surface, parts of the diagonal
    double span = 0.5;   // of a painted mesh: how long each vertex moves, above 0 and at most 1
};

// When each vertex of `mesh` moves, from one of
//   a CSV of name,x,y,z,start,end: moments from 0 to 1 at the vertex nearest to each point
//   a CSV of vertex,start,end: the same by vertex, counted from 0
//   a mesh of as many vertices with vertex colours: the darkest begin at once, the brightest at 1 - span
// A header line may come first; the rest of the surface follows smoothly. Throws Error(file) naming file and line, and
// Error(argument) for bad options.
RegionTiming read_regions(const std::filesystem::path& path, const Mesh& mesh, const RegionOptions& options = {});

} // namespace meshtween
