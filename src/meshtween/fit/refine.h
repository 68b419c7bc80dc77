// A mesh drawn onto a surface as a thin shell that keeps its shape as far as the surface lets it.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/core/progress.h"
#include "meshtween/fit/border.h"
#include "meshtween/fit/hierarchy.h"
#include "meshtween/fit/shell.h"
#include "meshtween/search/closest_point.h"
#include "meshtween/solve/block_system.h"

#include <memory>
#include <span>
#include <vector>

namespace meshtween {

// What is fitted to. Lengths are parts of its diagonal: the caller scales.
struct FitTarget {
    Points positions;
    Triangles triangles;
    Points normals;           // a vertex, unit
    std::vector<double> area; // a vertex: share of the whole area
    Topology topology;
    ClosestPointIndex index;
    Triangles border;                                      // border_edges
    std::vector<double> border_size;                       // a vertex: border_sizes
    std::shared_ptr<const ClosestPointIndex> border_index; // of them; none where the surface is closed
};
FitTarget fit_target(const Points& positions, const Triangles& triangles);

// The closest point of the target's border where the border of the mesh at `point` runs along it: `direction` is the
// mesh's border's, unit, and `size` how large that is. Not found elsewhere, nor where the target's border there is much
// smaller: a hole.
ClosestPoint closest_on_border(const FitTarget& target, const Point& point, const Point& direction, double size);

// The target's unit normal there, between those of the triangle's vertices.
Point normal_at(const FitTarget& target, const SurfacePoint& point);

// True where a point lies on the target's border: what has its closest point there may have no counterpart.
bool on_border(const FitTarget& target, const SurfacePoint& point);

// Vertices of the mesh that have no counterpart (counterpart.h) on an open target, a flag each; empty where the target
// is closed: it shows all.
std::vector<char> without_counterpart(const Shell& shell, const Points& positions, const FitTarget& target);

// A point of the mesh that belongs at a place in space.
struct Pin {
    SurfacePoint where;
    Point offset{0, 0, 0}; // from there to the point, on the rest shape: coarse levels do not pass through it
    Point target{0, 0, 0};
    double weight = 1; // beside other pins
    double slack = 0;  // no nearer is asked for: a guess
};

// The template on every level, finest first.
struct ShellLevels {
    std::vector<Level> levels;
    std::vector<Shell> shells;
    std::vector<Interpolation> up;                     // up[k] leads from level k + 1 to level k
    std::vector<std::vector<Pin>> pins;                // a list a level
    std::shared_ptr<const Supernodes> coarsest_factor; // factor_pattern of the coarsest
};
ShellLevels shell_levels(const Points& rest, const Triangles& triangles, const HierarchyOptions& options = {});
// Puts pins on the finest level and finds their places on the others.
void set_pins(ShellLevels& shells, std::span<const Pin> pins);

struct RelaxWeights {
    double length = 0.1;   // bending against closeness: features shorter than this (in diagonals) are followed
    double membrane = 0.1; // of the membrane energy, times length squared
    double slide = 0.02;   // of pulls along the surface beside pulls onto it: 0 slides freely, 1 holds
    double pins = 100;     // of all pins together, beside the closeness of the whole surface
    double closeness = 1;  // 0 leaves the surface out: only the pins pull
    double back = 1;       // of pulls from the target's side, beside closeness, where the mesh is an edge away
    double centres = 0;    // share of closeness that the triangles' centres have, beside their corners'; finest level
    double border = 4;     // of pulls of the mesh's border onto the target's, beside closeness
    double least_cosine = 0.5;
    double reach = 0.3;     // closest points further away are not asked
    double calm_turn = 0;   // radians: frames that turn less are drawn towards none (calmed)
    int smoothing = 5;      // rounds, of the local frames
    bool with_scale = true; // local frames may grow and shrink
    int cycles = 10;        // of the solver, in time at most
    int round = 0;          // of the fit: each asks other places of a target that has many
};

// What one round on a level leaves for the next one there; empty before the first. It changes no result. Without
// closeness all rounds must have the same weights.
struct RelaxMemory {
    std::vector<int> places;                 // a vertex: the target's triangle of the last answer
    std::vector<double> trust;               // a vertex: how far that is its counterpart
    std::vector<int> centre_places;          // a triangle: the target's triangle
    std::vector<int> back_places;            // a pull from the target's side: the mesh's triangle
    std::unique_ptr<ClosestPointIndex> mesh; // where the last round found it
    std::unique_ptr<Multigrid> pose;         // without closeness the system depends on the weights alone
};

// Brings memory.mesh to these positions.
void bring_mesh(RelaxMemory& memory, const Shell& shell, const Points& positions);

// Rounds of the same kind on one level, each finding closest points and solving for the shell once.
Points relax(const ShellLevels& shells, std::size_t level, const Points& positions, const FitTarget& target,
             const RelaxWeights& weights, RelaxMemory& memory);

// Positions on the next finer level: each vertex goes with the frames of the places it lies on. With `crushed` given,
// those on triangles that have shrunk to less than that part of their area lie on them, at a height that has shrunk
// as much: the frames would carry them far beyond.
Points refine_positions(const ShellLevels& shells, std::size_t level, const Points& positions, bool with_scale,
                        double crushed = 0);

} // namespace meshtween
