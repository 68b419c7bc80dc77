// Coarser copies of a mesh by edge collapse.
//
// Garland, Heckbert: Surface simplification using quadric error metrics. SIGGRAPH 1997.
// Hoppe, DeRose, Duchamp, McDonald, Stuetzle: Mesh optimization. SIGGRAPH 1993 (the link condition).
#include "meshtween/fit/hierarchy.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/place_on_triangle.h"
#include "meshtween/geometry/topology.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <queue>

namespace meshtween {
namespace {

using Quadric = Eigen::Matrix4d;

constexpr double length_share = 0.01; // of squared edge length times area, beside the quadric error: see the header
constexpr double least_turn = 0.2;    // cosine between a triangle's normals before and after a collapse

struct Candidate {
    double cost;
    int vertex, to, stamp;
    bool operator<(const Candidate& other) const { // the cheapest on top; ties by index, the same on every machine
        return cost != other.cost ? cost > other.cost : vertex > other.vertex;
    }
};

class Decimation {
public:
    Decimation(const Points& positions, const Triangles& triangles)
        : positions_(positions), triangles_(triangles), around_(static_cast<std::size_t>(positions.rows())),
          boundary_(around_.size(), 0), parent_(around_.size(), -1), stamp_(around_.size(), 0),
          area_(around_.size(), 0.0), quadrics_(around_.size(), Quadric::Zero()), alive_(positions.rows()) {
        const Topology topology = meshtween::topology(positions.rows(), triangles);
        for (std::size_t v = 0; v < around_.size(); ++v) {
            const auto list = topology.vertex_triangles[static_cast<std::ptrdiff_t>(v)];
            around_[v].assign(list.begin(), list.end());
        }
        for (Eigen::Index t = 0; t < triangles.rows(); ++t) add_plane(static_cast<int>(t));
        for (const Edge& edge : topology.edges)
            if (edge.count != 2) add_border(edge);
        for (std::size_t v = 0; v < around_.size(); ++v) push(static_cast<int>(v), false);
    }

    Eigen::Index alive() const { return alive_; }
    bool alive(int v) const { return parent_[static_cast<std::size_t>(v)] < 0; }
    int root(int v) const {
        while (parent_[static_cast<std::size_t>(v)] >= 0) v = parent_[static_cast<std::size_t>(v)];
        return v;
    }
    bool triangle_alive(Eigen::Index t) const { return triangles_(t, 0) >= 0; }
    const Triangles& triangles() const { return triangles_; }

    void collapse_to(Eigen::Index count) {
        while (alive_ > count && !heap_.empty()) {
            const Candidate best = heap_.top();
            heap_.pop();
            if (!alive(best.vertex) || best.stamp != stamp_[static_cast<std::size_t>(best.vertex)]) continue;
            if (allowed(best.vertex, best.to))
                collapse(best.vertex, best.to);
            else
                push(best.vertex, true);
        }
    }

private:
    void add_plane(int t) {
        const Point twice = double_area_normal(positions_, triangles_, t);
        const double length = twice.norm();
        if (length <= 0) return;
        Eigen::Vector4d plane;
        plane.head<3>() = twice.transpose() / length;
        plane[3] = -plane.head<3>().dot(positions_.row(triangles_(t, 0)));
        for (int k = 0; k < 3; ++k) {
            const auto v = static_cast<std::size_t>(triangles_(t, k));
            quadrics_[v] += length / 6 * plane * plane.transpose();
            area_[v] += length / 6;
        }
    }

    // A plane through the border edge, at right angles to its triangle, so that borders keep their line.
    void add_border(const Edge& edge) {
        const auto [a, b] = edge.vertices;
        boundary_[static_cast<std::size_t>(a)] = boundary_[static_cast<std::size_t>(b)] = 1;
        const Point along = positions_.row(b) - positions_.row(a);
        const Point across = along.cross(double_area_normal(positions_, triangles_, edge.triangles[0]));
        if (across.norm() <= 0) return;
        Eigen::Vector4d plane;
        plane.head<3>() = across.normalized().transpose();
        plane[3] = -plane.head<3>().dot(positions_.row(a));
        for (const int v : {a, b})
            quadrics_[static_cast<std::size_t>(v)] += along.squaredNorm() * plane * plane.transpose();
    }

