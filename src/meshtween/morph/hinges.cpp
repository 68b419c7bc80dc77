// A rotation tells an angle only up to whole turns. Where two triangles have turned against each other by more than
// half a turn, the short way round leads through a fold; the angle across the edge that they share says which way it
// was, since the surface does not pass through itself there.
//   Sun, Wang and Chin, Interpolating Polyhedral Models Using Intrinsic Shape Parameters, 1997 (dihedral angles
//   blended) Wang, Liu and Tong, Linear Surface Reconstruction from Discrete Fundamental Forms on Triangle Meshes, 2012
//   (put together in least squares)
// Loops of hinges may disagree about which way round, and a mean of opposite turns is none. So it is decided once,
// half-way, in rounds that trust those hinges less which the others outvote; with their weights every frame starts from
// a tree of the surest hinges and settles by a few Gauss-Newton steps, so that the rotations are smooth in u.
#include "meshtween/morph/hinges.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/morph/rotation_graph.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <queue>

namespace meshtween {
namespace {

constexpr double third = std::numbers::pi / 3; // of half a turn
constexpr double anchor =
    1e-6; // of those inside, beside hinges of weight 1: a part without any around it stays regular

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// From the normal of t to that of `other`, about their shared edge, which begins at a corner of t.
double fold(const Points& p, const Triangles& triangles, int t, int corner, int other) {
    const Point along = (p.row(triangles(t, (corner + 1) % 3)) - p.row(triangles(t, corner))).normalized();
    const Point a = double_area_normal(p, triangles, t).normalized(),
                b = double_area_normal(p, triangles, other).normalized();
    return std::atan2(a.cross(b).dot(along), a.dot(b));
}

// The corner at which the triangle's edge from vertex i to j begins, or -1.
int corner_of(const Triangles& triangles, int t, int i, int j) {
    for (int k = 0; k < 3; ++k)
        if (triangles(t, k) == i && triangles(t, (k + 1) % 3) == j) return k;
    return -1;
}

// Along the edge, across it in the triangle's plane, and the normal, as columns.
Eigen::Matrix3d frame(const TriangleEdges& edges, const Eigen::Vector3d& along) {
    Eigen::Matrix3d axes;
    axes.col(0) = along.normalized();
    axes.col(2) = edges[0].cross(edges[1]).normalized();
    axes.col(1) = axes.col(2).cross(axes.col(0));
    return axes;
}

// The hinge at an edge between two triangles with area, its triangles numbered as in the mesh; none elsewhere.
std::optional<PatchHinge> hinge_at(const Edge& edge, const Points& from, const Points& to, const Triangles& triangles,
                                   const FaceField& faces) {
    const auto [a, b] = edge.triangles;
    if (edge.count != 2 || !(faces.area[a] > 0 && faces.area[b] > 0)) return {};
    auto [i, j] = edge.vertices;
    if (corner_of(triangles, a, i, j) < 0) std::swap(i, j);
    const int k = corner_of(triangles, a, i, j), l = corner_of(triangles, b, j, i);
    if (l < 0) return {}; // both run the same way: there is no angle between them
    PatchHinge hinge{a, b, k, l, fold(from, triangles, a, k, b), fold(to, triangles, a, k, b), 1};
    // As springs in a row; and small angles are surer.
    const double way = hinge.angle_to - hinge.angle_from;
    hinge.weight = faces.area[a] * faces.area[b] / (faces.area[a] + faces.area[b]) * std::exp(-way * way / 2);
    return hinge;
}

// The second's rotation against the first's at u.
Eigen::Matrix3d between(const PatchHinge& hinge, const TriangleEdges& first, const TriangleEdges& second, double u) {
    const double angle = (1 - u) * hinge.angle_from + u * hinge.angle_to;
    return frame(first, first[idx(hinge.corner)]) * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()) *
           frame(second, -second[idx(hinge.partner)]).transpose();
}

std::vector<RotationLink> links(const Hinges& hinges, const LocalEdges& edges, const Eigen::VectorXd& u) {
    std::vector<RotationLink> result(hinges.hinges.size());
    parallel_for(std::ssize(result), [&](Eigen::Index k) {
        const PatchHinge& hinge = hinges.hinges[idx(k)];
        const int first = hinges.triangles[idx(hinge.first)], second = hinges.triangles[idx(hinge.second)];
        result[idx(k)] = {hinge.first, hinge.second,
                          between(hinge, edges(first), edges(second), (u[first] + u[second]) / 2), hinge.weight};
    });
    return result;
}

Hinges found(const Points& from, const Points& to, const Triangles& triangles, const Topology& topology,
             const FaceField& faces, const std::vector<char>& inside) {
    Hinges result;
    std::vector<int> number(inside.size(), -1);
    const auto node = [&](int t) {
        int& own = number[idx(t)];
        if (own >= 0) return own;
        own = static_cast<int>(result.triangles.size());
        result.triangles.push_back(t);
        result.inside.push_back(inside[idx(t)]);
        return own;
    };
    double sum = 0;
    for (const Edge& edge : topology.edges) {
        if (!inside[idx(edge.triangles[0])] && (edge.triangles[1] < 0 || !inside[idx(edge.triangles[1])])) continue;
        std::optional<PatchHinge> hinge = hinge_at(edge, from, to, triangles, faces);
        if (!hinge) continue;
        hinge->first = node(hinge->first), hinge->second = node(hinge->second);
        sum += hinge->weight;
        result.hinges.push_back(*hinge);
    }
    for (PatchHinge& hinge : result.hinges) hinge.weight *= static_cast<double>(result.hinges.size()) / sum;
    return result;
}

// All rotations in least squares, from nothing known but those around.
Quaternions put_together(const Hinges& hinges, const std::vector<RotationLink>& links, const Quaternions& rotations) {
    std::vector<RotationRoot> roots;
    for (std::size_t n = 0; n < hinges.triangles.size(); ++n)
        roots.push_back({static_cast<int>(n), rotations[idx(hinges.triangles[n])].toRotationMatrix(),
                         hinges.inside[n] ? anchor : 1});
    return synchronised(static_cast<int>(roots.size()), links, roots);
}

// Trusts a hinge the less the further the others turn its triangles away from what it says.
void decide(Hinges& hinges, const LocalEdges& half_edges, const Quaternions& half) {
    constexpr int rounds = 2;
    std::vector<RotationLink> said = links(hinges, half_edges, Eigen::VectorXd::Constant(std::ssize(half), 0.5));
    for (int round = 0; round < rounds; ++round) {
        const Quaternions turned = put_together(hinges, said, half);
        for (std::size_t k = 0; k < said.size(); ++k) {
            const Eigen::Quaterniond is = turned[idx(said[k].first)].conjugate() * turned[idx(said[k].second)];
            const double cosine = is.dot(Eigen::Quaterniond(said[k].rotation)); // of half the angle between
            said[k].weight = hinges.hinges[k].weight * (std::pow(cosine, 4) + anchor);
        }
    }
    for (std::size_t k = 0; k < said.size(); ++k) hinges.hinges[k].weight = said[k].weight;
}

// A spanning tree of greatest weight (Prim 1957), from all triangles around at once.
void grow_tree(Hinges& hinges) {
    std::vector<std::vector<int>> of(hinges.triangles.size());
    for (std::size_t k = 0; k < hinges.hinges.size(); ++k)
        for (const int n : {hinges.hinges[k].first, hinges.hinges[k].second}) of[idx(n)].push_back(static_cast<int>(k));
    std::vector<char> reached(hinges.triangles.size(), 0);
    std::priority_queue<std::pair<double, int>> queue; // weight, minus the hinge's number
    const auto reach = [&](int n) {
        reached[idx(n)] = 1;
        for (const int k : of[idx(n)]) queue.emplace(hinges.hinges[idx(k)].weight, -k);
    };
    const auto grow = [&] {
        while (!queue.empty()) {
            const int k = -queue.top().second;
            queue.pop();
            const PatchHinge& hinge = hinges.hinges[idx(k)];
            if (reached[idx(hinge.first)] && reached[idx(hinge.second)]) continue;
            const bool back = reached[idx(hinge.second)] != 0;
            hinges.tree.push_back({k, back});
            reach(back ? hinge.first : hinge.second);
        }
    };
    const int count = static_cast<int>(hinges.triangles.size());
    for (int n = 0; n < count; ++n)
        if (!hinges.inside[idx(n)]) reach(n);
    grow();
    for (int n = 0; n < count; ++n) // parts with nothing around them
        if (!reached[idx(n)]) reach(n), grow();
}

// Those around hold: what stands on their diagonal outweighs any hinge.
SparseCholesky least_squares(const Hinges& hinges) {
    const auto count = std::ssize(hinges.triangles);
    std::vector<Eigen::Triplet<double>> triplets;
    double most = 1;
    for (const PatchHinge& hinge : hinges.hinges) {
        triplets.emplace_back(std::max(hinge.first, hinge.second), std::min(hinge.first, hinge.second), -hinge.weight);
        triplets.emplace_back(hinge.first, hinge.first, hinge.weight);
        triplets.emplace_back(hinge.second, hinge.second, hinge.weight);
        most = std::max(most, hinge.weight);
    }
    for (int n = 0; n < count; ++n) triplets.emplace_back(n, n, hinges.inside[idx(n)] ? anchor : 1e6 * most);
    Eigen::SparseMatrix<double> matrix(count, count);
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    return SparseCholesky(matrix);
}

// One Gauss-Newton step towards least squares of the sine of what is off at each hinge.
void settle(const Hinges& hinges, const std::vector<RotationLink>& links, Quaternions& rotations) {
    const auto of = [&](int n) -> Eigen::Quaterniond& { return rotations[idx(hinges.triangles[idx(n)])]; };
    Points right = Points::Zero(std::ssize(hinges.triangles), 3);
    for (const RotationLink& link : links) {
        const Eigen::Quaterniond off = of(link.first) * Eigen::Quaterniond(link.rotation) * of(link.second).conjugate();
        const Point way = 2 * link.weight * off.w() * off.vec().transpose(); // sine and axis
        right.row(link.second) += way;
        right.row(link.first) -= way;
    }
    const Points step = hinges.system->solve(right);
    for (Eigen::Index n = 0; n < step.rows(); ++n) {
        const double angle = step.row(n).norm();
        if (!hinges.inside[idx(n)] || angle == 0) continue;
        Eigen::Quaterniond& own = of(static_cast<int>(n));
        own = Eigen::AngleAxisd(angle, Eigen::Vector3d(step.row(n).transpose() / angle)) * own;
    }
}

} // namespace

