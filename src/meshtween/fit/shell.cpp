// The bending energy of a triangle mesh as a quadratic form a hinge, measured against the rest shape turned by local
// frames.
//
// Bergou, Wardetzky, Harmon, Zorin, Grinspun: A quadratic bending model for inextensible surfaces. SGP 2006. Taken edge
// by edge rather than summed at vertices, its null space is that of the Hessian, so that open borders do not flutter.
// Stein, Grinspun, Wardetzky, Jacobson: Natural boundary conditions for smoothing in geometry processing. TOG 2018.
// Sorkine, Alexa: As-rigid-as-possible surface modeling. SGP 2007 (local frames, the membrane's force).
#include "meshtween/fit/shell.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/gather.h"
#include "meshtween/geometry/measure.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <utility>

namespace meshtween {
namespace {

using Eigen::Matrix3d;

constexpr double least_edge_weight = 0.05, greatest_edge_weight = 5; // of cotangent weights: slivers cannot rule
constexpr double greatest_stiffness = 64;                            // of a hinge's squared coefficients, likewise
constexpr double normal_share = 0.2; // of the normal beside the edges in a frame: settles flat and open places

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

double cotangent(const Point& u, const Point& v) {
    return u.dot(v) / std::max(1e-14, u.cross(v).norm());
}

int across(const Triangles& triangles, int triangle, int a, int b) {
    for (int k = 0; k < 3; ++k)
        if (triangles(triangle, k) != a && triangles(triangle, k) != b) return triangles(triangle, k);
    return -1;
}

void add_edge_weights(Shell& shell) {
    const Lists& neighbours = shell.topology.neighbours;
    shell.edge_weights.assign(neighbours.items.size(), 0);
    parallel_for(std::ssize(shell.topology.edges), [&](std::ptrdiff_t e) {
        const Edge& edge = shell.topology.edges[idx(e)];
        const auto [i, j] = edge.vertices;
        double weight = 0;
        for (const int t : edge.triangles) {
            const int l = t < 0 ? -1 : across(shell.triangles, t, i, j);
            if (l < 0) continue;
            weight += cotangent(shell.rest.row(i) - shell.rest.row(l), shell.rest.row(j) - shell.rest.row(l)) / 2;
        }
        for (const auto& [from, to] : {std::pair(i, j), std::pair(j, i)}) {
            const auto list = neighbours[from];
            const auto at = std::lower_bound(list.begin(), list.end(), to) - list.begin();
            shell.edge_weights[idx(neighbours.first[idx(from)] + at)] =
                std::clamp(weight, least_edge_weight, greatest_edge_weight);
        }
    });
}

// Of weight 0 where the edge has not two triangles with a corner each.
Hinge hinge(const Points& x, const Triangles& triangles, const Edge& edge, double area) {
    if (edge.count != 2) return {};
    const auto [i, j] = edge.vertices;
    const int k = across(triangles, edge.triangles[0], i, j), l = across(triangles, edge.triangles[1], i, j);
    if (k < 0 || l < 0 || k == l) return {};
    const Point along = x.row(j) - x.row(i);
    const double at_i0 = cotangent(along, x.row(k) - x.row(i)), at_i1 = cotangent(along, x.row(l) - x.row(i));
    const double at_j0 = cotangent(-along, x.row(k) - x.row(j)), at_j1 = cotangent(-along, x.row(l) - x.row(j));
    Hinge result{{i, j, k, l}, {at_j0 + at_j1, at_i0 + at_i1, -at_i0 - at_j0, -at_i1 - at_j1}, 0};
    double squared = 0;
    for (const double c : result.coefficients) squared += c * c;
    if (squared > greatest_stiffness)
        for (double& c : result.coefficients) c *= std::sqrt(greatest_stiffness / squared);
    const double both = triangle_area(x, triangles, edge.triangles[0]) + triangle_area(x, triangles, edge.triangles[1]);
    const double floor = std::max(0.2 * along.squaredNorm(), 1e-14 * area);
    result.weight = 3 / std::max(both, floor) / area;
    return result;
}

void add_hinges(Shell& shell, double area) {
    shell.hinges.resize(shell.topology.edges.size());
    parallel_for(std::ssize(shell.hinges), [&](std::ptrdiff_t e) {
        shell.hinges[idx(e)] = hinge(shell.rest, shell.triangles, shell.topology.edges[idx(e)], area);
    });
    std::erase_if(shell.hinges, [](const Hinge& h) { return h.weight == 0; });
    shell.vertex_hinges = gather(shell.rest.rows(), [&](const auto& put) {
        for (std::size_t h = 0; h < shell.hinges.size(); ++h)
            for (std::size_t k = 0; k < 4; ++k) put(shell.hinges[h].vertices[k], static_cast<int>(4 * h + k));
    });
}

void add_forms(Shell& shell, double area) {
    const std::ptrdiff_t n = shell.rest.rows();
    const Lists& neighbours = shell.topology.neighbours;
    const auto entries = std::make_shared<const Pattern>(pattern(gather(n, [&](const auto& put) {
        for (int i = 0; i < n; ++i) {
            put(i, i);
            for (const int j : neighbours[i]) put(i, j);
        }
        for (const Hinge& h : shell.hinges) put(h.vertices[2], h.vertices[3]), put(h.vertices[3], h.vertices[2]);
    })));
    shell.bending.assign(entries->column.size(), 0);
    shell.membrane.assign(entries->column.size(), 0);
    parallel_for(n, [&](std::ptrdiff_t row) {
        const int i = static_cast<int>(row);
        for (const int at : shell.vertex_hinges[i]) {
            const Hinge& h = shell.hinges[idx(at / 4)];
            for (std::size_t q = 0; q < 4; ++q)
                shell.bending[entries->at(i, h.vertices[q])] +=
                    h.weight * h.coefficients[idx(at % 4)] * h.coefficients[q];
        }
        for (int e = neighbours.first[idx(i)]; e < neighbours.first[idx(i) + 1]; ++e) {
            const double w = shell.edge_weights[idx(e)] / area;
            shell.membrane[entries->at(i, neighbours.items[idx(e)])] -= w;
            shell.membrane[idx(entries->diagonal[idx(i)])] += w;
        }
    });
    shell.pattern = entries;
}

// The rotation nearest to a matrix: Newton's iteration on the polar decomposition where the determinant is safely
// positive (Higham 1986), else by singular values.
Matrix3d nearest_rotation(const Matrix3d& m) {
    const double size = m.norm();
    Matrix3d r = m / std::max(size, 1e-300);
    if (r.determinant() > 1e-3) {
        for (int step = 0; step < 30; ++step) {
            const Matrix3d inverse = r.inverse().transpose();
            const double gamma = std::sqrt(inverse.norm() / r.norm());
            const Matrix3d next = 0.5 * (gamma * r + inverse / gamma);
            const double change = (next - r).squaredNorm();
            r = next;
            if (change < 1e-24) break;
        }
        return r;
    }
    const Eigen::JacobiSVD<Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Matrix3d u = svd.matrixU();
    if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) *= -1;
    return u * svd.matrixV().transpose();
}

// What a vertex's edges say: deformed^T rest and rest^T rest, and both normals.
struct Moments {
    Matrix3d turn = Matrix3d::Zero();
    double edges = 0, both = 0; // sum of w e.e, and of w e'.e' for the scale
};

std::vector<Moments> moments(const Shell& shell, const Points& positions) {
    const Points now = vertex_normals(positions, shell.triangles);
    std::vector<Moments> result(shell.area.size());
    parallel_for(positions.rows(), [&](std::ptrdiff_t i) {
        Moments& m = result[static_cast<std::size_t>(i)];
        const int first = shell.topology.neighbours.first[static_cast<std::size_t>(i)];
        const auto list = shell.topology.neighbours[i];
        for (std::size_t k = 0; k < list.size(); ++k) {
            const double w = shell.edge_weights[static_cast<std::size_t>(first) + k];
            const Point e = shell.rest.row(list[k]) - shell.rest.row(i), f = positions.row(list[k]) - positions.row(i);
            m.turn += w * f.transpose() * e;
            m.edges += w * e.squaredNorm();
            m.both += w * f.squaredNorm();
        }
        m.turn += normal_share / 2 * m.edges * now.row(i).transpose() * shell.normals.row(i);
    });
    return result;
}

} // namespace

