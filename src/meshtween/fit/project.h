// Bringing vertices onto a surface: where each should go, and how far it may without turning a triangle over.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/smooth.h"
#include "meshtween/search/closest_point.h"

#include <optional>
#include <vector>

namespace meshtween {

// A mesh to project onto, prepared once.
struct TargetSurface {
    Mesh mesh;           // positions and triangles alone
    double diagonal = 0; // of its bounding box
    double size = 0;     // the root of its area: a length that does not depend on the axes
    ClosestPointIndex index;
    std::optional<ClosestPointIndex> rim; // its boundary edges; none where it is closed
    Triangles rim_edges;                  // of `rim`: a, b, b
    std::vector<int> rim_triangle;        // the triangle on each boundary edge
    Points rim_outward;                   // unit, in that triangle's plane, away from it
    std::vector<char> on_rim;             // a flag a vertex
    std::vector<char> rim_side;           // a triangle's edges (corner k to k + 1) on the boundary, bit k
};
TargetSurface target_surface(const Points& positions, const Triangles& triangles);

struct GoalOptions {
    double least_cosine = 0.3; // between a vertex's normal and the target's
    double reach = 0.1;        // parts of the target's size beyond which nothing is a goal
};

// A place on the target for each vertex. Vertices without a compatible point, and those whose nearest lies on the
// target's boundary though theirs is not attached to it (the surface ends before it reaches them), have none.
struct Goals {
    Points positions;           // the vertex's own where there is none
    Points normals;             // of the target there; zero where there is none
    std::vector<int> triangles; // of the target; -1 where there is none
    bool found(Eigen::Index i) const { return triangles[static_cast<std::size_t>(i)] >= 0; }
};

// `attached`: a flag a vertex, those of the boundary that belong on the target's boundary; `hints`: triangles that are
// probably near (an earlier answer's), or empty.
Goals closest_compatible(const Points& positions, const Triangles& triangles, const Surroundings& around,
                         const TargetSurface& target, const std::vector<char>& attached, const GoalOptions& options,
                         const std::vector<int>& hints = {});

// Boundary loops of which most vertices lie within `near` (parts of the target's size) of its boundary, with the
// surface on the same side, belong on it. A flag a vertex.
std::vector<char> attached_boundary(const Points& positions, const Triangles& triangles, const Surroundings& around,
                                    const TargetSurface& target, double near);

struct GuardedStep {
    Points positions;
    long shortened = 0; // vertices that went less far than they should
};

// Moves vertices from `from` to `to`, or the half, a quarter, ... or none of the way there where a triangle around them
// would turn over: a triangle that looks as `normals` say (summed over its corners; its own normal before the step
// where they are zero) must look so afterwards. Triangles that look the other way already are free to turn back.
GuardedStep guarded_step(const Points& from, const Points& to, const Points& normals, const Triangles& triangles);

} // namespace meshtween
