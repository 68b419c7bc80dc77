// Some triangles of a mesh as a mesh of their own.
#pragma once

#include "meshtween/core/mesh.h"

#include <vector>

namespace meshtween {

struct Portion {
    Points positions;           // of the vertices that the triangles have, in their order
    Triangles triangles;        // in the order in which they were named
    std::vector<int> vertex;    // its vertices: the mesh's
    std::vector<int> triangle;  // its triangles: the mesh's
    std::vector<int> of_vertex; // the mesh's vertices: its own, or -1
};

Portion portion(const Points& positions, const Triangles& triangles, const std::vector<int>& chosen);

// The portion's rows of x, one for each vertex of the mesh; and back into them.
Points rows_of(const Portion& part, const Points& x);
void put_rows(const Portion& part, const Points& rows, Points& x);

} // namespace meshtween
