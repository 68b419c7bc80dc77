// Liu, Zhang, Xu, Gotsman and Gortler, A Local/Global Approach to Mesh Parameterization, 2008 (the rounds, here with
// triangles laid in space); Peng, Deng, Zhang, Geng, Qin and Liu, Anderson Acceleration for Geometry Optimization and
// Physics Simulation, 2018.
#include "meshtween/morph/blended_lengths.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

namespace meshtween {
namespace {

using Edges = std::array<Eigen::Vector3d, 3>; // from corner k to k + 1

Edges edges_of(const Points& p, const Triangles& triangles, Eigen::Index t) {
    const auto corner = [&](int k) -> Eigen::Vector3d { return p.row(triangles(t, k)).transpose(); };
    return {corner(1) - corner(0), corner(2) - corner(1), corner(0) - corner(2)};
}

// The triangle's edges at their wanted lengths, in the plane of the triangle as it is and turned to it best.
Edges laid(const LengthProblem& problem, const Points& shape, Eigen::Index t) {
    const Edges now = edges_of(shape, problem.triangles, t), a = edges_of(problem.from, problem.triangles, t),
                b = edges_of(problem.to, problem.triangles, t);
    std::array<double, 3> want{};
    for (std::size_t k = 0; k < 3; ++k) want[k] = (a[k].norm() + b[k].norm()) / 2;
    const Eigen::Vector3d normal = now[0].cross(now[1]);
    const double longest = std::max({want[0], want[1], want[2]}), twice = normal.norm(), base = now[0].norm();
    // The wanted triangle has corners (0, 0), (want[0], 0) and (x, y).
    const double x = want[0] > 0 ? (want[0] * want[0] + want[2] * want[2] - want[1] * want[1]) / (2 * want[0]) : 0;
    const double y = std::sqrt(std::max(0.0, want[2] * want[2] - x * x));
    if (!(y > 1e-6 * longest && want[0] > 1e-6 * longest && twice > 1e-12 * longest * longest)) return now;
    const Eigen::Vector3d first = now[0] / base, second = normal.cross(now[0]) / (twice * base);
    // The map from the wanted triangle to this one is [j00 j01; 0 j11]; its polar part turns by `angle`.
    const double j00 = base / want[0], j01 = (-now[2].dot(first) - j00 * x) / y, j11 = -now[2].dot(second) / y;
    const double angle = std::atan2(-j01, j00 + j11);
    const Eigen::Vector3d along = std::cos(angle) * first + std::sin(angle) * second;
    const Eigen::Vector3d across = std::cos(angle) * second - std::sin(angle) * first;
    Edges edges;
    edges[0] = want[0] * along;
    edges[2] = -(x * along + y * across);
    edges[1] = -edges[0] - edges[2];
    return edges;
}

Points put_together(const LengthProblem& problem, const Points& shape) {
    std::vector<Edges> edges(static_cast<std::size_t>(problem.triangles.rows()));
    parallel_for(problem.triangles.rows(),
                 [&](Eigen::Index t) { edges[static_cast<std::size_t>(t)] = laid(problem, shape, t); });
    Points right(shape.rows(), 3);
    parallel_for(shape.rows(), [&](Eigen::Index i) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const int t : problem.vertex_triangles[i]) {
            const Edges& edge = edges[static_cast<std::size_t>(t)];
            for (std::size_t k = 0; k < 3; ++k) {
                const auto corner = static_cast<Eigen::Index>(k), before = (corner + 2) % 3;
                if (problem.triangles(t, corner) == i)
                    sum += problem.weights(t, before) * edge[(k + 2) % 3] - problem.weights(t, corner) * edge[k];
            }
        }
        right.row(i) = sum.transpose();
    });
    Points result = problem.poisson.solve(right);
    result.rowwise() -= Point(result.colwise().mean());
    return result;
}

