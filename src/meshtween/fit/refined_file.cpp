#include "meshtween/fit/refined_file.h"

#include <algorithm>
#include <array>

namespace meshtween {
namespace {

std::size_t idx(auto i) {
    return static_cast<std::size_t>(i);
}

PolygonNames named_alike(const PolygonNames& names, const std::vector<int>& from) {
    PolygonNames result{names.names, {}};
    for (const int p : from)
        if (!names.of.empty()) result.of.push_back(names.of[idx(p)]);
    return result;
}

} // namespace

std::vector<int> uncut_triangles(const Triangles& triangles, const Topology& topology, const std::vector<char>& cut) {
    std::vector<int> result;
    for (int t = 0; t < triangles.rows(); ++t) {
        int pieces = 1;
        for (int k = 0; k < 3; ++k) {
            const int a = triangles(t, k), b = triangles(t, (k + 1) % 3);
            const std::array<int, 2> ends{std::min(a, b), std::max(a, b)};
            const auto edge = std::lower_bound(topology.edges.begin(), topology.edges.end(), ends,
                                               [](const Edge& e, const auto& key) { return e.vertices < key; });
            pieces += cut[idx(edge - topology.edges.begin())] != 0 ? 1 : 0;
        }
        result.insert(result.end(), idx(pieces), t);
    }
    return result;
}

std::shared_ptr<const MeshFile> refined_file(const Mesh& source, const Mesh& finer, const std::vector<int>& uncut) {
    if (!is_described(source)) return nullptr;
    const MeshFile& coarse = *source.file;
    const std::vector<int> polygon = polygon_of_triangles(coarse);
    std::vector<std::vector<int>> pieces(coarse.ends.size()); // of each polygon: finer's triangles
    std::vector<int> whole(coarse.ends.size(), 0);            // of each polygon: its own triangles
    for (const int p : polygon) ++whole[idx(p)];
    for (std::size_t t = 0; t < uncut.size(); ++t) pieces[idx(polygon[idx(uncut[t])])].push_back(static_cast<int>(t));

    MeshFile file;
    file.vertices = finer.positions.rows();
    file.cut.resizeLike(finer.triangles);
    std::vector<int> from; // of each polygon: the coarse one
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        const auto first = static_cast<int>(file.corners.size());
        if (pieces[p].size() == idx(whole[p])) {
            const int begin = p == 0 ? 0 : coarse.ends[p - 1];
            file.corners.insert(file.corners.end(), coarse.corners.begin() + begin,
                                coarse.corners.begin() + coarse.ends[p]);
            for (const int t : pieces[p]) file.cut.row(t) = coarse.cut.row(uncut[idx(t)]).array() + (first - begin);
            file.ends.push_back(static_cast<int>(file.corners.size()));
            from.push_back(static_cast<int>(p));
            continue;
        }
        for (const int t : pieces[p]) {
            for (int k = 0; k < 3; ++k) {
                file.cut(t, k) = static_cast<int>(file.corners.size());
                file.corners.push_back(finer.triangles(t, k));
            }
            file.ends.push_back(static_cast<int>(file.corners.size()));
            from.push_back(static_cast<int>(p));
        }
    }
    file.objects = named_alike(coarse.objects, from);
    file.groups = named_alike(coarse.groups, from);
    file.smoothing = named_alike(coarse.smoothing, from);
    if (!coarse.polygon_materials.empty())
        for (const int p : from) file.polygon_materials.push_back(coarse.polygon_materials[idx(p)]);
    file.path = coarse.path;
    file.materials = coarse.materials;
    file.images = coarse.images;
    file.material_libraries = coarse.material_libraries;
    file.only_here = coarse.only_here;
    if (!coarse.more_texcoords.empty()) file.only_here.emplace_back("further sets of texture coordinates");
    if (coarse.normals.rows() > 0) file.only_here.emplace_back("normals");
    return std::make_shared<const MeshFile>(std::move(file));
}

} // namespace meshtween
