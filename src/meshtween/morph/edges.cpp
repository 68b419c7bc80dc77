// Edge lengths and dihedral angles blended linearly, as in Sun, Wang and Chin, Interpolating Polyhedral Models Using
// Intrinsic Shape Parameters, 1997 (the paper's reference 17); put together in least squares as in Wang, Liu and Tong,
// Linear Surface Reconstruction from Discrete Fundamental Forms on Triangle Meshes, 2012: lengths and dihedral angles
// give the rotation from each triangle's frame to its neighbour's, those give all frames, and frames and lengths give
// the positions by a Poisson system.
#include "meshtween/geometry/topology.h"
#include "meshtween/morph/methods.h"
#include "meshtween/morph/rigid_motion.h"
#include "meshtween/morph/rotation_graph.h"
#include "meshtween/solve/cholesky.h"
#include "meshtween/solve/laplacian.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace meshtween {
namespace {

using Corners = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
using Flat = Eigen::Matrix<double, 3, 2>; // a triangle's corners in its own plane, edge 0-1 along x

struct Shared { // an edge between two triangles
    int first = 0, second = 0;
    int vertices[2] = {0, 0};
    double angle_from = 0, angle_to = 0; // from the first's normal to the second's about the edge
};

struct State {
    Points from, to; // centred
    RigidMotion motion;
    Triangles triangles;
    Corners lengths_from, lengths_to, weights;
    std::vector<Shared> shared;
    std::vector<RotationRoot> roots_from, roots_to;
    std::vector<int> component;
    SparseCholesky poisson;
};

Flat flat(const Eigen::RowVector3d& length) {
    const double x = length[0] > 0 ? (length.squaredNorm() - 2 * length[1] * length[1]) / (2 * length[0]) : 0;
    const double y = std::sqrt(std::max(0.0, length[2] * length[2] - x * x));
    return Flat{{0, 0}, {length[0], 0}, {x, y}};
}

// Axes of a triangle as columns: its first edge, its normal last. The identity where it has no area.
Eigen::Matrix3d frame(const Points& p, const Triangles& triangles, Eigen::Index t) {
    const Eigen::Vector3d e = p.row(triangles(t, 1)) - p.row(triangles(t, 0));
    const Eigen::Vector3d normal = e.cross(Eigen::Vector3d(p.row(triangles(t, 2)) - p.row(triangles(t, 0))));
    if (normal.norm() <= 1e-300) return Eigen::Matrix3d::Identity();
    Eigen::Matrix3d axes;
    axes.col(0) = e.normalized();
    axes.col(2) = normal.normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    return axes;
}

double bend(const Points& p, const Triangles& triangles, const Shared& edge) {
    const Eigen::Vector3d along = (p.row(edge.vertices[1]) - p.row(edge.vertices[0])).normalized();
    const Eigen::Vector3d a = frame(p, triangles, edge.first).col(2), b = frame(p, triangles, edge.second).col(2);
    return std::atan2(a.cross(b).dot(along), a.dot(b));
}

// The direction of the edge from vertex i to j in the triangle's own plane.
double heading(const Flat& corners, const Triangles& triangles, int t, const int* ij) {
    Eigen::RowVector2d way(0, 0);
    for (int k = 0; k < 3; ++k) {
        if (triangles(t, k) == ij[1]) way += corners.row(k);
        if (triangles(t, k) == ij[0]) way -= corners.row(k);
    }
    return std::atan2(way[1], way[0]);
}

Points shape_at(const State& s, const Eigen::VectorXd& u, double whole) {
    const Eigen::Index m = s.triangles.rows();
    std::vector<Flat> corners;
    for (Eigen::Index t = 0; t < m; ++t) {
        Eigen::RowVector3d length;
        for (int k = 0; k < 3; ++k) {
            const double own = (u[s.triangles(t, k)] + u[s.triangles(t, (k + 1) % 3)]) / 2;
            length[k] = (1 - own) * s.lengths_from(t, k) + own * s.lengths_to(t, k);
        }
        corners.push_back(flat(length));
    }
    const auto turn = [](double angle, const Eigen::Vector3d& axis) { return Eigen::AngleAxisd(angle, axis); };
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), z = Eigen::Vector3d::UnitZ();
    std::vector<RotationLink> links;
    for (const Shared& edge : s.shared) {
        const double own = (u[edge.vertices[0]] + u[edge.vertices[1]]) / 2;
        const double first =
            heading(corners[static_cast<std::size_t>(edge.first)], s.triangles, edge.first, edge.vertices);
        const double second =
            heading(corners[static_cast<std::size_t>(edge.second)], s.triangles, edge.second, edge.vertices);
        const double angle = (1 - own) * edge.angle_from + own * edge.angle_to;
        links.push_back(
            {edge.first, edge.second, (turn(first, z) * turn(angle, x) * turn(-second, z)).toRotationMatrix(), 1});
    }
    std::vector<RotationRoot> roots;
    for (std::size_t r = 0; r < s.roots_from.size(); ++r) {
        const Eigen::AngleAxisd way(s.roots_from[r].rotation.transpose() * s.roots_to[r].rotation);
        const double own = u[s.triangles(s.roots_from[r].node, 0)];
        roots.push_back(
            {s.roots_from[r].node, s.roots_from[r].rotation * turn(own * way.angle(), way.axis()).toRotationMatrix()});
    }
    const Quaternions frames = synchronised(static_cast<int>(m), links, roots);
    Points right = Points::Zero(s.from.rows(), 3);
    for (Eigen::Index t = 0; t < m; ++t) {
        const Flat& c = corners[static_cast<std::size_t>(t)];
        for (int k = 0; k < 3; ++k) {
            const Eigen::RowVector2d e = c.row((k + 1) % 3) - c.row(k);
            const Eigen::Vector3d edge =
                s.weights(t, k) * (frames[static_cast<std::size_t>(t)] * Eigen::Vector3d(e[0], e[1], 0));
            right.row(s.triangles(t, k)) -= edge.transpose();
            right.row(s.triangles(t, (k + 1) % 3)) += edge.transpose();
        }
    }
    Points p = s.poisson.solve(right);
    const int count = *std::max_element(s.component.begin(), s.component.end()) + 1;
    Points off = Points::Zero(count, 3); // components' centres move on straight lines
    Eigen::VectorXd members = Eigen::VectorXd::Zero(count);
    for (Eigen::Index i = 0; i < p.rows(); ++i) {
        const int c = s.component[static_cast<std::size_t>(i)];
        off.row(c) += s.from.row(i) + u[i] * (s.to.row(i) - s.from.row(i)) - p.row(i);
        members[c] += 1;
    }
    for (Eigen::Index i = 0; i < p.rows(); ++i) {
        const int c = s.component[static_cast<std::size_t>(i)];
        p.row(i) += off.row(c) / members[c];
    }
    return placed(s.motion, p, whole);
}

