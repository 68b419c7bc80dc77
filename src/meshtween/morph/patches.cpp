// Gonzalez, Clustering to Minimize the Maximum Intercluster Distance, 1985 (farthest points); the polar part of a
// triangle's map in closed form, from its two-dimensional map between the triangles' own planes.
#include "meshtween/morph/patches.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <tuple>

namespace meshtween {
namespace {

// Axes of a triangle's plane and its normal as columns, and its edges in them.
struct Frame {
    Eigen::Matrix3d axes;
    double x1 = 0, x2 = 0, y2 = 0; // edge 0-1 is (x1, 0), edge 0-2 is (x2, y2)
    bool sound = false;
};

Frame frame_of(const Points& p, const Triangles& triangles, Eigen::Index t) {
    const Eigen::Vector3d e1 = p.row(triangles(t, 1)) - p.row(triangles(t, 0));
    const Eigen::Vector3d e2 = p.row(triangles(t, 2)) - p.row(triangles(t, 0));
    const Eigen::Vector3d normal = e1.cross(e2);
    Frame frame;
    frame.x1 = e1.norm();
    const double twice = normal.norm();
    const double longest = std::max({e1.squaredNorm(), e2.squaredNorm(), (e2 - e1).squaredNorm()});
    frame.sound = twice > 1e-9 * longest && longest > 0;
    if (!frame.sound) return frame;
    frame.axes.col(0) = e1 / frame.x1;
    frame.axes.col(2) = normal / twice;
    frame.axes.col(1) = frame.axes.col(2).cross(frame.axes.col(0));
    frame.x2 = e2.dot(frame.axes.col(0));
    frame.y2 = e2.dot(frame.axes.col(1));
    return frame;
}

Eigen::Quaterniond rotation_between(const Frame& a, const Frame& b) {
    const double j00 = b.x1 / a.x1, j01 = (b.x2 - j00 * a.x2) / a.y2, j11 = b.y2 / a.y2; // the map is [j00 j01; 0 j11]
    const double angle = std::atan2(-j01, j00 + j11);
    const Eigen::Matrix3d in_plane = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    return Eigen::Quaterniond(Eigen::Matrix3d(b.axes * in_plane * a.axes.transpose()));
}

// A graph of small groups of neighbouring triangles: farthest points are sought there, not among millions.
struct Groups {
    std::vector<int> of_triangle;
    FaceField mean; // a row a group
    struct Side {
        int to = 0;
        double length = 0; // the distance of patches()
        double border = 0;
    };
    std::vector<std::vector<Side>> sides;
};

// Every `step`-th triangle starts a group, which grows breadth first; what none of them reaches starts its own.
std::vector<int> grown_groups(Eigen::Index triangle_count, const Lists& adjacent, int step, int& count) {
    std::vector<int> group(static_cast<std::size_t>(triangle_count), -1);
    std::vector<int> queue;
    queue.reserve(group.size());
    count = 0;
    const auto grow = [&](std::size_t head) {
        for (; head < queue.size(); ++head)
            for (const int g : adjacent[queue[head]])
                if (group[static_cast<std::size_t>(g)] < 0) {
                    group[static_cast<std::size_t>(g)] = group[static_cast<std::size_t>(queue[head])];
                    queue.push_back(g);
                }
    };
    const auto start = [&](int t) {
        group[static_cast<std::size_t>(t)] = count++;
        queue.push_back(t);
    };
    for (int t = 0; t < triangle_count; t += step) start(t);
    grow(0);
    for (int t = 0; t < triangle_count; ++t)
        if (group[static_cast<std::size_t>(t)] < 0) {
            start(t);
            grow(queue.size() - 1);
        }
    return group;
}

Lists adjacent_triangles(Eigen::Index triangle_count, const Topology& topology) {
    Lists lists;
    lists.first.assign(static_cast<std::size_t>(triangle_count) + 1, 0);
    for (const Edge& edge : topology.edges)
        if (edge.triangles[1] >= 0)
            for (const int t : edge.triangles) ++lists.first[static_cast<std::size_t>(t) + 1];
    for (std::size_t t = 0; t < static_cast<std::size_t>(triangle_count); ++t) lists.first[t + 1] += lists.first[t];
    lists.items.resize(static_cast<std::size_t>(lists.first.back()));
    std::vector<int> next = lists.first;
    for (const Edge& edge : topology.edges)
        if (edge.triangles[1] >= 0)
            for (std::size_t k = 0; k < 2; ++k)
                lists.items[static_cast<std::size_t>(next[static_cast<std::size_t>(edge.triangles[k])]++)] =
                    edge.triangles[1 - k];
    return lists;
}

// Centres, areas and mean rotations of numbered groups. The mean of unit quaternions, each on its group's first one's
// side (Gramkow, On Averaging Rotations, 2001), which is good where they differ by less than about 90 degrees.
FaceField means(const FaceField& faces, const std::vector<int>& group, int count) {
    FaceField mean;
    mean.centre_from = mean.centre_to = Points::Zero(count, 3);
    mean.area = Eigen::VectorXd::Zero(count);
    std::vector<Eigen::Vector4d> sum(static_cast<std::size_t>(count), Eigen::Vector4d::Zero());
    Eigen::VectorXd members = Eigen::VectorXd::Zero(count);
    for (Eigen::Index t = 0; t < faces.area.size(); ++t) {
        const int g = group[static_cast<std::size_t>(t)];
        mean.area[g] += faces.area[t];
        members[g] += 1;
        mean.centre_from.row(g) += faces.centre_from.row(t);
        mean.centre_to.row(g) += faces.centre_to.row(t);
        const Eigen::Vector4d q = faces.rotation[static_cast<std::size_t>(t)].coeffs();
        Eigen::Vector4d& s = sum[static_cast<std::size_t>(g)];
        s += faces.area[t] * (s.dot(q) < 0 ? -q : q);
    }
    for (int g = 0; g < count; ++g) {
        mean.centre_from.row(g) /= members[g];
        mean.centre_to.row(g) /= members[g];
        const Eigen::Vector4d& s = sum[static_cast<std::size_t>(g)];
        mean.rotation.push_back(s.norm() > 0 ? Eigen::Quaterniond(Eigen::Vector4d(s.normalized()))
                                             : Eigen::Quaterniond::Identity());
    }
    return mean;
}

double angle_between(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
    return 2 * std::acos(std::min(1.0, std::abs(a.dot(b))));
}

Groups groups(const FaceField& faces, const Topology& topology, int most) {
    Groups result;
    const Eigen::Index m = faces.area.size();
    int count = 0;
    const int step = std::max(1, static_cast<int>((m + most - 1) / most));
    result.of_triangle = grown_groups(m, adjacent_triangles(m, topology), step, count);
    result.mean = means(faces, result.of_triangle, count);
    const double unit = std::sqrt(std::max(1e-300, faces.area.sum()));
    std::vector<std::array<int, 2>> pairs;
    for (const Edge& edge : topology.edges) {
        if (edge.triangles[1] < 0) continue;
        const int a = result.of_triangle[static_cast<std::size_t>(edge.triangles[0])];
        const int b = result.of_triangle[static_cast<std::size_t>(edge.triangles[1])];
        if (a != b) pairs.push_back({std::min(a, b), std::max(a, b)});
    }
    std::sort(pairs.begin(), pairs.end());
    result.sides.resize(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < pairs.size();) {
        std::size_t end = i;
        while (end < pairs.size() && pairs[end] == pairs[i]) ++end;
        const auto [a, b] = pairs[i];
        const double way = ((result.mean.centre_from.row(a) - result.mean.centre_from.row(b)).norm() +
                            (result.mean.centre_to.row(a) - result.mean.centre_to.row(b)).norm()) /
                           2;
        const auto ia = static_cast<std::size_t>(a), ib = static_cast<std::size_t>(b);
        const double turn = angle_between(result.mean.rotation[ia], result.mean.rotation[ib]);
        constexpr double way_of_a_radian = 0.15; // parts of the root of the area
        const double length = way / unit + way_of_a_radian * turn;
        const double border = static_cast<double>(end - i) * std::sqrt(result.mean.area[a] + result.mean.area[b]);
        result.sides[ia].push_back({b, length, border});
        result.sides[ib].push_back({a, length, border});
        i = end;
    }
    return result;
}

// The patch of every group, by farthest points with Dijkstra's distances.
std::vector<int> farthest_point_patches(const Groups& graph, int wanted, int& count) {
    const std::size_t n = graph.sides.size();
    std::vector<double> distance(n, std::numeric_limits<double>::infinity());
    std::vector<int> patch(n, -1);
    count = 0;
    const auto spread = [&](std::size_t seed) {
        std::priority_queue<std::pair<double, std::size_t>, std::vector<std::pair<double, std::size_t>>, std::greater<>>
            queue;
        distance[seed] = 0;
        patch[seed] = count;
        queue.emplace(0, seed);
        while (!queue.empty()) {
            const auto [d, g] = queue.top();
            queue.pop();
            if (d > distance[g]) continue;
            for (const auto& side : graph.sides[g]) {
                const auto to = static_cast<std::size_t>(side.to);
                if (d + side.length >= distance[to]) continue;
                distance[to] = d + side.length;
                patch[to] = count;
                queue.emplace(distance[to], to);
            }
        }
        ++count;
    };
    for (std::size_t g = 0; g < n; ++g) // the first of each component
        if (patch[g] < 0) spread(g);
    while (count < wanted) {
        const auto farthest = std::max_element(distance.begin(), distance.end());
        if (farthest == distance.end() || *farthest <= 0) break;
        spread(static_cast<std::size_t>(farthest - distance.begin()));
    }
    return patch;
}

// Patches of one component that share no edge (where more than two triangles meet at one, or only corners touch) are
// linked where they share a vertex, unless a way between them is known.
void link_at_vertices(std::vector<PatchLink>& links, const std::vector<int>& of_triangle, const Topology& topology,
                      int count) {
    std::vector<int> parent(static_cast<std::size_t>(count));
    std::iota(parent.begin(), parent.end(), 0);
    const auto top_of = [&](int p) {
        while (parent[static_cast<std::size_t>(p)] != p)
            p = parent[static_cast<std::size_t>(p)] =
                parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(p)])];
        return p;
    };
    double least = 1;
    for (const PatchLink& link : links) {
        parent[static_cast<std::size_t>(top_of(link.first))] = top_of(link.second);
        least = std::min(least, link.length);
    }
    for (std::ptrdiff_t v = 0; v < topology.vertex_triangles.size(); ++v) {
        const auto around = topology.vertex_triangles[v];
        for (std::size_t k = 1; k < around.size(); ++k) {
            const int p = of_triangle[static_cast<std::size_t>(around[0])];
            const int q = of_triangle[static_cast<std::size_t>(around[k])];
            if (top_of(p) == top_of(q)) continue;
            parent[static_cast<std::size_t>(top_of(p))] = top_of(q);
            links.push_back({std::min(p, q), std::max(p, q), least});
        }
    }
}

} // namespace