Shell shell(const Points& rest, const Triangles& triangles) {
    Shell result;
    result.rest = rest;
    result.triangles = triangles;
    result.topology = topology(rest.rows(), triangles);
    result.normals = vertex_normals(rest, triangles);
    const double area = surface_area(rest, triangles);
    result.area = vertex_area_shares(rest, triangles);
    result.border = border_edges(triangles, result.topology);
    result.border_size = border_sizes(rest, result.border);
    add_edge_weights(result);
    add_hinges(result, area);
    add_forms(result, area);
    return result;
}

void end_borders(Shell& shell, const std::vector<char>& cut_off) {
    Triangles left(shell.border.rows(), 3);
    Eigen::Index count = 0;
    for (const auto edge : shell.border.rowwise())
        if (!cut_off[idx(edge[0])] || !cut_off[idx(edge[1])]) left.row(count++) = edge;
    shell.border = left.topRows(count);
    shell.border_size = border_sizes(shell.rest, shell.border);
}

std::vector<double> vertex_area_shares(const Points& positions, const Triangles& triangles) {
    const double area = surface_area(positions, triangles);
    std::vector<double> shares(static_cast<std::size_t>(positions.rows()), 0);
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            shares[static_cast<std::size_t>(triangles(t, k))] += triangle_area(positions, triangles, t) / 3 / area;
    return shares;
}

