#include "meshtween/geometry/shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace meshtween {
namespace {

Mesh icosahedron() {
    const double g = std::numbers::phi;
    Mesh mesh;
    mesh.positions.resize(12, 3);
    mesh.positions << -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, 0, 0, -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, g, 0, -1, g, 0, 1,
        -g, 0, -1, -g, 0, 1;
    mesh.positions.rowwise().normalize();
    mesh.triangles.resize(20, 3);
    mesh.triangles << 0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4, 11, 10, 2, 10, 7, 6, 7, 1, 8,
        3, 9, 4, 3, 4, 2, 3, 2, 6, 3, 6, 8, 3, 8, 9, 4, 9, 5, 2, 4, 11, 6, 2, 10, 8, 6, 7, 9, 8, 1;
    return mesh;
}

Mesh quartered_on_sphere(const Mesh& mesh) {
    std::map<std::pair<int, int>, int> middles;
    std::vector<Point> points;
    const int first = static_cast<int>(mesh.positions.rows());
    const auto middle = [&](int a, int b) {
        const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), first + static_cast<int>(points.size()));
        if (is_new) points.push_back((mesh.positions.row(a) + mesh.positions.row(b)).normalized());
        return at->second;
    };
    Mesh finer;
    finer.triangles.resize(mesh.triangles.rows() * 4, 3);
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
        const int a = mesh.triangles(t, 0), b = mesh.triangles(t, 1), c = mesh.triangles(t, 2);
        const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        finer.triangles.middleRows(4 * t, 4) << a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca;
    }
    finer.positions.resize(first + static_cast<int>(points.size()), 3);
    finer.positions.topRows(first) = mesh.positions;
    for (std::size_t i = 0; i < points.size(); ++i) finer.positions.row(first + static_cast<int>(i)) = points[i];
    return finer;
}

} // namespace

Mesh sphere(int subdivisions) {
    Mesh mesh = icosahedron();
    for (int i = 0; i < subdivisions; ++i) mesh = quartered_on_sphere(mesh);
    return mesh;
}

Mesh bar(const Point& size, const std::array<int, 3>& cells, double rounding) {
    // Only the lattice points on the box's surface become vertices, numbered in the order in which faces meet them.
    std::map<std::array<int, 3>, int> numbers;
    std::vector<std::array<int, 3>> triangles;
    const auto number = [&](const std::array<int, 3>& at) {
        return numbers.try_emplace(at, static_cast<int>(numbers.size())).first->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int end : {0, cells[axis]}) {
            const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
            for (int i = 0; i < cells[u]; ++i)
                for (int j = 0; j < cells[v]; ++j) {
                    const auto corner = [&](int di, int dj) {
                        std::array<int, 3> at{};
                        at[axis] = end, at[u] = i + di, at[v] = j + dj;
                        return number(at);
                    };
                    int a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
                    if (end == 0) std::swap(b, d);
                    // Diagonals alternate, so that the mesh prefers no side when it is bent.
                    if ((i + j) % 2 == 0)
                        triangles.push_back({a, b, c}), triangles.push_back({a, c, d});
                    else
                        triangles.push_back({a, b, d}), triangles.push_back({b, c, d});
                }
        }
    Mesh mesh;
    mesh.positions.resize(static_cast<Eigen::Index>(numbers.size()), 3);
    const double r = std::min(rounding, size.minCoeff() / 2);
    const Point low = Point(0, -size[1] / 2, -size[2] / 2), high = low + size;
    for (const auto& [at, i] : numbers) {
        Point p;
        for (int k = 0; k < 3; ++k) {
            const std::size_t axis = static_cast<std::size_t>(k);
            p[k] = low[k] + size[k] * at[axis] / cells[axis];
        }
        const Point core = p.cwiseMax((low.array() + r).matrix()).cwiseMin((high.array() - r).matrix());
        mesh.positions.row(i) = r > 0 ? Point(core + r * (p - core).normalized()) : p;
    }
    mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        mesh.triangles.row(static_cast<Eigen::Index>(t)) << triangles[t][0], triangles[t][1], triangles[t][2];
    return mesh;
}

Mesh torus(double radius, double tube, int around, int across) {
    Mesh mesh;
    mesh.positions.resize(around * across, 3);
    mesh.triangles.resize(2 * around * across, 3);
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
            const double reach = radius + tube * std::cos(v);
            const int a = i * across + j, b = (i + 1) % around * across + j;
            const int c = (i + 1) % around * across + (j + 1) % across, d = i * across + (j + 1) % across;
            mesh.positions.row(a) << reach * std::sin(u), tube * std::sin(v), reach * std::cos(u);
            mesh.triangles.row(2 * a) << a, b, c;
            mesh.triangles.row(2 * a + 1) << a, c, d;
        }
    return mesh;
}

Points bend(const Points& points, double length, double angle) {
    if (angle == 0) return points;
    Points bent(points.rows(), 3);
    const double radius = length / angle; // the arc's centre is (0, radius)
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const double s = std::clamp(points(i, 0), 0.0, length), beyond = points(i, 0) - s;
        const double phi = angle * s / length, reach = radius - points(i, 1);
        bent.row(i) << reach * std::sin(phi) + beyond * std::cos(phi),
            radius - reach * std::cos(phi) + beyond * std::sin(phi), points(i, 2);
    }
    return bent;
}

Points twist(const Points& points, double length, double angle) {
    Points twisted(points.rows(), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const double phi = angle * std::clamp(points(i, 0) / length, 0.0, 1.0);
        const double y = points(i, 1), z = points(i, 2);
        twisted.row(i) << points(i, 0), std::cos(phi) * y - std::sin(phi) * z, std::sin(phi) * y + std::cos(phi) * z;
    }
    return twisted;
}

Points turn(const Points& points, const Point& axis, double angle) {
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(angle, Eigen::Vector3d(axis.transpose().normalized())).toRotationMatrix();
    return points * rotation.transpose();
}

} // namespace meshtween
