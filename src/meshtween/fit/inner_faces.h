// Which faces of either shape have no counterpart because nobody sees them: a mouth bag on a template for scans, the
// inner walls of a bone scan, skin under cloth.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/geometry/sound_faces.h"

#include <string>
#include <vector>

namespace meshtween {

enum class TargetLayer { outer, inner, both }; // where the target has one surface over another

struct InnerFaces {
    std::vector<char> source; // a flag a triangle: nothing draws it, it goes along; empty for none
    std::vector<char> target; // a flag a triangle: nothing is drawn to it; empty for none
    std::vector<std::string> notes;
};

// Hidden faces count where the other shape has hardly any: what both have is fitted. Covered faces likewise.
InnerFaces inner_faces(const Points& source, const SoundFaces& source_faces, const Points& target,
                       const SoundFaces& target_faces, TargetLayer layer);

} // namespace meshtween