    void find_neighbours(int v, std::vector<int>& list) const {
        list.clear();
        for (const int t : around_[static_cast<std::size_t>(v)])
            for (int k = 0; k < 3; ++k)
                if (triangles_(t, k) != v) list.push_back(triangles_(t, k));
        std::sort(list.begin(), list.end());
        list.erase(std::unique(list.begin(), list.end()), list.end());
    }

    double cost(int v, int to) const {
        const auto i = static_cast<std::size_t>(v);
        Eigen::Vector4d x;
        x << positions_.row(to).transpose(), 1;
        return x.dot((quadrics_[i] + quadrics_[static_cast<std::size_t>(to)]) * x) +
               length_share * area_[i] * (positions_.row(v) - positions_.row(to)).squaredNorm();
    }

    void push(int v, bool only_allowed) {
        Candidate best{std::numeric_limits<double>::infinity(), v, -1, ++stamp_[static_cast<std::size_t>(v)]};
        find_neighbours(v, around_pushed_);
        for (const int to : around_pushed_) {
            const double c = cost(v, to);
            if (c < best.cost && (!only_allowed || allowed(v, to))) best.cost = c, best.to = to;
        }
        if (best.to >= 0) heap_.push(best);
    }

    bool allowed(int v, int to) {
        const auto i = static_cast<std::size_t>(v);
        std::vector<int>&shared = shared_, &of_v = of_v_, &of_to = of_to_;
        find_neighbours(v, of_v);
        find_neighbours(to, of_to);
        shared.clear();
        std::set_intersection(of_v.begin(), of_v.end(), of_to.begin(), of_to.end(), std::back_inserter(shared));
        std::size_t opposite = 0;
        for (const int t : around_[i]) opposite += has(t, to);
        if (shared.size() != opposite || of_v.size() + of_to.size() - shared.size() < 5) return false;
        if (boundary_[i] && (opposite != 1 || !boundary_[static_cast<std::size_t>(to)])) return false;
        for (const int t : around_[i]) {
            if (has(t, to)) continue;
            std::array<Point, 3> after;
            for (int k = 0; k < 3; ++k) {
                const int corner = triangles_(t, k) == v ? to : triangles_(t, k);
                after[static_cast<std::size_t>(k)] = positions_.row(corner);
            }
            const Point n = (after[1] - after[0]).cross(after[2] - after[0]);
            const Point before = double_area_normal(positions_, triangles_, t);
            if (n.dot(before) <= least_turn * n.norm() * before.norm()) return false;
        }
        return true;
    }

    bool has(int t, int v) const { return triangles_(t, 0) == v || triangles_(t, 1) == v || triangles_(t, 2) == v; }

    void collapse(int v, int to) {
        const auto i = static_cast<std::size_t>(v), j = static_cast<std::size_t>(to);
        for (const int t : around_[i]) {
            if (has(t, to)) {
                for (int k = 0; k < 3; ++k) {
                    if (triangles_(t, k) == v) continue;
                    auto& list = around_[static_cast<std::size_t>(triangles_(t, k))];
                    list.erase(std::find(list.begin(), list.end(), t));
                }
                triangles_(t, 0) = -1;
            } else {
                for (int k = 0; k < 3; ++k)
                    if (triangles_(t, k) == v) triangles_(t, k) = to;
                around_[j].push_back(t);
            }
        }
        around_[i].clear();
        parent_[i] = to;
        quadrics_[j] += quadrics_[i];
        area_[j] += area_[i];
        --alive_;
        push(to, false);
        std::vector<int>& around = around_kept_;
        find_neighbours(to, around);
        for (const int w : around) push(w, false);
    }