// Across a border two triangles turn against each other by no more than both against their patches and those against
// each other: by less than half a turn where each of the three is less than a third of it.
std::vector<char> entangled(const FaceField& faces, const Patches& patches) {
    std::vector<char> flags(patches.rotation.size(), 0);
    for (const PatchLink& link : patches.links)
        if (patches.rotation[idx(link.first)].angularDistance(patches.rotation[idx(link.second)]) > third)
            flags[idx(link.first)] = flags[idx(link.second)] = 1;
    for (std::size_t t = 0; t < patches.of_triangle.size(); ++t) {
        const std::size_t p = idx(patches.of_triangle[t]);
        if (faces.area[static_cast<Eigen::Index>(t)] > 0 &&
            patches.rotation[p].angularDistance(faces.rotation[t]) > third)
            flags[p] = 1;
    }
    return flags;
}

std::vector<char> misled(const std::vector<char>& entangled, const Points& from, const Points& to,
                         const Triangles& triangles, const Topology& topology, const FaceField& faces,
                         const Patches& patches, const LocalEdges& half_edges, const Quaternions& half) {
    std::vector<char> flags(entangled.size(), 0);
    std::vector<int> queue;
    const auto take = [&](int p) {
        if (!entangled[idx(p)] || flags[idx(p)]) return;
        flags[idx(p)] = 1;
        queue.push_back(p);
    };
    for (const Edge& edge : topology.edges) {
        if (edge.triangles[1] < 0) continue;
        const int p = patches.of_triangle[idx(edge.triangles[0])], q = patches.of_triangle[idx(edge.triangles[1])];
        if ((!entangled[idx(p)] || flags[idx(p)]) && (!entangled[idx(q)] || flags[idx(q)])) continue;
        const std::optional<PatchHinge> hinge = hinge_at(edge, from, to, triangles, faces);
        if (!hinge) continue;
        const Eigen::Quaterniond said(between(*hinge, half_edges(hinge->first), half_edges(hinge->second), 0.5));
        if (said.angularDistance(half[idx(hinge->first)].conjugate() * half[idx(hinge->second)]) <= third / 2) continue;
        take(p), take(q);
    }
    std::vector<std::vector<int>> neighbours(flags.size());
    for (const PatchLink& link : patches.links) {
        neighbours[idx(link.first)].push_back(link.second);
        neighbours[idx(link.second)].push_back(link.first);
    }
    std::size_t head = 0;
    while (head < queue.size())
        for (const int p : neighbours[idx(queue[head++])]) take(p);
    return flags;
}

