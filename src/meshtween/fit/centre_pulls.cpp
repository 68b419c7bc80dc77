// Vertices on a surface leave it open where the triangles between them lie. Where the target has edges, of a crease or
// of the facets that a scan or an artist's mesh consists of, that tells where along the surface the vertices belong.
#include "meshtween/fit/centre_pulls.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace meshtween {

void add_centre_pulls(const Shell& shell, const Points& positions, const FitTarget& target, double weight,
                      double least_cosine, double reach, RelaxMemory& memory, std::vector<SamplePull>& pulls) {
    const double area = surface_area(shell.rest, shell.triangles);
    const std::size_t before = pulls.size();
    pulls.resize(before + static_cast<std::size_t>(shell.triangles.rows()));
    memory.centre_places.resize(pulls.size() - before, -1);
    parallel_for(
        shell.triangles.rows(),
        [&](std::ptrdiff_t t) {
            const auto i = static_cast<std::size_t>(t);
            const SurfacePoint centre{static_cast<int>(t), Eigen::RowVector3d::Constant(1.0 / 3)};
            const auto f = shell.triangles.row(t);
            const Point a = positions.row(f[0]), b = positions.row(f[1]), c = positions.row(f[2]);
            const Point from = (a + b + c) / 3, facing = (b - a).cross(c - a).normalized();
            int& place = memory.centre_places[i];
            if (place < 0 && !memory.places.empty()) place = memory.places[static_cast<std::size_t>(f[0])];
            const ClosestPoint closest = target.index.closest(from, Compatible{facing, least_cosine}, reach, place);
            if (!closest.found() || on_border(target, closest.where)) return;
            place = closest.where.triangle;
            const Point normal = target.index.normals().row(place);
            double trust = 0;
            for (int k = 0; k < 3; ++k) trust += memory.trust[static_cast<std::size_t>(f[k])] / 3;
            pulls[before + i] = {centre, closest.position - from, normal,
                                 trust * weight * triangle_area(shell.rest, shell.triangles, t) / area *
                                     std::max(0.0, normal.dot(facing))};
        },
        256);
}

} // namespace meshtween
