// Whether markers lie on their meshes, and why they do not.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/io/markers.h"

#include <string>
#include <vector>

namespace meshtween {

// Sentences about markers that lie further from their mesh than 5 % of its diagonal, with the likely cause: the cause
// whose undoing brings them back.
struct MarkerDistances {
    std::vector<std::string> notes;
    bool elsewhere = false; // on a side most lie further than a quarter of the diagonal: they are not of this model
};
MarkerDistances marker_distances(const std::vector<MarkerPair>& pairs, const Mesh& source, const Mesh& target);

} // namespace meshtween
