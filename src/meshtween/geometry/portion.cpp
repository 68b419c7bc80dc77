#include "meshtween/geometry/portion.h"

namespace meshtween {

Portion portion(const Points& positions, const Triangles& triangles, const std::vector<int>& chosen) {
    Portion part;
    part.triangle = chosen;
    part.of_vertex.assign(static_cast<std::size_t>(positions.rows()), -1);
    part.triangles = triangles(chosen, Eigen::all);
    for (const int v : part.triangles.reshaped()) part.of_vertex[static_cast<std::size_t>(v)] = 0;
    for (std::size_t v = 0; v < part.of_vertex.size(); ++v) {
        if (part.of_vertex[v] < 0) continue;
        part.of_vertex[v] = static_cast<int>(part.vertex.size());
        part.vertex.push_back(static_cast<int>(v));
    }
    for (int& v : part.triangles.reshaped()) v = part.of_vertex[static_cast<std::size_t>(v)];
    part.positions = rows_of(part, positions);
    return part;
}

Points rows_of(const Portion& part, const Points& x) {
    return x(part.vertex, Eigen::all);
}

void put_rows(const Portion& part, const Points& rows, Points& x) {
    x(part.vertex, Eigen::all) = rows;
}

} // namespace meshtween
