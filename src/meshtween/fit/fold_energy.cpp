// Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov: Foldover-free maps in 50 lines of code. SIGGRAPH 2021 (the
// regularised energy, Eq. 2 and 3), here for triangles in space whose turn is judged against a given normal.
#include "meshtween/fit/fold_energy.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

constexpr double area_share = 0.1; // of keeping areas beside keeping angles

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

using Edges = Eigen::Matrix<double, 3, 2>;

// The map from a triangle's rest shape to where it is.
Edges map_of(const FoldEnergy& energy, const Points& x, Eigen::Index t) {
    const auto f = energy.triangles.row(t);
    Edges edges;
    edges.col(0) = (x.row(f[1]) - x.row(f[0])).transpose();
    edges.col(1) = (x.row(f[2]) - x.row(f[0])).transpose();
    return edges * energy.inverse[idx(t)];
}

double turn(const Edges& map, const Point& outward) {
    return outward.dot(map.col(0).cross(map.col(1)));
}

double shape_energy(const FoldEnergy& energy, const Points& x, Points& gradient) {
    double sum = 0;
    const double soft = energy.softness;
    for (Eigen::Index t = 0; t < energy.triangles.rows(); ++t) {
        const Edges map = map_of(energy, x, t);
        const Eigen::Vector3d a = map.col(0), b = map.col(1), n = energy.outward[idx(t)].transpose();
        const double det = turn(map, energy.outward[idx(t)]), root = std::sqrt(soft * soft + det * det);
        const double positive = std::max((det + root) / 2, 1e-100), rise = (1 + det / root) / 2;
        const double top = map.squaredNorm() / 2 + area_share * (det * det + 1) / 2;
        sum += energy.share[idx(t)] * top / positive;
        const double along = area_share * det / positive - top * rise / (positive * positive);
        Edges slope = map / positive;
        slope.col(0) += along * b.cross(n);
        slope.col(1) += along * n.cross(a);
        const Edges force = energy.share[idx(t)] * slope * energy.inverse[idx(t)].transpose();
        const auto f = energy.triangles.row(t);
        if (f[0] < energy.free) gradient.row(f[0]) -= (force.col(0) + force.col(1)).transpose();
        if (f[1] < energy.free) gradient.row(f[1]) += force.col(0).transpose();
        if (f[2] < energy.free) gradient.row(f[2]) += force.col(1).transpose();
    }
    return sum;
}

} // namespace

double fold_energy(const FoldEnergy& energy, const Points& x, Points& gradient) {
    gradient.setZero(energy.free, 3);
    double sum = shape_energy(energy, x, gradient);
    for (Eigen::Index i = 0; i < energy.free; ++i) {
        const Point& normal = energy.normals[idx(i)];
        const double off = normal.dot(x.row(i) - energy.planes[idx(i)]);
        const Point away = x.row(i) - energy.homes[idx(i)];
        sum += (energy.onto[idx(i)] * off * off + energy.home[idx(i)] * away.squaredNorm()) / 2;
        gradient.row(i) += energy.onto[idx(i)] * off * normal + energy.home[idx(i)] * away;
    }
    for (const FoldPull& pull : energy.pulls) {
        Point off = -pull.place;
        for (std::size_t k = 0; k < 3; ++k)
            off += pull.barycentric[static_cast<Eigen::Index>(k)] * x.row(pull.vertices[k]);
        sum += pull.weight * off.squaredNorm() / 2;
        for (std::size_t k = 0; k < 3; ++k)
            if (pull.vertices[k] < energy.free)
                gradient.row(pull.vertices[k]) += pull.weight * pull.barycentric[static_cast<Eigen::Index>(k)] * off;
    }
    if (energy.sliding)
        for (Eigen::Index i = 0; i < energy.free; ++i)
            gradient.row(i) -= energy.normals[idx(i)].dot(gradient.row(i)) * energy.normals[idx(i)];
    return sum;
}

double stretch(const FoldEnergy& energy, const Points& x, Eigen::Index triangle) {
    return turn(map_of(energy, x, triangle), energy.outward[idx(triangle)]);
}

double least_stretch(const FoldEnergy& energy, const Points& x) {
    double least = 1;
    for (Eigen::Index t = 0; t < energy.triangles.rows(); ++t) least = std::min(least, stretch(energy, x, t));
    return least;
}

bool planar_edges(const Points& rest, const Triangles& triangles, Eigen::Index t, Eigen::Matrix2d& edges) {
    constexpr double flattest = 1e-3;
    const Point a = rest.row(triangles(t, 0)), e = rest.row(triangles(t, 1)) - a, f = rest.row(triangles(t, 2)) - a;
    const double length = e.norm();
    if (!(length > 0)) return false;
    const double along = f.dot(e) / length, height = (f - along / length * e).norm();
    edges << length, along, 0, std::max(height, flattest * length);
    return true;
}

} // namespace meshtween
