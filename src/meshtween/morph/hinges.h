// Rotations of triangles where neighbouring patches turn far against each other.
#pragma once

#include "meshtween/geometry/topology.h"
#include "meshtween/morph/turns.h"
#include "meshtween/solve/cholesky.h"

#include <array>
#include <functional>
#include <optional>

namespace meshtween {

using TriangleEdges = std::array<Eigen::Vector3d, 3>; // from corner k to k + 1

// A triangle's edges on the way, before it is turned.
using LocalEdges = std::function<TriangleEdges(int triangle)>;

// An edge about which two triangles turn against each other.
struct PatchHinge {
    int first = 0, second = 0;           // triangles, as numbered in Hinges
    int corner = 0, partner = 0;         // where the edge begins in the first; and in the second, where it runs back
    double angle_from = 0, angle_to = 0; // about the edge, from the first's normal to the second's
    double weight = 1;
};

struct Hinges {
    std::vector<int> triangles; // of the mesh: those inside, and those around them, which are given
    std::vector<char> inside;   // a flag one each
    std::vector<PatchHinge> hinges;
    struct Step {
        int hinge = 0;
        bool back = false; // from the second to the first
    };
    std::vector<Step> tree;               // from those around to those inside, over the surest hinges
    std::optional<SparseCholesky> system; // least squares of small rotations; none without hinges
};

// Patches in which, or between which, triangles might turn by more than half a turn against each other, so that their
// rotations at both ends do not say which way round they went: a flag a patch.
std::vector<char> entangled(const FaceField& faces, const Patches& patches);

// Of patches that are entangled (a flag each), those that hang together with a place where rotations half-way (m) say
// otherwise than the angle across an edge, by more than a sixth of half a turn: elsewhere the rotations have it right.
std::vector<char> misled(const std::vector<char>& entangled, const Points& from, const Points& to,
                         const Triangles& triangles, const Topology& topology, const FaceField& faces,
                         const Patches& patches, const LocalEdges& half_edges, const Quaternions& half);

// The same turns, but which way round patches turn that turn far against each other is as the hinges on their borders
// say. `half_edges` are of half the way.
Turns way_round(Turns turns, const Points& from, const Points& to, const Triangles& triangles, const Topology& topology,
                const FaceField& faces, const Patches& patches, const LocalEdges& half_edges);

// The hinges around all triangles that are inside (a flag a triangle). `half_edges` and `half` (m rotations, of which
// those around are taken) are of half the way.
Hinges hinges(const Points& from, const Points& to, const Triangles& triangles, const Topology& topology,
              const FaceField& faces, const std::vector<char>& inside, const LocalEdges& half_edges,
              const Quaternions& half);

// Rotations (m) at the triangles' parameters u (m), those inside replaced: angles about hinges go their way evenly.
Quaternions turned_on_hinges(const Hinges& hinges, const LocalEdges& edges, const Eigen::VectorXd& u,
                             Quaternions rotations);

} // namespace meshtween