std::vector<Matrix3d> local_frames(const Shell& shell, const Points& positions, int smoothing, bool with_scale) {
    std::vector<Moments> m = moments(shell, positions), next(m.size());
    const auto count = static_cast<std::ptrdiff_t>(m.size());
    for (int round = 0; round < smoothing; ++round) {
        parallel_for(count, [&](std::ptrdiff_t i) {
            const auto list = shell.topology.neighbours[i];
            Moments sum;
            for (const int j : list) {
                const Moments& other = m[static_cast<std::size_t>(j)];
                sum.turn += other.turn, sum.edges += other.edges, sum.both += other.both;
            }
            const double share = list.empty() ? 0 : 1 / static_cast<double>(list.size());
            const Moments& own = m[static_cast<std::size_t>(i)];
            next[static_cast<std::size_t>(i)] = {(own.turn + share * sum.turn) / 2, (own.edges + share * sum.edges) / 2,
                                                 (own.both + share * sum.both) / 2};
        });
        m.swap(next);
    }
    std::vector<Matrix3d> frames(m.size());
    parallel_for(count, [&](std::ptrdiff_t i) {
        const Moments& own = m[static_cast<std::size_t>(i)];
        frames[static_cast<std::size_t>(i)] = nearest_rotation(own.turn);
        if (with_scale && own.edges > 0)
            frames[static_cast<std::size_t>(i)] *= std::clamp(std::sqrt(own.both / own.edges), 0.3, 3.0);
    });
    return frames;
}

std::vector<Matrix3d> calmed(std::vector<Matrix3d> frames, double angle) {
    if (angle <= 0) return frames;
    parallel_for(static_cast<std::ptrdiff_t>(frames.size()), [&](std::ptrdiff_t i) {
        Matrix3d& frame = frames[static_cast<std::size_t>(i)];
        const double scale = std::cbrt(frame.determinant());
        if (!(scale > 0)) return;
        Eigen::AngleAxisd turn(Matrix3d(frame / scale));
        if (turn.angle() >= angle) return;
        const double t = turn.angle() / angle, share = t * t * (3 - 2 * t);
        turn.angle() *= share;
        frame = std::pow(scale, share) * turn.toRotationMatrix();
    });
    return frames;
}

Points rest_force(const Shell& shell, const std::vector<Matrix3d>& frames, double bending_weight,
                  double membrane_weight) {
    // Each vertex gathers: from its hinges, with the mean frame of the edge's ends, and from its own entries of the
    // membrane's matrix times the rest shape, with the mean frame of the pair.
    Points force = Points::Zero(shell.rest.rows(), 3);
    if (bending_weight > 0) {
        Points turned(std::ssize(shell.hinges), 3);
        parallel_for(turned.rows(), [&](std::ptrdiff_t e) {
            const Hinge& h = shell.hinges[idx(e)];
            Point jump(0, 0, 0);
            for (std::size_t k = 0; k < 4; ++k) jump += h.coefficients[k] * shell.rest.row(h.vertices[k]);
            const Matrix3d &a = frames[idx(h.vertices[0])], &b = frames[idx(h.vertices[1])];
            turned.row(e) = 0.5 * bending_weight * h.weight * jump * (a + b).transpose();
        });
        parallel_for(shell.rest.rows(), [&](std::ptrdiff_t i) {
            for (const int at : shell.vertex_hinges[i])
                force.row(i) += shell.hinges[idx(at / 4)].coefficients[idx(at % 4)] * turned.row(at / 4);
        });
    }
    if (membrane_weight > 0)
        parallel_for(shell.rest.rows(), [&](std::ptrdiff_t i) {
            const auto list = shell.topology.neighbours[i];
            for (const int j : list) {
                const double w = -shell.membrane[shell.pattern->at(static_cast<int>(i), j)];
                const Matrix3d mean = 0.5 * (frames[static_cast<std::size_t>(i)] + frames[static_cast<std::size_t>(j)]);
                force.row(i) += membrane_weight * w * (shell.rest.row(i) - shell.rest.row(j)) * mean.transpose();
            }
        });
    return force;
}

} // namespace meshtween
