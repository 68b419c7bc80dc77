// Whether markers lie on their meshes, and why they do not.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/io/markers.h"

#include <string>
#include <vector>

namespace meshtween {

// Sentences about markers that lie further from their mesh than 5 % of its diagonal, with the likely cause: the cause
// whose undoing brings them back.
std::vector<std::string> distance_notes(const std::vector<MarkerPair>& pairs, const Mesh& source, const Mesh& target);

} // namespace meshtween
