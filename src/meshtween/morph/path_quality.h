// How good a path is, frame by frame.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/core/progress.h"

#include <array>
#include <functional>
#include <vector>

namespace meshtween {

struct FrameQuality {
    double u = 0;
    double volume = 0, area = 0;                        // the mesh's unit cubed, squared
    double volume_ratio = 1, area_ratio = 1;            // against the straight line between the ends' values
    double edge_strain_mean = 0, edge_strain_max = 0;   // edge lengths against the straight blend, relative
    std::vector<int> flipped;                           // triangles turned over against those around them
    std::vector<std::array<int, 2>> self_intersections; // pairs of triangles
};

struct PathQuality {
    std::vector<FrameQuality> frames; // ends included
    bool cancelled = false;
};

struct PathQualityOptions {
    int frames = 11;                // 2 or more, evenly from key to key
    std::vector<double> keys{0, 1}; // ascending: what is measured against ends is measured against the keys around
    bool self_intersections = true; // the longest part
    bool weld = true; // of a mesh: what a seam of the file split is one vertex where all keys have it in one place
};

// A triangle counts as flipped where its normal looks against the one that the mean rotation of the triangles around it
// would give it, whichever end one starts from: turns of the shape do not count, nor folds that both ends have.
PathQuality path_quality(const Triangles& triangles, const std::function<Points(double u)>& at,
                         const PathQualityOptions& options = {}, const Progress& progress = {});
PathQuality path_quality(const Mesh& mesh, const std::function<Points(double u)>& at,
                         const PathQualityOptions& options = {}, const Progress& progress = {});

} // namespace meshtween
