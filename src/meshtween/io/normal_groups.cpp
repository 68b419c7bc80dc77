#include "meshtween/io/normal_groups.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/seams.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace meshtween {
namespace {

constexpr double same_direction = 0.9998; // a degree: more than rounding to bytes, less than an edge
constexpr int most_compared = 1024;       // more than any real place has: a file made to take long does not

// For each vertex the number of its place, from 0; equal coordinates are one place.
std::vector<int> places(const Points& positions) {
    std::vector<int> order(static_cast<std::size_t>(positions.rows())), place(order.size());
    std::iota(order.begin(), order.end(), 0);
    const auto key = [&](int i) { return std::array{positions(i, 0), positions(i, 1), positions(i, 2)}; };
    std::sort(order.begin(), order.end(), [&](int a, int b) { return std::pair(key(a), a) < std::pair(key(b), b); });
    int next = -1;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || key(order[i]) != key(order[i - 1])) ++next;
        place[static_cast<std::size_t>(order[i])] = next;
    }
    return place;
}

NormalGroups group_of_each_vertex(const Mesh& mesh) {
    Weld one = seams(mesh);
    if (one.any()) return {std::move(one.triangles), std::move(one.first)};
    NormalGroups result{mesh.triangles, std::vector<int>(static_cast<std::size_t>(mesh.positions.rows()))};
    std::iota(result.vertices.begin(), result.vertices.end(), 0);
    return result;
}

} // namespace

NormalGroups normal_groups(const Points& positions, const Triangles& vertices, const Points& corner_normals) {
    const std::vector<int> place = places(positions);
    NormalGroups result;
    result.of.resize(vertices.rows(), 3);
    std::vector<int> last(place.size(), -1), before; // a place's last group, and the one before each
    std::vector<int> silent(place.size(), -1);       // a vertex's group of which the file says nothing
    std::vector<Point> direction;                    // of a group; nought: the file says nothing
    for (Eigen::Index t = 0; t < vertices.rows(); ++t)
        for (int c = 0; c < 3; ++c) {
            const int vertex = vertices(t, c);
            const Point normal = corner_normals.row(3 * t + c).stableNormalized();
            const bool is_silent = !(normal.squaredNorm() > 0.5);
            int& newest = is_silent ? silent[static_cast<std::size_t>(vertex)]
                                    : last[static_cast<std::size_t>(place[static_cast<std::size_t>(vertex)])];
            int found = newest;
            for (int tries = 1; found >= 0 && !is_silent; ++tries) {
                const auto g = static_cast<std::size_t>(found);
                if (direction[g].dot(normal) > same_direction) break;
                found = tries < most_compared ? before[g] : -1;
            }
            if (found < 0) {
                found = static_cast<int>(before.size());
                before.push_back(std::exchange(newest, found));
                direction.push_back(is_silent ? Point(0, 0, 0) : normal);
                result.vertices.push_back(vertex);
            }
            result.of(t, c) = found;
        }
    return result;
}

NormalGroups normal_groups(const Mesh& mesh) {
    const MeshFile* file = mesh.file.get();
    if (file == nullptr || file->normals.rows() == 0 || file->cut.rows() != mesh.triangles.rows())
        return group_of_each_vertex(mesh);
    Points normals = Points::Zero(mesh.triangles.size(), 3);
    for (Eigen::Index k = 0; k < normals.rows(); ++k) {
        const auto corner = static_cast<std::size_t>(file->cut.data()[k]);
        const int row = corner < file->normal_corners.size() ? file->normal_corners[corner] : -1;
        if (row >= 0 && row < file->normals.rows() && file->normals.row(row).allFinite())
            normals.row(k) = file->normals.row(row);
    }
    return normal_groups(mesh.positions, mesh.triangles, normals);
}

Points group_normals(const Points& positions, const NormalGroups& groups) {
    Points gathered(static_cast<Eigen::Index>(groups.vertices.size()), 3);
    parallel_for(gathered.rows(), [&](std::ptrdiff_t g) {
        gathered.row(g) = positions.row(groups.vertices[static_cast<std::size_t>(g)]);
    });
    Points normals = vertex_normals(gathered, groups.of);
    parallel_for(normals.rows(), [&](std::ptrdiff_t g) {
        if (normals.row(g).squaredNorm() < 0.25) normals.row(g) = Point(0, 1, 0); // validators refuse a zero
    });
    return normals;
}

} // namespace meshtween