// Seen from either end of a link the other patch has turned half its way as the hinge says and the triangles' own
// halves against their patches. The short way round and the long one are half a turn apart there.
Turns way_round(Turns turns, const Points& from, const Points& to, const Triangles& triangles, const Topology& topology,
                const FaceField& faces, const Patches& patches, const LocalEdges& half_edges) {
    std::map<std::pair<int, int>, std::pair<std::size_t, double>> far; // links, and the vote for the short way
    for (std::size_t k = 0; k < turns.links.size(); ++k)
        if (turns.links[k].rotation_vector.norm() > third) far[{turns.links[k].first, turns.links[k].second}] = {k, 0};
    for (const Edge& edge : topology.edges) {
        if (far.empty() || edge.triangles[1] < 0) continue;
        const int p = patches.of_triangle[idx(edge.triangles[0])], q = patches.of_triangle[idx(edge.triangles[1])];
        const auto link = far.find({std::min(p, q), std::max(p, q)});
        if (link == far.end()) continue;
        const std::optional<PatchHinge> hinge = hinge_at(edge, from, to, triangles, faces);
        if (!hinge) continue;
        const auto half = [&](int t) { return exponential(turns.faces[idx(t)].rotation_vector[0].cast<double>() / 2); };
        Eigen::Quaterniond turn =
            half(hinge->first) *
            Eigen::Quaterniond(between(*hinge, half_edges(hinge->first), half_edges(hinge->second), 0.5)) *
            half(hinge->second).conjugate();
        if (p > q) turn = turn.conjugate();
        const Eigen::Vector3d& way = turns.links[link->second.first].rotation_vector;
        const double is_short = turn.dot(exponential(way / 2));
        const double is_long = turn.dot(exponential(way / 2 - std::numbers::pi * way.normalized()));
        link->second.second += hinge->weight * (is_short * is_short - is_long * is_long);
    }
    for (const auto& [patch_pair, vote] : far) {
        Eigen::Vector3d& way = turns.links[vote.first].rotation_vector;
        if (vote.second < 0) way -= 2 * std::numbers::pi * way.normalized();
    }
    return turns;
}

