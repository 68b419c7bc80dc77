// Small shapes whose in-betweens are known.
#pragma once

#include "meshtween/core/mesh.h"

#include <Eigen/Geometry>

#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace meshtween::test {

constexpr double degree = std::numbers::pi / 180;

// A closed box of length x width x width along x from the origin, of squares of side 1, each cut in two.
inline Mesh bar(int length = 40, int width = 4) {
    Mesh mesh;
    std::map<std::array<int, 3>, int> index;
    std::vector<std::array<int, 3>> grid, faces;
    const auto vertex = [&](std::array<int, 3> p) {
        const auto [it, added] = index.emplace(p, static_cast<int>(grid.size()));
        if (added) grid.push_back(p);
        return it->second;
    };
    const std::array<int, 3> size{length, width, width};
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) {
            const int s = (axis + 1) % 3, t = (axis + 2) % 3;
            for (int i = 0; i < size[static_cast<std::size_t>(s)]; ++i)
                for (int j = 0; j < size[static_cast<std::size_t>(t)]; ++j) {
                    const auto at = [&](int di, int dj) {
                        std::array<int, 3> p{};
                        p[static_cast<std::size_t>(axis)] = side * size[static_cast<std::size_t>(axis)];
                        p[static_cast<std::size_t>(s)] = i + di;
                        p[static_cast<std::size_t>(t)] = j + dj;
                        return vertex(p);
                    };
                    const int a = at(0, 0), b = at(1, 0), c = at(1, 1), d = at(0, 1);
                    if (side == 1)
                        faces.insert(faces.end(), {{a, b, c}, {a, c, d}});
                    else
                        faces.insert(faces.end(), {{a, c, b}, {a, d, c}});
                }
        }
    mesh.positions.resize(static_cast<Eigen::Index>(grid.size()), 3);
    for (std::size_t i = 0; i < grid.size(); ++i)
        mesh.positions.row(static_cast<Eigen::Index>(i)) << grid[i][0], grid[i][1] - width / 2.0,
            grid[i][2] - width / 2.0;
    mesh.triangles.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t t = 0; t < faces.size(); ++t)
        mesh.triangles.row(static_cast<Eigen::Index>(t)) << faces[t][0], faces[t][1], faces[t][2];
    return mesh;
}

// The bar with its middle line bent into an arc of `angle` (radians) in the xy plane.
inline Points bent(const Points& bar, double angle) {
    const double length = bar.col(0).maxCoeff(), radius = length / angle;
    Points result(bar.rows(), 3);
    for (Eigen::Index i = 0; i < bar.rows(); ++i) {
        const double phi = bar(i, 0) / radius, r = radius - bar(i, 1);
        result.row(i) << r * std::sin(phi), radius - r * std::cos(phi), bar(i, 2);
    }
    return result;
}

// The bar twisted about x by `angle` (radians) from end to end.
inline Points twisted(const Points& bar, double angle) {
    const double length = bar.col(0).maxCoeff();
    Points result(bar.rows(), 3);
    for (Eigen::Index i = 0; i < bar.rows(); ++i) {
        const double phi = angle * bar(i, 0) / length, c = std::cos(phi), s = std::sin(phi);
        result.row(i) << bar(i, 0), c * bar(i, 1) - s * bar(i, 2), s * bar(i, 1) + c * bar(i, 2);
    }
    return result;
}

inline Points turned(const Points& points, double angle, const Eigen::Vector3d& axis, const Point& shift = {0, 0, 0}) {
    const Eigen::Matrix3d r = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
    return (points * r.transpose()).rowwise() + shift;
}

// Every coordinate moved by up to `size` either way.
inline Points shaken(const Points& points, double size, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-size, size);
    Points result = points;
    for (Eigen::Index i = 0; i < result.size(); ++i) result.data()[i] += unit(random);
    return result;
}

// The greatest distance between corresponding points.
inline double distance(const Points& a, const Points& b) {
    return (a - b).rowwise().norm().maxCoeff();
}

// Lengths of all triangles' edges, each against the straight blend of the ends' at u: root mean square, relative.
inline double edge_error(const Triangles& triangles, const Points& from, const Points& to, const Points& between,
                         double u = 0.5) {
    double sum = 0;
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const int i = triangles(t, k), j = triangles(t, (k + 1) % 3);
            const double want = (1 - u) * (from.row(i) - from.row(j)).norm() + u * (to.row(i) - to.row(j)).norm();
            const double error = (between.row(i) - between.row(j)).norm() / want - 1;
            sum += error * error;
        }
    return std::sqrt(sum / static_cast<double>(3 * triangles.rows()));
}

} // namespace meshtween::test
