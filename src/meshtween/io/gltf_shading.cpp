#include "meshtween/io/gltf_shading.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/normal_groups.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace meshtween {
namespace {

using Eigen::Matrix3d;

// A triangle's two edges and its normal.
Matrix3d frame(const Points& positions, const Triangles& triangles, Eigen::Index t) {
    const Point a = positions.row(triangles(t, 0)), b = positions.row(triangles(t, 1)),
                c = positions.row(triangles(t, 2));
    const Point normal = (b - a).cross(c - a);
    Matrix3d result;
    result << (b - a).transpose(), (c - a).transpose(), normal.transpose() / std::sqrt(std::max(normal.norm(), 1e-300));
    return result;
}

} // namespace

GltfShading gltf_shading(const Mesh& mesh, const std::vector<int>& vertices, const std::vector<double>& before) {
    GltfShading result;
    const MeshFile& file = *mesh.file;
    if (file.normals.rows() == 0) return result;
    const auto count = static_cast<Eigen::Index>(before.size() / 3);
    Points old(mesh.positions.rows(), 3);
    for (Eigen::Index i = 0; i < count; ++i)
        old.row(vertices.empty() ? i : vertices[static_cast<std::size_t>(i)]) =
            Eigen::Map<const Point>(before.data() + 3 * i);
    Mesh as_read = mesh;
    as_read.positions = old; // places tell what is smooth: those of the file, not those of the new shape
    const NormalGroups groups = normal_groups(as_read);
    const Points normals = group_normals(mesh.positions, groups);
    result.normals = file.normals;
    result.changes.assign(static_cast<std::size_t>(count), Matrix3d::Zero());
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
        Matrix3d change = frame(mesh.positions, mesh.triangles, t) * frame(old, mesh.triangles, t).inverse();
        if (!change.allFinite()) change.setZero();
        for (int c = 0; c < 3; ++c) {
            const int vertex = file.normal_corners[static_cast<std::size_t>(file.cut(t, c))];
            if (vertex < 0) continue;
            result.normals.row(vertex) = normals.row(groups.of(t, c));
            result.changes[static_cast<std::size_t>(vertex)] += change;
        }
    }
    return result;
}

} // namespace meshtween
