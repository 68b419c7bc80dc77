// The source's mesh brought onto the target's surface.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/core/progress.h"
#include "meshtween/fit/inner_faces.h"
#include "meshtween/fit/loose_parts.h"
#include "meshtween/fit/rbf.h"

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace meshtween {

enum class FitMethod {
    paper,   // marker warp, then rounds of smoothing and projection (Eq. 1-7)
    surface, // a thin shell posed by its markers and drawn onto the surface from coarse to fine
};

// Lengths are parts of the target's bounding-box diagonal.
struct FitOptions {
    FitMethod method = FitMethod::surface;
    RbfOptions warp;         // paper: of the marker warp
    int max_rounds = 40;     // paper: of smoothing and projection
    double threshold = 1e-4; // paper: stop where sqrt(E / n), E of Eq. 7 before a round's projection, falls under this
    double least_cosine = 0.3; // paper: between a vertex normal and the target's normal where it may be projected
    double marker_weight = 1;  // surface, 0..10: of the markers' pull beside the usual; 0: they pose the shell only
    bool on_surface = false;   // surface: each vertex stays on the target; else they are lifted by so much that the
                               // triangles between them lie on it in the mean (lift.h)
    bool symmetry = true; // surface: where both shapes are their own mirror images, markers have twins (marker_twins.h)
    bool markers_exact = false;             // each marker's point ends on its place, to 1e-9 (meet_markers.h)
    PartsMode parts = PartsMode::automatic; // what becomes of loose parts without a marker (loose_parts.h)
    TargetLayer layer = TargetLayer::outer; // where the target has one surface over another (inner_faces.h)
    bool keep_parts = false;                // small parts of the target without a marker are fitted to as well
    bool weld = true; // vertices of one place that a seam of the file split are one vertex (weld.h), in both meshes
    std::function<void(const Points&)> watch; // called each round, from fit's thread, with the whole mesh so far: n x 3
};

enum class FitEnd { converged, out_of_rounds, cancelled };

struct FitResult {
    Points positions; // n x 3: the source's vertices on the target; those that are one vertex in one place, bit for bit
    FitEnd end = FitEnd::out_of_rounds;
    int rounds = 0;
    double error = 0;            // E of Eq. 7 at the end, in squared parts of the diagonal, summed over vertices
    std::vector<double> history; // sqrt(E / n) of each round, parts of the diagonal, before its projection
    long refused_steps = 0;      // vertex moves shortened because they would have turned a triangle over; a seam's once
    std::vector<int> refused;    // surface: the vertices of those moves, ascending
    std::vector<int> mended;  // surface: triangles that looked into the target on the way and no longer do, ascending
    std::vector<int> flipped; // surface: triangles that look into the target in the end, ascending
    std::vector<std::array<int, 2>> cuts; // surface: pairs of triangles that cut each other where neither shape does
    std::vector<int> left_out;            // triangles of the target that nothing was fitted to, ascending
    std::vector<int> carried; // vertices of loose parts and of no face, which went along with the rest, ascending
    int twins = 0;            // surface: mirror images of markers that drew as well
    int patches = 0; // surface: laid out anew, because triangles were turned over or cut each other (untangle.h)
    std::vector<std::pair<double, std::string>> missed; // surface: how far markers end from their places, over 0.01 of
                                                        // the diagonal, the furthest first
    std::vector<std::string> notes;                     // for people: what was unusual
};

// Throws Error(argument) for options out of range, coordinates that are not finite and indices out of range,
// Error(computation) for a mesh without area or markers on one line; for `paper` also for fewer than 3 markers or
// markers that the warp cannot use (rbf.h). `surface` guesses its start where there are fewer than 3, and says so in
// the notes.
FitResult fit(const Mesh& source, const Mesh& target, std::span<const Marker> markers, const FitOptions& options = {},
              const Progress& progress = {});

} // namespace meshtween
