// The closest point of a mesh to points that lie near it already.
#pragma once

#include "meshtween/core/mesh.h"

#include <vector>

namespace meshtween {

// Triangles in the cells of a lattice. For samples: one that answers from any distance is in search/.
class SurfaceLookup {
public:
    // Finds what lies within `reach` of a point. Refers to the mesh.
    SurfaceLookup(const Mesh& mesh, double reach);

    // The closest point on the mesh, or the point itself where nothing is within reach.
    Point closest(const Point& p) const;
    Points closest(const Points& points) const;

private:
    long cell(const Point& p, int i, int j, int k) const;

    struct Entry {
        long cell;
        int triangle;
    };
    const Mesh& mesh_;
    double reach_;
    Point low_;
    std::vector<Entry> entries_; // by cell, then by triangle
};

} // namespace meshtween
