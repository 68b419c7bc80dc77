// What of a target is fitted to: its faces without those that are none, without what lies beside the subject of a scan.
#pragma once

#include "meshtween/fit/fit.h"
#include "meshtween/geometry/sound_faces.h"

#include <span>
#include <string>
#include <vector>

namespace meshtween {

struct FittedTarget {
    // `inner`: a flag a triangle of the target that nothing is drawn to; empty for none.
    FittedTarget(const Mesh& target, const SoundFaces& faces, std::span<const Marker> markers,
                 const FitOptions& options, const std::vector<char>& inner);

    const Mesh& mesh() const { return all ? *target : own; }

    const Mesh* target = nullptr;   // must outlive this
    bool all = true;                // nothing was left out
    Mesh own;                       // positions and triangles of what is kept; empty where all is
    std::vector<int> left_out;      // triangles, ascending
    std::vector<std::string> notes; // what was left out
};

} // namespace meshtween