// The shape a little fatter or thinner, all alike. Lengths alone leave it soft: a twisted bar may be fatter and twisted
// less at nearly the same lengths.
Points with_volume(const Points& shape, const Triangles& triangles, double wanted) {
    const double area = surface_area(shape, triangles);
    if (!(area > 0)) return shape;
    return shape + (wanted - volume(shape, triangles)) / area * vertex_normals(shape, triangles);
}

double product(const Points& a, const Points& b) {
    return parallel_sum(a.rows(), 0.0, [&](Eigen::Index i) { return a.row(i).dot(b.row(i)); });
}

// What the last steps say about the next: the combination of them whose remainders cancel best.
class Anderson {
public:
    // `mapped` is where a round takes `place`.
    Points next(const Points& place, const Points& mapped) {
        const Points rest = mapped - place;
        if (last_rest_.size() > 0) {
            steps_.push_back({place - last_place_, rest - last_rest_});
            if (steps_.size() > depth) steps_.pop_front();
        }
        last_place_ = place, last_rest_ = rest;
        const auto k = static_cast<Eigen::Index>(steps_.size());
        if (k == 0) return mapped;
        Eigen::MatrixXd normal(k, k);
        Eigen::VectorXd right(k);
        for (Eigen::Index i = 0; i < k; ++i) {
            const Points& own = steps_[static_cast<std::size_t>(i)].rest;
            right[i] = product(own, rest);
            for (Eigen::Index j = 0; j <= i; ++j)
                normal(i, j) = normal(j, i) = product(own, steps_[static_cast<std::size_t>(j)].rest);
        }
        normal.diagonal() *= 1 + 1e-8;
        const Eigen::VectorXd share = normal.ldlt().solve(right);
        if (!share.allFinite()) return mapped;
        Points result = mapped;
        for (Eigen::Index i = 0; i < k; ++i) {
            const auto& [place_step, rest_step] = steps_[static_cast<std::size_t>(i)];
            result -= share[i] * (place_step + rest_step);
        }
        return result;
    }

private:
    static constexpr std::size_t depth = 5;
    struct Step {
        Points place, rest;
    };
    std::deque<Step> steps_;
    Points last_place_, last_rest_;
};

} // namespace

double middle_strain(const LengthProblem& problem, const Points& shape) {
    const double sum = parallel_sum(problem.triangles.rows(), 0.0, [&](Eigen::Index t) {
        const Edges now = edges_of(shape, problem.triangles, t), a = edges_of(problem.from, problem.triangles, t),
                    b = edges_of(problem.to, problem.triangles, t);
        double strain = 0;
        for (std::size_t k = 0; k < 3; ++k)
            if (const double want = (a[k].norm() + b[k].norm()) / 2; want > 0)
                strain += std::abs(now[k].norm() / want - 1);
        return strain / 3;
    });
    return problem.triangles.rows() > 0 ? sum / static_cast<double>(problem.triangles.rows()) : 0;
}

Points with_blended_lengths(const LengthProblem& problem, const Points& shape, int rounds) {
    Points best = shape, place = shape;
    place.rowwise() -= Point(place.colwise().mean());
    double least = middle_strain(problem, shape);
    Anderson anderson;
    // A shape of mean size: that of twice the length has eight times the volume, 27/8 of it in the middle.
    const double size =
        std::cbrt(volume(problem.from, problem.triangles)) + std::cbrt(volume(problem.to, problem.triangles));
    const double wanted = std::pow(size / 2, 3);
    for (int round = 0; round < rounds; ++round) {
        Points mapped = put_together(problem, place);
        if (problem.closed) mapped = with_volume(mapped, problem.triangles, wanted);
        place = anderson.next(place, mapped);
        const double strain = middle_strain(problem, place);
        if (strain > 3 * least) break; // thin parts, which a change of volume strains more than it helps
        if (strain < least) least = strain, best = place;
    }
    return best;
}

} // namespace meshtween
