// Umeyama: Least-squares estimation of transformation parameters between two point patterns. PAMI 1991.
#include "meshtween/fit/align.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/search/closest_point.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <array>
#include <cmath>

namespace meshtween {
namespace {

using Eigen::Matrix3d;

// Area, centre and second moments of a surface, each triangle as its three edge midpoints (exact to second order).
struct Extent {
    double area = 0;
    Point centre{0, 0, 0};
    Matrix3d spread = Matrix3d::Zero();
};

Extent extent(const Points& positions, const Triangles& triangles) {
    Extent e;
    const auto each = [&](const auto& visit) {
        for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
            const double third = triangle_area(positions, triangles, t) / 3;
            for (int k = 0; k < 3; ++k)
                visit(third, Point(0.5 * (positions.row(triangles(t, k)) + positions.row(triangles(t, (k + 1) % 3)))));
        }
    };
    each([&](double w, const Point& p) { e.area += w, e.centre += w * p; });
    if (e.area <= 0) return e;
    e.centre /= e.area;
    each([&](double w, const Point& p) { e.spread += w / e.area * (p - e.centre).transpose() * (p - e.centre); });
    return e;
}

constexpr int sample_count = 500; // vertices looked at in each direction; enough to tell 24 ways apart

double mean_distance(const Points& points, const ClosestPointIndex& index, const Similarity* to_apply) {
    const Eigen::Index step = std::max<Eigen::Index>(1, points.rows() / sample_count);
    double sum = 0;
    for (Eigen::Index i = 0; i < points.rows(); i += step) {
        Point p = points.row(i);
        if (to_apply) p = to_apply->scale * p * to_apply->rotation.transpose() + to_apply->translation;
        sum += std::sqrt(index.closest(p).squared_distance);
    }
    return sum * static_cast<double>(step) / static_cast<double>(points.rows());
}

Similarity inverse(const Similarity& s) {
    Similarity r;
    r.scale = 1 / s.scale;
    r.rotation = s.rotation.transpose();
    r.translation = -r.scale * s.translation * s.rotation;
    return r;
}

} // namespace

Points Similarity::operator()(const Points& points) const {
    return ((scale * points * rotation.transpose()).rowwise() + translation).eval();
}

namespace {

// Of matching points around the middles a and b.
Similarity around(const Point& a, const Points& x, const Point& b, const Points& y) {
    Similarity s;
    const double spread = x.squaredNorm();
    if (spread > 0) {
        const Eigen::JacobiSVD<Matrix3d> svd(y.transpose() * x, Eigen::ComputeFullU | Eigen::ComputeFullV);
        const Eigen::Vector3d sigma = svd.singularValues();
        if (sigma[1] > 1e-9 * sigma[0]) {
            Eigen::Vector3d sign(1, 1, svd.matrixU().determinant() * svd.matrixV().determinant() < 0 ? -1 : 1);
            s.rotation = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
            s.scale = sigma.dot(sign) / spread;
        } else if (sigma[0] > 0) { // on one line: the least turn that takes one direction to the other
            s.rotation = Eigen::Quaterniond::FromTwoVectors(svd.matrixV().col(0), svd.matrixU().col(0)).matrix();
            s.scale = sigma[0] / spread;
        }
    }
    s.translation = b - s.scale * a * s.rotation.transpose();
    return s;
}

} // namespace

Similarity align(const Points& from, const Points& to) {
    if (from.rows() == 0) return {};
    const Point a = from.colwise().mean(), b = to.colwise().mean();
    return around(a, from.rowwise() - a, b, to.rowwise() - b);
}

Similarity align(const Points& from, const Points& to, const Eigen::VectorXd& weights) {
    const double whole = weights.sum();
    if (!(whole > 0)) return align(from, to);
    const Point a = weights.transpose() * from / whole, b = weights.transpose() * to / whole;
    const Eigen::VectorXd roots = weights.cwiseSqrt();
    return around(a, roots.asDiagonal() * (from.rowwise() - a), b, roots.asDiagonal() * (to.rowwise() - b));
}

Similarity align_axes(const Points& from, const Triangles& from_triangles, const Points& to,
                      const Triangles& to_triangles) {
    const Extent a = extent(from, from_triangles), b = extent(to, to_triangles);
    const ClosestPointIndex on_from(from, from_triangles), on_to(to, to_triangles);
    Matrix3d u = Eigen::SelfAdjointEigenSolver<Matrix3d>(a.spread).eigenvectors();
    Matrix3d v = Eigen::SelfAdjointEigenSolver<Matrix3d>(b.spread).eigenvectors();
    if (u.determinant() < 0) u.col(0) *= -1;
    if (v.determinant() < 0) v.col(0) *= -1;
    const double scale = a.area > 0 ? std::sqrt(b.area / a.area) : 1;
    const auto turned = [&](const Matrix3d& rotation) {
        return Similarity{scale, rotation, b.centre - scale * a.centre * rotation.transpose()};
    };
    const auto distance = [&](const Similarity& s) {
        const Similarity back = inverse(s);
        return mean_distance(from, on_to, &s) + s.scale * mean_distance(to, on_from, &back);
    };
    constexpr std::array<std::array<int, 3>, 6> orders{
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    constexpr double clearly = 0.75; // of the distance as the files stand: shapes that people pair mostly stand alike
    Similarity best = turned(Matrix3d::Identity());
    double least = clearly * distance(best);
    for (std::size_t order = 0; order < 6; ++order)
        for (int signs = 0; signs < 8; ++signs) {
            Matrix3d p = Matrix3d::Zero(); // a signed permutation of the axes
            for (int k = 0; k < 3; ++k) p(orders[order][static_cast<std::size_t>(k)], k) = (signs >> k & 1) ? -1 : 1;
            if (p.determinant() < 0) continue;
            const Similarity s = turned(v * p * u.transpose());
            const double d = distance(s);
            if (d < least) least = d, best = s;
        }
    return best;
}

} // namespace meshtween
