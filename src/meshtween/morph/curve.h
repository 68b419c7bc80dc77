// Any path as a few meshes and their weights: what makes frames cheap and glTF files small.
#pragma once

#include "meshtween/morph/interpolant.h"
#include "meshtween/morph/spline_basis.h"

namespace meshtween {

struct CurveOptions {
    double tolerance = 1e-4; // largest deviation from the path, parts of `from`'s diagonal
    int max_nodes = 33;      // control meshes at most, 2 or more; of several pieces, of each
};

// p(u) = sum_k weights(u)[k] nodes[k]: a B-spline of u in 0..1. Viewers and game engines that keep weights within 0 and
// 1 play it as it is. The nodes are control meshes: all but the ends and the keys lie beside the path.
struct Curve {
    SplineBasis basis;
    std::vector<Points> nodes; // K control meshes, the first and last the ends exactly
    std::vector<double> keys;  // where pieces begin and end: the first 0, the last 1; a node lies at each
    double deviation = 0;      // the largest from the path, parts of the diagonal
    double diagonal = 0;       // the path's, to which tolerances refer, a length
    bool cancelled = false;    // the progress said so: then it has no nodes
    std::vector<double> weights(double u) const; // K, each in 0..1, adding up to 1; degree + 1 above 0 at most
    Points at(double u) const;
};

// For each node: the u where it lies on the path (an end or a key), or nothing for a control mesh beside it.
std::vector<bool> nodes_on_path(const Curve& curve);

// How control values follow from values on the path, for normals and whatever else is blended as the nodes are: those
// of node k are sum_s fit(k, s) of the values at sites[s]. At ends and keys they are the path's own.
struct CurveSites {
    std::vector<double> sites;
    Eigen::MatrixXd fit; // K x sites
};
CurveSites curve_sites(const Curve& curve);

// Vertex normals of all nodes in this sense: blended as positions are, they have the directions of the normals of the
// path's shapes, to a degree or so. Unit length on the path only.
std::vector<Points> control_normals(const Curve& curve, const Triangles& triangles);

// With the fewest nodes for the tolerance; says in `deviation` where max_nodes was not enough. Throws Error(argument)
// for a tolerance that is not above 0 or max_nodes below 2.
Curve curve(const Morph& morph, const CurveOptions& options = {}, const Progress& progress = {});

// The same for pieces between keys at these times, 0 to 1: each piece ends where the next one begins, with the same
// velocity in the time of the whole, and a closed path goes on from its last shape to its first.
Curve curve(const std::vector<Interpolant>& pieces, const std::vector<double>& times, bool closed = false,
            const CurveOptions& options = {});

// Throws Error(argument) as above.
void check(const CurveOptions& options);

} // namespace meshtween
