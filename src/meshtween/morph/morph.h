// In-between shapes of two meshes of one connectivity.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/core/progress.h"
#include "meshtween/solve/gauss_seidel.h"

#include <functional>
#include <string_view>
#include <vector>

namespace meshtween {

enum class MorphMethod {
    rigid,           // every triangle turns and stretches by itself, put together by a Poisson system: keeps shapes
    linear,          // vertices on straight lines
    laplacian,       // the coordinates of Eq. 8 blended by Eq. 9 (Alexa 2003), one vertex a component held
    dual,            // Eq. 9-12 with rigid motion taken out, both shapes centred and the ends exact
    dual_as_printed, // Eq. 9-12 to the letter: depends on where the origin is
    edges,           // edge lengths and dihedral angles (references 17 and 18)
    dual_mesh,       // Hu, Liu and Wang 2007 (reference 20): slow, to compare with
};

// The methods' names on the command line: "rigid", "linear", "laplacian", "dual", "dual-as-printed", "edges",
// "dual-mesh".
MorphMethod morph_method(std::string_view name); // throws Error(argument) naming those that exist
std::string_view name_of(MorphMethod method);
const std::vector<MorphMethod>& morph_methods();

struct MorphOptions {
    MorphMethod method = MorphMethod::rigid;
    double c1 = 1.01; // C1 and C2 of Eq. 12: c1 > c2 > 0 converge faster the further apart they are
    double c2 = 0.99;
    double tolerance = 1e-7; // of the Gauss-Seidel solve: largest move of a sweep, parts of the diagonal
    int max_sweeps = 5000;
    int patches = 400; // of `rigid`: pieces whose rotations are interpolated against their neighbours'
    int rounds = 12;   // of `rigid`: of correcting the lengths of the middle shape, where they lack much; 0 for none
    bool weld = true;  // vertices that a seam of the file split are one vertex where all shapes have them in one place
};

// A path of shapes: at(0) is `from`, at(1) is `to`, to rounding; dual_as_printed only to its solve's tolerance.
// Vertices of no face go straight. Safe to ask from several threads.
struct Morph {
    std::function<Points(double u)> at; // u in 0..1
    // The same with a parameter a vertex (n, each in 0..1), and that of the whole for its rigid motion.
    std::function<Points(const Eigen::VectorXd& own, double whole)> at_each;
    std::function<SolveReport()> report; // of the most laborious solve so far; no sweeps for methods without a solve
    double diagonal = 0;                 // of `from`'s faces, to which tolerances refer; 0: of all vertices at u = 0
};

// Throws Error(argument) where `to` has another number of vertices or options are out of range.
Morph morph(const Mesh& from, const Points& to, const MorphOptions& options = {}, const Progress& progress = {});

} // namespace meshtween
