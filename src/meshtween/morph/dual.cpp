// Eq. 9-12 of Yoo, Three-dimensional Morphing of Similar Shapes Using a Template Mesh: the modified Laplacian
// coordinates C1 p - C2 (mean of the neighbours) of both shapes are blended by Eq. 9, and positions recovered from
// them. As C1 p - C2 mean = C2 delta + (C1 - C2) p, low frequencies come from the positions as seen from the origin, so
// that the printed scheme depends on the origin and on the pose. The repaired one centres both shapes and takes the
// rigid motion out first. Eq. 9 is quadratic in u and the system is the same for every u: one solve for the middle
// control point gives the whole path, with exact ends.
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/morph/laplacian_coordinates.h"
#include "meshtween/morph/methods.h"
#include "meshtween/morph/rigid_motion.h"

#include <memory>

namespace meshtween {
namespace {

GaussSeidelOptions solver_options(const MorphOptions& options, const Points& from) {
    return {options.c1, options.c2, options.tolerance * diagonal(from), options.max_sweeps};
}

} // namespace

Morph dual_morph(const Mesh& from, const Points& to, const MorphOptions& options, const Progress& progress) {
    const Lists neighbours = topology(from.positions.rows(), from.triangles).neighbours;
    const RigidMotion motion = best_rigid_motion(from.positions, to);
    const Points s = centred_from(motion, from.positions), t = centred_to(motion, to);
    const Points coordinates = middle_coordinates(modified_laplacian(s, neighbours, options.c1, options.c2),
                                                  modified_laplacian(t, neighbours, options.c1, options.c2));
    GaussSeidelResult middle = gauss_seidel(coordinates, (s + t) / 2, neighbours, colouring(neighbours),
                                            solver_options(options, from.positions), progress);
    const SolveReport report = middle.report;
    const auto at = [=, c = std::move(middle.positions)](const auto& own, double whole) {
        return placed(motion, quadratic(s, c, t, own), whole);
    };
    return {[at](double u) { return at(u, u); }, at, [report] { return report; }};
}

Morph dual_as_printed_morph(const Mesh& from, const Points& to, const MorphOptions& options) {
    struct State {
        Points from, to, coordinates_from, coordinates_to;
        Lists neighbours, colours;
        GaussSeidelOptions solver;
        MostLaborious report;
    };
    auto state = std::make_shared<State>();
    state->from = from.positions;
    state->to = to;
    state->neighbours = topology(from.positions.rows(), from.triangles).neighbours;
    state->colours = colouring(state->neighbours);
    state->coordinates_from = modified_laplacian(from.positions, state->neighbours, options.c1, options.c2);
    state->coordinates_to = modified_laplacian(to, state->neighbours, options.c1, options.c2);
    state->solver = solver_options(options, from.positions);
    const auto at = [state](const Eigen::VectorXd& u, double) -> Points {
        const Points start = state->from + u.asDiagonal() * (state->to - state->from);
        GaussSeidelResult solved = gauss_seidel(blended_coordinates(state->coordinates_from, state->coordinates_to, u),
                                                start, state->neighbours, state->colours, state->solver);
        state->report.add(solved.report);
        return std::move(solved.positions);
    };
    return {[at, n = to.rows()](double u) { return at(Eigen::VectorXd::Constant(n, u), u); }, at,
            [state] { return state->report.get(); }};
}

} // namespace meshtween
