#include "meshtween/morph/path_quality.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/io/seams.h"
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

// The shapes on both sides of a frame, keys of the path.
struct Ends {
    Points from, to;
    double volumes[2], areas[2];

    Ends(Points first, Points last, const Triangles& triangles)
        : from(std::move(first)), to(std::move(last)), volumes{volume(from, triangles), volume(to, triangles)},
          areas{surface_area(from, triangles), surface_area(to, triangles)} {}
};

// `s` is where between the ends, 0..1.
void measure_edges(FrameQuality& frame, const std::vector<Edge>& edges, const Ends& ends, const Points& shape,
                   double s) {
    double sum = 0;
    for (const Edge& edge : edges) {
        const auto [i, j] = edge.vertices;
        const double want =
            (1 - s) * (ends.from.row(i) - ends.from.row(j)).norm() + s * (ends.to.row(i) - ends.to.row(j)).norm();
        const double strain = want > 0 ? std::abs((shape.row(i) - shape.row(j)).norm() - want) / want : 0;
        sum += strain;
        frame.edge_strain_max = std::max(frame.edge_strain_max, strain);
    }
    frame.edge_strain_mean = edges.empty() ? 0 : sum / static_cast<double>(edges.size());
}

FrameQuality measured(const Points& shape, const Ends& ends, const Triangles& triangles, const Topology& top, double s,
                      bool cuts) {
    const auto ratio = [&](double have, const double(&want)[2]) {
        const double line = (1 - s) * want[0] + s * want[1];
        return line != 0 ? have / line : 1;
    };
    FrameQuality frame;
    frame.volume = volume(shape, triangles);
    frame.area = surface_area(shape, triangles);
    frame.volume_ratio = ratio(frame.volume, ends.volumes);
    frame.area_ratio = ratio(frame.area, ends.areas);
    measure_edges(frame, top.edges, ends, shape, s);
    const std::vector<char> a = turned_over(ends.from, shape, triangles, top.vertex_triangles);
    const std::vector<char> b = turned_over(ends.to, shape, triangles, top.vertex_triangles);
    for (std::size_t t = 0; t < a.size(); ++t)
        if (a[t] && b[t]) frame.flipped.push_back(static_cast<int>(t));
    if (cuts) frame.self_intersections = self_intersections(shape, triangles);
    return frame;
}

} // namespace

PathQuality path_quality(const Triangles& triangles, const std::function<Points(double u)>& at,
                         const PathQualityOptions& options, const Progress& progress) {
    if (options.frames < 2) throw Error(ErrorKind::argument, "the quality of a path needs at least 2 frames: its ends");
    if (options.keys.size() < 2) throw Error(ErrorKind::argument, "the quality of a path needs at least 2 keys");
    const std::size_t pieces = options.keys.size() - 1;
    const Topology top = topology(at(options.keys.front()).rows(), triangles);
    PathQuality result;
    for (std::size_t p = 0; p < pieces; ++p) {
        const Ends ends(at(options.keys[p]), at(options.keys[p + 1]), triangles);
        for (int k = p == 0 ? 0 : 1; k < options.frames; ++k) {
            const double s = static_cast<double>(k) / (options.frames - 1);
            if (!keep_going(progress, (static_cast<double>(p) + s) / static_cast<double>(pieces),
                            "measuring the path")) {
                result.cancelled = true;
                return result;
            }
            const double u = options.keys[p] + s * (options.keys[p + 1] - options.keys[p]);
            const Points shape = k == 0 ? ends.from : k + 1 == options.frames ? ends.to : at(u);
            result.frames.push_back(measured(shape, ends, triangles, top, s, options.self_intersections));
            result.frames.back().u = u;
        }
    }
    return result;
}

PathQuality path_quality(const Mesh& mesh, const std::function<Points(double u)>& at, const PathQualityOptions& options,
                         const Progress& progress) {
    if (!options.weld) return path_quality(mesh.triangles, at, options, progress);
    std::vector<Points> shapes;
    std::vector<const Points*> all;
    for (const double u : options.keys) shapes.push_back(at(u));
    for (const Points& shape : shapes) all.push_back(&shape);
    const Weld found = seams(mesh, all);
    return path_quality(found.any() ? found.by_first() : mesh.triangles, at, options, progress);
}

} // namespace meshtween
