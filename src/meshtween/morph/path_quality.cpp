#include "meshtween/morph/path_quality.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/morph/patches.h"
#include "meshtween/search/self_intersections.h"

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

// Which triangles of `shape` are turned over against `end`, seen from the triangles around them.
std::vector<char> turned_over(const Points& end, const Points& shape, const Triangles& triangles, const Lists& around) {
    const FaceField field = face_field(end, shape, triangles);
    std::vector<char> flags(static_cast<std::size_t>(triangles.rows()), 0);
    parallel_for(triangles.rows(), [&](Eigen::Index t) {
        if (field.area[t] <= 0) return;
        // The nearest rotation to a sum is that of the sum of squares in quaternions; here only a direction is needed.
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        for (int k = 0; k < 3; ++k)
            for (const int other : around[triangles(t, k)])
                if (other != t)
                    sum += field.area[other] * field.rotation[static_cast<std::size_t>(other)].toRotationMatrix();
        const Point before = double_area_normal(end, triangles, t), after = double_area_normal(shape, triangles, t);
        flags[static_cast<std::size_t>(t)] = after.dot((sum * before.transpose()).transpose()) < 0;
    });
    return flags;
}

void measure_edges(FrameQuality& frame, const std::vector<Edge>& edges, const Points& from, const Points& to,
                   const Points& shape) {
    double sum = 0;
    for (const Edge& edge : edges) {
        const auto [i, j] = edge.vertices;
        const double want =
            (1 - frame.u) * (from.row(i) - from.row(j)).norm() + frame.u * (to.row(i) - to.row(j)).norm();
        const double strain = want > 0 ? std::abs((shape.row(i) - shape.row(j)).norm() - want) / want : 0;
        sum += strain;
        frame.edge_strain_max = std::max(frame.edge_strain_max, strain);
    }
    frame.edge_strain_mean = edges.empty() ? 0 : sum / static_cast<double>(edges.size());
}

} // namespace

PathQuality path_quality(const Triangles& triangles, const std::function<Points(double u)>& at,
                         const PathQualityOptions& options, const Progress& progress) {
    if (options.frames < 2) throw Error(ErrorKind::argument, "the quality of a path needs at least 2 frames: its ends");
    const Points from = at(0), to = at(1);
    const Topology top = topology(from.rows(), triangles);
    const double volumes[2] = {volume(from, triangles), volume(to, triangles)};
    const double areas[2] = {surface_area(from, triangles), surface_area(to, triangles)};
    const auto ratio = [](double have, double want) { return want != 0 ? have / want : 1; };
    PathQuality result;
    for (int k = 0; k < options.frames; ++k) {
        FrameQuality frame;
        frame.u = static_cast<double>(k) / (options.frames - 1);
        if (!keep_going(progress, frame.u, "measuring the path")) {
            result.cancelled = true;
            break;
        }
        const Points shape = k == 0 ? from : k + 1 == options.frames ? to : at(frame.u);
        frame.volume = volume(shape, triangles);
        frame.area = surface_area(shape, triangles);
        frame.volume_ratio = ratio(frame.volume, (1 - frame.u) * volumes[0] + frame.u * volumes[1]);
        frame.area_ratio = ratio(frame.area, (1 - frame.u) * areas[0] + frame.u * areas[1]);
        measure_edges(frame, top.edges, from, to, shape);
        const std::vector<char> a = turned_over(from, shape, triangles, top.vertex_triangles);
        const std::vector<char> b = turned_over(to, shape, triangles, top.vertex_triangles);
        for (std::size_t t = 0; t < a.size(); ++t)
            if (a[t] && b[t]) frame.flipped.push_back(static_cast<int>(t));
        if (options.self_intersections) frame.self_intersections = self_intersections(shape, triangles);
        result.frames.push_back(std::move(frame));
    }
    return result;
}

} // namespace meshtween
