// The matrix-free solver of Eq. 12.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/core/progress.h"
#include "meshtween/geometry/topology.h"

namespace meshtween {

// What a solve took, for the report.
struct SolveReport {
    int sweeps = 0;
    double residual = 0; // relative: |A V - D| / |D|
    bool converged = true;
};

// The modified coordinates of Eq. 12: c1 p_i - c2 (mean of its neighbours). n x 3, the mesh's unit.
Points modified_laplacian(const Points& positions, const Lists& neighbours, double c1, double c2);

struct GaussSeidelOptions {
    double c1 = 1.01; // c1 > c2 > 0: the further apart, the faster it converges
    double c2 = 0.99;
    double tolerance = 1e-7; // stops when no vertex moves further in a sweep; in the mesh's unit
    int max_sweeps = 5000;
};

struct GaussSeidelResult {
    Points positions;
    SolveReport report;
};

// Vertices in groups of which no two are neighbours (greedy, in vertex order): a group can be updated at once.
Lists colouring(const Lists& neighbours);

// Solves c1 p_i - c2 (mean of its neighbours) = d_i by sweeps over the vertices, colour by colour, beginning at
// `start`; no matrix is stored. The same bits for any number of threads. Throws Error(argument) unless c1 > c2 > 0.
// Where max_sweeps was not enough, or it was cancelled, the report says so.
GaussSeidelResult gauss_seidel(const Points& coordinates, const Points& start, const Lists& neighbours,
                               const Lists& colours, const GaussSeidelOptions& options = {},
                               const Progress& progress = {});

} // namespace meshtween
