// Parts of the source that nothing of the target answers to: eyeballs, teeth, lashes, buttons, splinters of bone. They
// are not fitted but go where the surface around them goes.
#pragma once

#include "meshtween/geometry/portion.h"

#include <vector>

namespace meshtween {

enum class PartsMode {
    automatic, // small parts without a marker follow
    follow,    // all but the largest and those with markers follow
    fit,       // each is fitted as if the target had it
};

// Which of the mesh's connected parts follow. `part`: of each chosen triangle; `marked`: triangles with markers;
// `free`: a flag a triangle, those that nothing draws. A flag a part; the largest never follows. `automatic`: parts
// with less than a tenth of the largest one's area, and those that are free.
std::vector<char> following_parts(const Points& positions, const Triangles& triangles, const std::vector<int>& chosen,
                                  const std::vector<int>& part, const std::vector<int>& marked,
                                  const std::vector<char>& free, PartsMode mode);

// What of a mesh is not fitted.
struct Carried {
    std::vector<Portion> parts; // loose ones
    Portion region;             // attached to what is fitted: its shared vertices are held; or empty
    std::vector<int> strays;    // vertices of no face
    bool any() const { return !parts.empty() || !region.vertex.empty() || !strays.empty(); }
};

// Takes that along with what is fitted, whose vertices have gone to `now`. A body keeps its shape: one similarity, that
// of the fitted surface around it, the nearest counting most. A sheet, such as lashes or hair, follows vertex by
// vertex, and so does an attached region, smoothly from its seam on. Reads `rest` and writes `x`, both a row a vertex
// of the mesh.
void carry(const Portion& fitted, const Points& now, const Carried& carried, const Points& rest, Points& x);

} // namespace meshtween
