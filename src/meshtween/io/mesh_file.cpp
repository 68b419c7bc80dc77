#include "meshtween/io/mesh_file.h"

#include <algorithm>

namespace meshtween {

std::vector<int> polygon_of_triangles(const MeshFile& file) {
    std::vector<int> result;
    result.reserve(static_cast<std::size_t>(file.cut.rows()));
    for (Eigen::Index t = 0; t < file.cut.rows(); ++t) {
        const auto end = std::upper_bound(file.ends.begin(), file.ends.end(), file.cut(t, 0));
        result.push_back(static_cast<int>(end - file.ends.begin()));
    }
    return result;
}

} // namespace meshtween