    const Points& positions_;
    Triangles triangles_;
    std::vector<std::vector<int>> around_;
    std::vector<char> boundary_;
    std::vector<int> parent_, stamp_;
    std::vector<double> area_;
    std::vector<Quadric, Eigen::aligned_allocator<Quadric>> quadrics_;
    Eigen::Index alive_;
    std::priority_queue<Candidate> heap_;
    std::vector<int> around_pushed_, around_kept_, of_v_, of_to_, shared_; // scratch, made once
};

// The level that is left of a decimation; `index` gets the new number of each vertex of the mesh, -1 for the gone.
Level remaining(const Decimation& decimation, const Points& positions, const std::vector<int>& finer_index,
                std::vector<int>& index) {
    Level level;
    index.assign(static_cast<std::size_t>(positions.rows()), -1);
    std::vector<int> kept;
    for (int v = 0; v < positions.rows(); ++v)
        if (decimation.alive(v)) {
            index[static_cast<std::size_t>(v)] = static_cast<int>(kept.size());
            level.finer.push_back(finer_index[static_cast<std::size_t>(v)]);
            kept.push_back(v);
        }
    level.positions.resize(static_cast<Eigen::Index>(kept.size()), 3);
    for (std::size_t i = 0; i < kept.size(); ++i)
        level.positions.row(static_cast<Eigen::Index>(i)) = positions.row(kept[i]);
    const Triangles& all = decimation.triangles();
    level.triangles.resize(all.rows(), 3);
    Eigen::Index count = 0;
    for (Eigen::Index t = 0; t < all.rows(); ++t) {
        if (!decimation.triangle_alive(t)) continue;
        for (int k = 0; k < 3; ++k) level.triangles(count, k) = index[static_cast<std::size_t>(all(t, k))];
        ++count;
    }
    level.triangles.conservativeResize(count, 3);
    return level;
}

// The closest place among the triangles of `start` and of its neighbours.
SurfacePoint local_place(const Level& level, const Topology& topology, int start, const Point& query) {
    SurfacePoint best{0, {1, 0, 0}}; // kept by a vertex of no triangle
    double least = std::numeric_limits<double>::infinity();
    const auto look = [&](int vertex) {
        for (const int t : topology.vertex_triangles[vertex]) {
            const auto corners = level.triangles.row(t);
            const auto p = place_on_triangle(query, level.positions.row(corners[0]), level.positions.row(corners[1]),
                                             level.positions.row(corners[2]));
            if (p.squared_distance < least) least = p.squared_distance, best = {t, {1 - p.v - p.w, p.v, p.w}};
        }
    };
    look(start);
    for (const int w : topology.neighbours[start]) look(w);
    return best;
}

} // namespace

std::vector<Level> hierarchy(const Points& positions, const Triangles& triangles, const HierarchyOptions& options) {
    std::vector<Level> levels(1);
    levels[0].positions = positions;
    levels[0].triangles = triangles;
    levels[0].finer.resize(static_cast<std::size_t>(positions.rows()));
    for (std::size_t v = 0; v < levels[0].finer.size(); ++v) levels[0].finer[v] = static_cast<int>(v);
    if (positions.rows() <= options.coarsest) return levels;

    Decimation decimation(positions, triangles);
    std::vector<int> finer_index = levels[0].finer, mesh_vertex = levels[0].finer, index;
    while (true) {
        const Level& finer = levels.back();
        const auto wanted = static_cast<Eigen::Index>(static_cast<double>(finer.positions.rows()) / options.factor);
        if (wanted < options.coarsest / 2) break;
        decimation.collapse_to(std::max<Eigen::Index>(wanted, options.coarsest));
        if (static_cast<double>(decimation.alive()) > 0.7 * static_cast<double>(finer.positions.rows())) break;
        Level level = remaining(decimation, positions, finer_index, index);
        level.place.resize(static_cast<std::size_t>(finer.positions.rows()));
        const Topology neighbourhood = topology(level.positions.rows(), level.triangles);
        parallel_for(finer.positions.rows(), [&](std::ptrdiff_t i) {
            const int start =
                index[static_cast<std::size_t>(decimation.root(mesh_vertex[static_cast<std::size_t>(i)]))];
            level.place[static_cast<std::size_t>(i)] = local_place(level, neighbourhood, start, finer.positions.row(i));
        });
        std::vector<int> kept;
        for (const int f : level.finer) kept.push_back(mesh_vertex[static_cast<std::size_t>(f)]);
        mesh_vertex = std::move(kept);
        finer_index = index;
        levels.push_back(std::move(level));
    }
    return levels;
}

} // namespace meshtween
