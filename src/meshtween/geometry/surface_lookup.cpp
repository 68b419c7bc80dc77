#include "meshtween/geometry/surface_lookup.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/place_on_triangle.h"

#include <algorithm>
#include <limits>
#include <tuple>

namespace meshtween {
namespace {

constexpr long wide = 1L << 20; // cells along an axis, more than any sample needs

} // namespace

// A cell is as wide as the reach.
SurfaceLookup::SurfaceLookup(const Mesh& mesh, double reach)
    : mesh_(mesh), reach_(reach), low_(mesh.positions.colwise().minCoeff().array() - 2 * reach) {
    for (int t = 0; t < mesh.triangles.rows(); ++t) {
        Eigen::Matrix3d corners;
        for (int k = 0; k < 3; ++k) corners.row(k) = (mesh.positions.row(mesh.triangles(t, k)) - low_) / reach;
        const Eigen::RowVector3i from = corners.colwise().minCoeff().cast<int>(),
                                 to = corners.colwise().maxCoeff().cast<int>();
        for (int k = from[2]; k <= to[2]; ++k)
            for (int j = from[1]; j <= to[1]; ++j)
                for (int i = from[0]; i <= to[0]; ++i) entries_.push_back({(k * wide + j) * wide + i, t});
    }
    std::sort(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
        return std::tie(a.cell, a.triangle) < std::tie(b.cell, b.triangle);
    });
}

long SurfaceLookup::cell(const Point& p, int i, int j, int k) const {
    const Eigen::RowVector3i at = ((p - low_) / reach_).array().floor().matrix().cast<int>();
    return ((at[2] + k) * wide + at[1] + j) * wide + at[0] + i;
}

Point SurfaceLookup::closest(const Point& p) const {
    Point best = p;
    double least = reach_ * reach_;
    for (int k = -1; k <= 1; ++k)
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                const long here = cell(p, i, j, k);
                auto entry = std::lower_bound(entries_.begin(), entries_.end(), here,
                                              [](const Entry& e, long c) { return e.cell < c; });
                for (; entry != entries_.end() && entry->cell == here; ++entry) {
                    const auto corners = mesh_.triangles.row(entry->triangle);
                    const auto there =
                        place_on_triangle(p, mesh_.positions.row(corners[0]), mesh_.positions.row(corners[1]),
                                          mesh_.positions.row(corners[2]));
                    if (there.squared_distance >= least) continue;
                    least = there.squared_distance;
                    best = position(mesh_.positions, mesh_.triangles,
                                    {entry->triangle, {1 - there.v - there.w, there.v, there.w}});
                }
            }
    return best;
}

Points SurfaceLookup::closest(const Points& points) const {
    Points result(points.rows(), 3);
    parallel_for(
        points.rows(), [&](Eigen::Index i) { result.row(i) = closest(Point(points.row(i))); }, 64);
    return result;
}

} // namespace meshtween
