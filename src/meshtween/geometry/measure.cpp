#include "meshtween/geometry/measure.h"

#include "meshtween/core/parallel.h"

#include <Eigen/Geometry>

#include <cmath>

namespace meshtween {

Eigen::AlignedBox3d bounding_box(const Points& positions, const Triangles& triangles) {
    Eigen::AlignedBox3d box;
    for (const int v : triangles.reshaped()) box.extend(positions.row(v).transpose());
    if (triangles.size() == 0)
        for (const auto& point : positions.rowwise()) box.extend(point.transpose());
    return box;
}

double diagonal(const Points& positions, const Triangles& triangles) {
    const Eigen::AlignedBox3d box = bounding_box(positions, triangles);
    return box.isEmpty() ? 0 : box.diagonal().norm();
}

double diagonal(const Points& positions) {
    return diagonal(positions, Triangles(0, 3));
}

double triangle_area(const Points& positions, const Triangles& triangles, Eigen::Index t) {
    return double_area_normal(positions, triangles, t).norm() / 2;
}

double surface_area(const Points& positions, const Triangles& triangles) {
    return parallel_sum(triangles.rows(), 0.0, [&](Eigen::Index t) { return triangle_area(positions, triangles, t); });
}

double volume(const Points& positions, const Triangles& triangles) {
    if (positions.rows() == 0) return 0;
    const Point origin = positions.row(0);
    return parallel_sum(triangles.rows(), 0.0,
                        [&](Eigen::Index t) {
                            const Point a = positions.row(triangles(t, 0)) - origin,
                                        b = positions.row(triangles(t, 1)) - origin,
                                        c = positions.row(triangles(t, 2)) - origin;
                            return a.dot(b.cross(c));
                        }) /
           6;
}

Points triangle_normals(const Points& positions, const Triangles& triangles) {
    Points normals(triangles.rows(), 3);
    parallel_for(triangles.rows(), [&](Eigen::Index t) {
        const Point n = double_area_normal(positions, triangles, t);
        const double length = n.norm();
        if (length > 0)
            normals.row(t) = n / length;
        else
            normals.row(t).setZero();
    });
    return normals;
}

Points vertex_normals(const Points& positions, const Triangles& triangles) {
    Points faces(triangles.rows(), 3), angles(triangles.rows(), 3);
    parallel_for(triangles.rows(), [&](Eigen::Index t) {
        const Point a = positions.row(triangles(t, 0)), b = positions.row(triangles(t, 1)),
                    c = positions.row(triangles(t, 2)), normal = (b - a).cross(c - a);
        const double length = normal.norm();
        const double at_a = std::atan2(length, (b - a).dot(c - a)), at_b = std::atan2(length, (c - b).dot(a - b));
        angles.row(t) << at_a, at_b, EIGEN_PI - at_a - at_b;
        faces.row(t) = length > 0 ? Point(normal / length) : Point(0, 0, 0);
    });
    Points normals = Points::Zero(positions.rows(), 3);
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) normals.row(triangles(t, k)) += angles(t, k) * faces.row(t);
    parallel_for(normals.rows(), [&](Eigen::Index i) {
        const double length = normals.row(i).norm();
        if (length > 0) normals.row(i) /= length;
    });
    return normals;
}

} // namespace meshtween
