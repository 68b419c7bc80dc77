#include "meshtween/io/gltf_split.h"

#include "meshtween/io/mesh_file.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace meshtween {
namespace {

constexpr int most_compared = 1024; // more than any real vertex has: a file made to take long does not

// Vertices that have one of each attribute; all materials together.
struct Split {
    std::vector<int> vertices, corners;
    Triangles triangles;
};

Split split_vertices(const Mesh& mesh, const std::vector<CornerTexcoords>& texcoords, const NormalGroups& groups) {
    Split result{std::vector<int>(static_cast<std::size_t>(mesh.positions.rows())), {}, mesh.triangles};
    std::iota(result.vertices.begin(), result.vertices.end(), 0);
    result.corners.assign(result.vertices.size(), -1);
    // A vertex's last copy, and the one before each.
    std::vector<int> last = result.vertices, before(result.vertices.size(), -1);
    const auto alike = [&](int a, int b) {
        if (groups.of.data()[a] != groups.of.data()[b]) return false;
        return std::all_of(texcoords.begin(), texcoords.end(), [&](const CornerTexcoords& set) {
            const int x = set.corners.data()[a], y = set.corners.data()[b];
            return x == y || (x >= 0 && y >= 0 && set.texcoords.row(x) == set.texcoords.row(y));
        });
    };
    for (int k = 0; k < static_cast<int>(mesh.triangles.size()); ++k) {
        const int vertex = mesh.triangles.data()[k];
        int& newest = last[static_cast<std::size_t>(vertex)];
        int found = newest;
        for (int tries = 1; found >= 0; ++tries) {
            const int corner = result.corners[static_cast<std::size_t>(found)];
            if (corner < 0 || alike(corner, k)) break;
            found = tries < most_compared ? before[static_cast<std::size_t>(found)] : -1;
        }
        if (found < 0) {
            found = static_cast<int>(result.vertices.size());
            before.push_back(std::exchange(newest, found));
            result.vertices.push_back(vertex);
            result.corners.push_back(-1);
        }
        if (result.corners[static_cast<std::size_t>(found)] < 0) result.corners[static_cast<std::size_t>(found)] = k;
        result.triangles.data()[k] = found;
    }
    return result;
}

// The part of one material. `own` is a scratch of -1s, one a vertex of the split, and is so again afterwards.
GltfPrimitive part_of_material(const Split& split, int material, const std::vector<int>& triangles,
                               const std::vector<int>& spare, std::vector<int>& own) {
    GltfPrimitive part;
    part.material = material;
    std::vector<int> used = spare;
    for (const int t : triangles)
        for (int c = 0; c < 3; ++c)
            if (std::exchange(own[static_cast<std::size_t>(split.triangles(t, c))], 0) < 0)
                used.push_back(split.triangles(t, c));
    std::sort(used.begin(), used.end());
    for (std::size_t i = 0; i < used.size(); ++i) {
        const auto s = static_cast<std::size_t>(used[i]);
        own[s] = static_cast<int>(i);
        part.vertices.push_back(split.vertices[s]);
        part.corners.push_back(split.corners[s]);
    }
    part.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const int t = triangles[i];
        for (int c = 0; c < 3; ++c)
            part.triangles(static_cast<Eigen::Index>(i), c) = own[static_cast<std::size_t>(split.triangles(t, c))];
        if (!part.runs.empty() && part.runs.back().first + part.runs.back().second == t)
            ++part.runs.back().second;
        else
            part.runs.emplace_back(t, 1);
    }
    for (const int s : used) own[static_cast<std::size_t>(s)] = -1;
    return part;
}

} // namespace

std::vector<CornerTexcoords> corner_texcoords(const Mesh& mesh) {
    std::vector<CornerTexcoords> result;
    if (mesh.texcoords.rows() == 0) return result;
    result.push_back({mesh.texcoords, mesh.texcoord_triangles});
    const MeshFile* file = mesh.file.get();
    if (file == nullptr || file->cut.rows() != mesh.triangles.rows()) return result;
    for (const TexcoordSet& set : file->more_texcoords)
        result.push_back({set.texcoords, file->cut.unaryExpr([&](int corner) {
                              const int row = set.corners[static_cast<std::size_t>(corner)];
                              return row < set.texcoords.rows() ? row : -1;
                          })});
    return result;
}

GltfParts split_parts(const Mesh& mesh, const std::vector<CornerTexcoords>& texcoords, const NormalGroups& groups,
                      const std::vector<int>& materials) {
    Split split = split_vertices(mesh, texcoords, groups);
    std::map<int, std::vector<int>> of_material;
    for (int t = 0; t < static_cast<int>(mesh.triangles.rows()); ++t)
        of_material[materials.empty() ? -1 : materials[static_cast<std::size_t>(t)]].push_back(t);
    GltfParts result;
    result.renumbered =
        split.vertices.size() > static_cast<std::size_t>(mesh.positions.rows()) || of_material.size() > 1;
    if (of_material.size() == 1) {
        result.primitives.push_back({of_material.begin()->first,
                                     std::move(split.vertices),
                                     std::move(split.corners),
                                     std::move(split.triangles),
                                     {{0, static_cast<int>(mesh.triangles.rows())}}});
        return result;
    }
    std::vector<int> spare; // vertices of no triangle go to the first part, so that none is lost
    for (std::size_t s = 0; s < split.corners.size(); ++s)
        if (split.corners[s] < 0) spare.push_back(static_cast<int>(s));
    std::vector<int> own(split.vertices.size(), -1);
    for (const auto& [material, triangles] : of_material) {
        result.primitives.push_back(part_of_material(split, material, triangles, spare, own));
        spare.clear();
    }
    return result;
}

} // namespace meshtween