// The first triangle of each part that hangs together by shared edges.
std::vector<int> first_of_parts(Eigen::Index triangle_count, const std::vector<Shared>& shared) {
    std::vector<int> part(static_cast<std::size_t>(triangle_count));
    for (std::size_t t = 0; t < part.size(); ++t) part[t] = static_cast<int>(t);
    const auto top = [&](int t) {
        while (part[static_cast<std::size_t>(t)] != t)
            t = part[static_cast<std::size_t>(t)] = part[static_cast<std::size_t>(part[static_cast<std::size_t>(t)])];
        return t;
    };
    for (const Shared& edge : shared) {
        const int a = top(edge.first), b = top(edge.second);
        part[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
    std::vector<int> first;
    for (int t = 0; t < triangle_count; ++t)
        if (top(t) == t) first.push_back(t);
    return first;
}

} // namespace

Morph edges_morph(const Mesh& from, const Points& to) {
    if (from.triangles.rows() == 0) return linear_morph(from.positions, to);
    const Topology top = topology(from.positions.rows(), from.triangles);
    const RigidMotion motion = best_rigid_motion(from.positions, to);
    const Points a = centred_from(motion, from.positions), b = centred_to(motion, to);
    const Corners lengths_a = edge_lengths(a, from.triangles), lengths_b = edge_lengths(b, from.triangles);
    const Corners weights = half_cotangents((lengths_a + lengths_b) / 2);
    const std::vector<int> component = components(top);
    SparseMatrix matrix = held(cotangent_laplacian(a.rows(), from.triangles, weights), component);
    std::vector<Shared> shared;
    for (const Edge& edge : top.edges) {
        if (edge.triangles[1] < 0 || edge.triangles[0] == edge.triangles[1]) continue;
        Shared s{edge.triangles[0], edge.triangles[1], {edge.vertices[0], edge.vertices[1]}, 0, 0};
        s.angle_from = bend(a, from.triangles, s);
        s.angle_to = bend(b, from.triangles, s);
        shared.push_back(s);
    }
    std::vector<RotationRoot> roots_from, roots_to;
    for (const int t : first_of_parts(from.triangles.rows(), shared)) {
        roots_from.push_back({t, frame(a, from.triangles, t)});
        roots_to.push_back({t, frame(b, from.triangles, t)});
    }
    const auto state = std::make_shared<const State>(State{a, b, motion, from.triangles, lengths_a, lengths_b, weights,
                                                           std::move(shared), roots_from, roots_to, component,
                                                           SparseCholesky(matrix)});
    const auto at = [state](const Eigen::VectorXd& u, double whole) { return shape_at(*state, u, whole); };
    return {[at, first = from.positions, last = to](double u) {
                return u == 0 ? first : u == 1 ? last : at(Eigen::VectorXd::Constant(first.rows(), u), u);
            },
            at, [] { return SolveReport{}; }};
}

} // namespace meshtween
