// What the outer side of each face of a mesh sees: the open, or other faces. Scanners see what is open; inner walls, a
// mouth behind closed lips and skin under cloth they do not.
#pragma once

#include "meshtween/core/mesh.h"

#include <vector>

namespace meshtween {

// Shares of directions over the outer half space, each counted by its cosine to the normal.
struct Exposure {
    float open = 1; // nothing is met
    float back = 0; // a face is met from behind: this one lies under another layer
};

// An entry a triangle. The same for any number of threads. Triangles that see the open in several directions are looked
// at no further, and their shares are rough. Through holes of the mesh nothing is seen where they count as closed.
enum class Holes { closed, open };
std::vector<Exposure> exposure(const Points& positions, const Triangles& triangles, Holes holes = Holes::closed);

// What parts of the area are hidden and covered, 0..1, by a sample of triangles: good to a few parts in a thousand.
struct InnerShares {
    double hidden = 0, covered = 0;
};
InnerShares inner_shares(const Points& positions, const Triangles& triangles);

// Faces that neither see the open nor lie under another layer, with what around them sees little of it; and faces that
// lie under one. Each set in patches of
// half a per cent of the area at least: smaller ones are what is around them. A flag a triangle; none at all where
// hardly anything would be left.
std::vector<char> hidden_faces(const Points& positions, const Triangles& triangles,
                               const std::vector<Exposure>& exposure);
std::vector<char> covered_faces(const Points& positions, const Triangles& triangles,
                                const std::vector<Exposure>& exposure);

// The part of the mesh's area that the flagged triangles have, 0..1.
double share_of_area(const Points& positions, const Triangles& triangles, const std::vector<char>& flags);

} // namespace meshtween
