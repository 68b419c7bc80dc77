// Bending a path where it cuts itself though its ends do not.
#pragma once

#include "meshtween/morph/interpolant.h"

namespace meshtween {

struct RepairOptions {
    int frames = 9;      // between the ends, at which cuts are sought
    int rounds = 3;      // of bending all contacts at most; 0: only count
    double reach = 0.08; // how far a vertex may be moved, parts of the diagonal
    int trials = 4000;   // shapes tried at most
};

struct RepairReport {
    std::size_t cuts_before =
        0; // pairs of triangles that cut each other, in all frames together, without the ends' own
    std::size_t cuts_after = 0;
    int contacts = 0; // places that were bent
    int left = 0;     // places that still cut: too deep for the reach, creases, or places that are cut at an end too
    int trials = 0;   // shapes tried
    double moved = 0; // the largest displacement, parts of the diagonal
};

struct Repaired {
    Interpolant path;
    RepairReport report;
    bool cancelled = false; // the progress said so: the path is the best so far
};

// Both sides of a contact are moved apart by a field that fades over the surface around it, and over time by a
// polynomial with double noughts at both ends: ends and the velocities there stay as they are. Direction and size are
// the smallest of those tried with which fewest triangles cut; none where more than half of the cuts would stay. Throws
// Error(argument) for bad options.
Repaired repaired(const Interpolant& path, const Triangles& triangles, const RepairOptions& options = {},
                  const Progress& progress = {});

} // namespace meshtween
