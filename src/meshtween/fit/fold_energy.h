// What it costs to lay a patch of triangles out on a surface: finite for triangles that are turned over, so that they
// can be unfolded, and rising steeply towards them, so that none turns over again.
#pragma once

#include "meshtween/core/mesh.h"

#include <array>
#include <vector>

namespace meshtween {

// A point of a triangle that is drawn towards a place.
struct FoldPull {
    std::array<int, 3> vertices{};
    Eigen::RowVector3d barycentric{1, 0, 0};
    Point place{0, 0, 0};
    double weight = 0;
};

// Vertices 0 .. free move, the others hold.
struct FoldEnergy {
    Eigen::Index free = 0;
    Triangles triangles;
    std::vector<Eigen::Matrix2d> inverse; // of two edges of each triangle's rest shape in its own plane
    std::vector<double> share;            // of the patch's area, a triangle
    std::vector<Point> outward;           // unit, a triangle: a triangle that looks against it is turned over
    double softness = 1;                  // the lower, the steeper the rise towards triangles turned over

    bool sliding = false; // vertices move along the surface only

    std::vector<Point> planes, normals, homes; // a free vertex: on the surface, its normal there; where it was
    std::vector<double> onto, home;            // the weights: to the plane, to the home
    std::vector<FoldPull> pulls;
};

// At x (all vertices of the patch), with the gradient for the free ones.
double fold_energy(const FoldEnergy& energy, const Points& x, Points& gradient);

// The area of a triangle over that at rest, negative for one turned over; and the smallest of all.
double stretch(const FoldEnergy& energy, const Points& x, Eigen::Index triangle);
double least_stretch(const FoldEnergy& energy, const Points& x);

// Two edges of a triangle in its own plane, from its first corner, as columns; none is flatter than a thousandth of its
// first edge, so that there is an inverse. False for a triangle whose first edge has no length.
bool planar_edges(const Points& rest, const Triangles& triangles, Eigen::Index t, Eigen::Matrix2d& edges);

} // namespace meshtween
