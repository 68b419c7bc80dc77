// What is wrong with a mesh, in words with the element's number.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/geometry/weld.h"

#include <string>
#include <vector>

namespace meshtween {

enum class Severity {
    note,    // worth knowing (open boundary, several components)
    warning, // results may suffer (zero-area faces, inverted orientation)
    error,   // no work possible (index out of range, coordinates not finite, no faces)
};

struct Finding {
    Severity severity = Severity::note;
    std::string what; // a sentence: "edge 12-47 belongs to three faces (5, 9 and 11)"
    long count = 0;   // how many of the kind
};

// At most one finding a kind, with the first few elements named and how many there are; empty for a clean closed mesh.
// Vertices that seams of the file split count as one; `weld` says which, where the caller knows more than the mesh.
std::vector<Finding> check(const Mesh& mesh);
std::vector<Finding> check(const Mesh& mesh, const Weld& weld);

} // namespace meshtween