FaceField face_field(const Points& from, const Points& to, const Triangles& triangles) {
    const Eigen::Index m = triangles.rows();
    FaceField field{Points(m, 3), Points(m, 3), Eigen::VectorXd::Zero(m), Quaternions(static_cast<std::size_t>(m))};
    parallel_for(m, [&](Eigen::Index t) {
        field.centre_from.row(t) =
            (from.row(triangles(t, 0)) + from.row(triangles(t, 1)) + from.row(triangles(t, 2))) / 3;
        field.centre_to.row(t) = (to.row(triangles(t, 0)) + to.row(triangles(t, 1)) + to.row(triangles(t, 2))) / 3;
        const Frame a = frame_of(from, triangles, t), b = frame_of(to, triangles, t);
        const bool sound = a.sound && b.sound;
        field.rotation[static_cast<std::size_t>(t)] = sound ? rotation_between(a, b) : Eigen::Quaterniond::Identity();
        if (sound) field.area[t] = (a.x1 * a.y2 + b.x1 * b.y2) / 4;
    });
    return field;
}

Quaternions mean_rotations(const FaceField& faces, const std::vector<int>& group, int count) {
    return means(faces, group, count).rotation;
}

Patches patches(const FaceField& faces, const Triangles& triangles, const Topology& topology, int count) {
    const Groups graph = groups(faces, topology, 40 * count);
    int found = 0;
    const std::vector<int> patch_of_group = farthest_point_patches(graph, count, found);
    Patches result;
    for (const int g : graph.of_triangle) result.of_triangle.push_back(patch_of_group[static_cast<std::size_t>(g)]);
    FaceField mean = means(faces, result.of_triangle, found);
    result.centre_from = std::move(mean.centre_from);
    result.centre_to = std::move(mean.centre_to);
    result.rotation = std::move(mean.rotation);
    std::vector<PatchLink> links;
    for (std::size_t g = 0; g < graph.sides.size(); ++g)
        for (const auto& side : graph.sides[g]) {
            const int p = patch_of_group[g], q = patch_of_group[static_cast<std::size_t>(side.to)];
            if (p < q) links.push_back({p, q, side.border});
        }
    std::sort(links.begin(), links.end(), [](const PatchLink& a, const PatchLink& b) {
        return std::tie(a.first, a.second) < std::tie(b.first, b.second);
    });
    for (const PatchLink& link : links) {
        if (!result.links.empty() && result.links.back().first == link.first &&
            result.links.back().second == link.second)
            result.links.back().length += link.length;
        else
            result.links.push_back(link);
    }
    link_at_vertices(result.links, result.of_triangle, topology, found);
    const std::vector<int> component = components(topology);
    result.component.assign(static_cast<std::size_t>(found), 0);
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        result.component[static_cast<std::size_t>(result.of_triangle[static_cast<std::size_t>(t)])] =
            component[static_cast<std::size_t>(triangles(t, 0))];
    return result;
}

} // namespace meshtween
