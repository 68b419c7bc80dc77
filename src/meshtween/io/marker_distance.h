// Whether markers lie on their meshes, and why they do not.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/io/markers.h"
#include "meshtween/io/space.h"

#include <string>
#include <string_view>
#include <vector>

namespace meshtween {

// The markers of one side that lie further from their mesh than 5 % of its diagonal.
struct MarkerDistances {
    std::string note;                   // a sentence with the likely cause, whose undoing brings them back; or empty
    std::vector<std::string> far_names; // of those markers
    bool elsewhere = false;             // most lie further than a quarter of the diagonal: they are not of this model
};

// A mesh as messages name it: "source".
struct NamedMesh {
    const Mesh* mesh = nullptr;
    std::string name;
};

// `other`: the other side's mesh, for markers that lie on it instead; none where there is one side. `system`: what to
// offer with --markers-system where the signs of x and y are wrong; nothing where it is empty.
MarkerDistances marker_distances(const Points& places, const std::vector<std::string>& names, const NamedMesh& own,
                                 const NamedMesh& other, const std::string& system, std::string_view what = "markers");

// What is told of pairs that are in no file: a sentence for each side where some are far off.
std::vector<std::string> far_markers(const std::vector<MarkerPair>& pairs, const Mesh& source, const Mesh& target);

// Whether nearly all of the points are within 5 % of the diagonal; false for none.
bool lie_on(const Points& points, const Mesh& mesh);

// Whether the points would lie on the mesh, and do not now, if x and y were negated.
bool have_wrong_signs(const Points& points, const Mesh& mesh);

} // namespace meshtween
