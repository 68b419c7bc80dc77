// Hu, Liu and Wang, Dual Laplacian Morphing for Triangular Meshes, 2007 (the paper's reference 20), with the
// coordinates of Au, Tai, Liu and Fu, Dual Laplacian Editing for Meshes, 2006: the dual mesh has a vertex at each
// triangle's centre, with three neighbours. Its Laplacian coordinate stands on the plane of those three: the weights of
// its foot there and its height are blended linearly, its direction is found by iteration, for the normals of the
// in-between shape are those of its own positions. Each shape needs a system of its own, and some thirty solves.
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/morph/methods.h"
#include "meshtween/morph/rigid_motion.h"
#include "meshtween/solve/laplacian.h"

#include <Eigen/SparseCholesky>

#include <array>
#include <memory>

namespace meshtween {
namespace {

struct DualVertex { // of a triangle with three neighbours
    int triangle = 0;
    std::array<int, 3> neighbours{};
    Eigen::RowVector3d weights_from, weights_to; // of the foot in the neighbours' plane
    double height_from = 0, height_to = 0;
};

struct State {
    Points from, to; // centred
    RigidMotion motion;
    Triangles triangles;
    std::vector<DualVertex> dual;
    double size = 0;
    int max_rounds = 0;
    double tolerance = 0;
};

Point centre(const Points& p, const Triangles& triangles, int t) {
    return (p.row(triangles(t, 0)) + p.row(triangles(t, 1)) + p.row(triangles(t, 2))) / 3;
}

Point dual_normal(const Points& p, const Triangles& triangles, const DualVertex& v) {
    const Point a = centre(p, triangles, v.neighbours[0]), b = centre(p, triangles, v.neighbours[1]),
                c = centre(p, triangles, v.neighbours[2]);
    const Point normal = (b - a).cross(c - a);
    return normal.norm() > 0 ? Point(normal.normalized()) : Point::Zero().eval();
}

void measure(const Points& p, const Triangles& triangles, const DualVertex& v, Eigen::RowVector3d& weights,
             double& height) {
    const Point a = centre(p, triangles, v.neighbours[0]), b = centre(p, triangles, v.neighbours[1]),
                c = centre(p, triangles, v.neighbours[2]), q = centre(p, triangles, v.triangle);
    const Point normal = (b - a).cross(c - a);
    const double area = normal.squaredNorm();
    weights.setConstant(1.0 / 3);
    height = 0;
    if (area <= 0) return;
    weights[1] = (q - a).cross(c - a).dot(normal) / area;
    weights[2] = (b - a).cross(q - a).dot(normal) / area;
    weights[0] = 1 - weights[1] - weights[2];
    height = (q - a).dot(normal) / std::sqrt(area);
}

Points shape_at(const State& s, const Eigen::VectorXd& u, double whole, SolveReport& report) {
    const Eigen::Index n = s.from.rows();
    const auto own = [&](int t) { return (u[s.triangles(t, 0)] + u[s.triangles(t, 1)] + u[s.triangles(t, 2)]) / 3; };
    std::vector<Eigen::Triplet<double>> triplets;
    for (std::size_t r = 0; r < s.dual.size(); ++r) {
        const DualVertex& v = s.dual[r];
        const double t = own(v.triangle);
        for (int k = 0; k < 3; ++k) {
            triplets.emplace_back(static_cast<int>(r), s.triangles(v.triangle, k), 1.0 / 3);
            const double weight = (1 - t) * v.weights_from[k] + t * v.weights_to[k];
            for (int c = 0; c < 3; ++c)
                triplets.emplace_back(static_cast<int>(r), s.triangles(v.neighbours[static_cast<std::size_t>(k)], c),
                                      -weight / 3);
        }
    }
    SparseMatrix laplacian(static_cast<Eigen::Index>(s.dual.size()), n);
    laplacian.setFromTriplets(triplets.begin(), triplets.end());
    SparseMatrix matrix = laplacian.transpose() * laplacian;
    // A weak pull to the straight path holds what the coordinates leave open: the place, and vertices at borders.
    constexpr double pull = 1e-6;
    SparseMatrix identity(n, n);
    identity.setIdentity();
    matrix += pull * identity;
    const Eigen::SimplicialLDLT<SparseMatrix> solver(matrix);
    const Points straight = s.from + u.asDiagonal() * (s.to - s.from);
    Points p = straight;
    Points heights(static_cast<Eigen::Index>(s.dual.size()), 3);
    report.converged = false;
    for (report.sweeps = 0; report.sweeps < s.max_rounds && !report.converged; ++report.sweeps) {
        for (std::size_t r = 0; r < s.dual.size(); ++r) {
            const DualVertex& v = s.dual[r];
            const double t = own(v.triangle);
            heights.row(static_cast<Eigen::Index>(r)) =
                ((1 - t) * v.height_from + t * v.height_to) * dual_normal(p, s.triangles, v);
        }
        const Points right = laplacian.transpose() * heights + pull * straight;
        const Eigen::MatrixXd next = solver.solve(Eigen::MatrixXd(right));
        const double moved = (next - p).rowwise().norm().maxCoeff();
        p = next;
        report.converged = moved <= s.tolerance * s.size;
        report.residual = s.size > 0 ? moved / s.size : 0;
    }
    return placed(s.motion, p, whole);
}

} // namespace

Morph dual_mesh_morph(const Mesh& from, const Points& to, const MorphOptions& options) {
    const Topology top = topology(from.positions.rows(), from.triangles);
    const RigidMotion motion = best_rigid_motion(from.positions, to);
    auto state = std::make_shared<State>(State{centred_from(motion, from.positions),
                                               centred_to(motion, to),
                                               motion,
                                               from.triangles,
                                               {},
                                               diagonal(from),
                                               std::min(options.max_sweeps, 100),
                                               1e-5});
    std::vector<std::vector<int>> adjacent(static_cast<std::size_t>(from.triangles.rows()));
    for (const Edge& edge : top.edges)
        if (edge.count == 2)
            for (std::size_t k = 0; k < 2; ++k)
                adjacent[static_cast<std::size_t>(edge.triangles[k])].push_back(edge.triangles[1 - k]);
    for (std::size_t t = 0; t < adjacent.size(); ++t) {
        if (adjacent[t].size() != 3) continue;
        DualVertex v;
        v.triangle = static_cast<int>(t);
        std::copy(adjacent[t].begin(), adjacent[t].end(), v.neighbours.begin());
        measure(state->from, from.triangles, v, v.weights_from, v.height_from);
        measure(state->to, from.triangles, v, v.weights_to, v.height_to);
        state->dual.push_back(v);
    }
    const auto most = std::make_shared<MostLaborious>();
    const auto at = [state, most](const Eigen::VectorXd& u, double whole) {
        SolveReport report;
        Points shape = shape_at(*state, u, whole, report);
        most->add(report);
        return shape;
    };
    return {[at, first = from.positions, last = to](double u) {
                return u == 0 ? first : u == 1 ? last : at(Eigen::VectorXd::Constant(first.rows(), u), u);
            },
            at, [most] { return most->get(); }};
}

} // namespace meshtween
