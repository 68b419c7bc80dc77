// Amberg, Romdhani, Vetter: Optimal step nonrigid ICP algorithms for surface registration. CVPR 2007, Eq. 1-12, with
// normals weighing the correspondences. The stiffnesses and weights are those that a widely used library has as its
// defaults. It is given the fast parts of this program, its searches and its factorisation, so that the comparison is
// of methods.
#include "nonrigid_icp.h"

#include "meshtween/fit/align.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/search/closest_point.h"
#include "meshtween/solve/cholesky.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace meshtween {
namespace {

struct Step {
    double stiffness, landmarks, normals; // weights of the terms; the last is a power of the normals' cosine
    int rounds;
};
constexpr Step steps[] = {{0.01, 10, 0.5, 10}, {0.02, 5, 0.5, 10}, {0.03, 2.5, 0.5, 10}, {0.01, 0, 0, 10}};
constexpr double farthest = 0.1, still = 1e-4; // parts of the diagonal

using Entries = std::vector<Eigen::Triplet<double>>;

// Eq. 4: neighbours' maps differ little.
void add_stiffness(Entries& entries, const Topology& topology, double weight) {
    for (const Edge& edge : topology.edges)
        for (int k = 0; k < 4; ++k) {
            const int i = 4 * edge.vertices[0] + k, j = 4 * edge.vertices[1] + k;
            entries.insert(entries.end(), {{i, i, weight}, {j, j, weight}, {i, j, -weight}, {j, i, -weight}});
        }
}

// A point of the rest shape, a sum of vertices, goes to a place: Eq. 3 and Eq. 8.
void add_place(Entries& entries, Points& right, const Points& rest, std::span<const int> vertices, const Point& shares,
               const Point& place, double weight) {
    Eigen::VectorXd row(4 * std::ssize(vertices));
    for (std::ptrdiff_t c = 0; c < std::ssize(vertices); ++c)
        row.segment<4>(4 * c) = shares[c] * rest.row(vertices[static_cast<std::size_t>(c)]).homogeneous().transpose();
    const auto slot = [&](Eigen::Index r) {
        return 4 * vertices[static_cast<std::size_t>(r / 4)] + static_cast<int>(r % 4);
    };
    for (Eigen::Index r = 0; r < row.size(); ++r) {
        right.row(slot(r)) += weight * row[r] * place;
        for (Eigen::Index s = 0; s < row.size(); ++s) entries.emplace_back(slot(r), slot(s), weight * row[r] * row[s]);
    }
}

} // namespace

Points nonrigid_icp(const Mesh& source, const Mesh& target_mesh, std::span<const Marker> markers) {
    const double size = diagonal(target_mesh);
    const Points target = target_mesh.positions / size;
    Points from(std::ssize(markers), 3), goals(std::ssize(markers), 3);
    for (std::size_t k = 0; k < markers.size(); ++k) {
        from.row(static_cast<Eigen::Index>(k)) = position(source.positions, source.triangles, markers[k].source);
        goals.row(static_cast<Eigen::Index>(k)) = markers[k].target / size;
    }
    const Points rest = align(from, goals)(source.positions);
    const Topology edges = topology(rest.rows(), source.triangles);
    const ClosestPointIndex index(target, target_mesh.triangles);
    Points x = rest;
    for (const Step& step : steps)
        for (int round = 0; round < step.rounds; ++round) {
            Entries entries;
            Points right = Points::Zero(4 * rest.rows(), 3);
            add_stiffness(entries, edges, step.stiffness * step.stiffness);
            const Points normals = vertex_normals(x, source.triangles);
            const std::vector<ClosestPoint> closest = index.closest(x);
            for (int i = 0; i < static_cast<int>(rest.rows()); ++i) {
                const ClosestPoint& there = closest[static_cast<std::size_t>(i)];
                const double cosine = std::max(0.0, normals.row(i).dot(index.normals().row(there.where.triangle)));
                const double weight = there.squared_distance > farthest * farthest ? 0 : std::pow(cosine, step.normals);
                add_place(entries, right, rest, {&i, 1}, {1, 0, 0}, there.position, weight * weight + 1e-12);
            }
            for (std::size_t k = 0; k < markers.size(); ++k) {
                const auto corners = source.triangles.row(markers[k].source.triangle);
                const int vertices[] = {corners[0], corners[1], corners[2]};
                add_place(entries, right, rest, vertices, markers[k].source.barycentric,
                          goals.row(static_cast<Eigen::Index>(k)), step.landmarks * step.landmarks);
            }
            Eigen::SparseMatrix<double> matrix(right.rows(), right.rows());
            matrix.setFromTriplets(entries.begin(), entries.end());
            const Points maps = SparseCholesky(matrix).solve(right);
            Points next(x.rows(), 3);
            for (Eigen::Index i = 0; i < x.rows(); ++i)
                next.row(i) = rest.row(i).homogeneous() * maps.middleRows<4>(4 * i);
            const double moved = (next - x).rowwise().norm().mean();
            x = std::move(next);
            if (moved < still) break;
        }
    return x * size;
}

} // namespace meshtween
