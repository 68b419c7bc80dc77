#include "meshtween/geometry/genus.h"

#include "meshtween/geometry/sound_faces.h"
#include "meshtween/geometry/topology.h"

#include <algorithm>
#include <numeric>

namespace meshtween {

std::optional<long> handles(const Points& positions, const Triangles& triangles) {
    if (triangles.rows() == 0) return std::nullopt;
    const Topology top = topology(positions.rows(), triangles);
    if (std::ranges::any_of(top.edges, [](const Edge& edge) { return edge.count > 2; })) return std::nullopt;
    std::vector<int> all(static_cast<std::size_t>(triangles.rows()));
    std::iota(all.begin(), all.end(), 0);
    const std::vector<int> part = parts_of(positions.rows(), triangles, all);
    const long parts = *std::max_element(part.begin(), part.end()) + 1;
    long used = 0;
    for (std::ptrdiff_t v = 0; v < positions.rows(); ++v) used += top.vertex_triangles[v].empty() ? 0 : 1;
    const auto boundaries = static_cast<long>(boundary_loops(triangles, top).size());
    const long euler = used - static_cast<long>(top.edges.size()) + static_cast<long>(triangles.rows());
    const long twice = 2 * parts - boundaries - euler;
    if (twice < 0 || twice % 2 != 0) return std::nullopt;
    return twice / 2;
}

} // namespace meshtween