Hinges hinges(const Points& from, const Points& to, const Triangles& triangles, const Topology& topology,
              const FaceField& faces, const std::vector<char>& inside, const LocalEdges& half_edges,
              const Quaternions& half) {
    Hinges result = found(from, to, triangles, topology, faces, inside);
    if (result.hinges.empty()) return result;
    decide(result, half_edges, half);
    grow_tree(result);
    result.system = least_squares(result);
    return result;
}

Quaternions turned_on_hinges(const Hinges& hinges, const LocalEdges& edges, const Eigen::VectorXd& u,
                             Quaternions rotations) {
    constexpr int rounds = 4;
    if (hinges.hinges.empty()) return rotations;
    const std::vector<RotationLink> now = links(hinges, edges, u);
    for (const Hinges::Step& step : hinges.tree) {
        const RotationLink& link = now[idx(step.hinge)];
        Eigen::Quaterniond &first = rotations[idx(hinges.triangles[idx(link.first)])],
                           &second = rotations[idx(hinges.triangles[idx(link.second)])];
        const Eigen::Quaterniond between(link.rotation);
        if (step.back)
            first = second * between.conjugate();
        else
            second = first * between;
    }
    for (int round = 0; round < rounds; ++round) settle(hinges, now, rotations);
    return rotations;
}

} // namespace meshtween
