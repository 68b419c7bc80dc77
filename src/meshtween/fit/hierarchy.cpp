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
#include <limits>
#include <queue>

namespace meshtween {
namespace {

constexpr double length_share = 0.01; // of squared edge length times area, beside the quadric error: see the header
constexpr double least_turn = 0.2;    // cosine between a triangle's normals before and after a collapse

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// Weighted squared distances from planes, summed: x A x + 2 b x + c.
struct Quadric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    Point b{0, 0, 0};
    double c = 0;

    void add_plane(const Point& n, const Point& through, double weight) {
        const Point w = weight * n;
        const double d = -n.dot(through);
        xx += w[0] * n[0], xy += w[0] * n[1], xz += w[0] * n[2];
        yy += w[1] * n[1], yz += w[1] * n[2], zz += w[2] * n[2];
        b += d * w;
        c += weight * d * d;
    }
    void add(const Quadric& other) {
        xx += other.xx, xy += other.xy, xz += other.xz, yy += other.yy, yz += other.yz, zz += other.zz;
        b += other.b;
        c += other.c;
    }
    double at(const Point& p) const {
        return p[0] * (xx * p[0] + 2 * (xy * p[1] + xz * p[2] + b[0])) + p[1] * (yy * p[1] + 2 * (yz * p[2] + b[1])) +
               p[2] * (zz * p[2] + 2 * b[2]) + c;
    }
};

struct Candidate {
    double cost;
    int vertex, to;
    bool operator<(const Candidate& other) const { // the cheapest on top; ties by index, the same on every machine
        return cost != other.cost ? cost > other.cost : vertex > other.vertex;
    }
};

class Decimation {
public:
    Decimation(const Points& positions, const Triangles& triangles)
        : positions_(positions), triangles_(triangles), first_(idx(positions.rows()), -1),
          next_(idx(triangles.size()), -1), boundary_(first_.size(), 0), waiting_(first_.size(), Waiting::no),
          parent_(first_.size(), -1), mark_(first_.size(), 0), area_(first_.size(), 0.0), quadrics_(first_.size()),
          alive_(positions.rows()) {
        for (auto c = std::ssize(next_); c-- > 0;) {
            int& first = first_[idx(triangles.data()[c])];
            next_[idx(c)] = first;
            first = static_cast<int>(c);
        }
        const Topology topology = meshtween::topology(positions.rows(), triangles);
        parallel_for(positions.rows(), [&](std::ptrdiff_t v) {
            for (const int t : topology.vertex_triangles[v]) add_plane(idx(v), t);
        });
        for (const Edge& edge : topology.edges)
            if (edge.count != 2) add_border(edge);
        std::vector<Candidate> candidates(first_.size());
        parallel_for(positions.rows(), [&](std::ptrdiff_t v) {
            candidates[idx(v)] = cheapest(static_cast<int>(v), topology.neighbours[v], [](int) { return true; });
        });
        std::erase_if(candidates, [](const Candidate& c) { return c.to < 0; });
        for (const Candidate& c : candidates) waiting_[idx(c.vertex)] = Waiting::yes;
        heap_ = std::priority_queue<Candidate>({}, std::move(candidates));
    }

    Eigen::Index alive() const { return alive_; }
    bool alive(int v) const { return parent_[idx(v)] < 0; }
    int root(int v) const {
        while (parent_[idx(v)] >= 0) v = parent_[idx(v)];
        return v;
    }
    bool triangle_alive(Eigen::Index t) const { return triangles_(t, 0) >= 0; }
    const Triangles& triangles() const { return triangles_; }

    void collapse_to(Eigen::Index count) {
        while (alive_ > count && !heap_.empty()) {
            const Candidate best = heap_.top();
            heap_.pop();
            Waiting& waiting = waiting_[idx(best.vertex)];
            const bool current = waiting == Waiting::yes && alive(best.to);
            waiting = Waiting::no;
            if (!alive(best.vertex)) continue;
            if (!current)
                push(best.vertex, [](int) { return true; });
            else if (allowed(best.vertex, best.to))
                collapse(best.vertex, best.to);
            else
                push(best.vertex, [&](int to) { return allowed(best.vertex, to); });
        }
    }

private:
    // In the heap. Costs change with every collapse near by and mostly grow: they are computed anew when their turn
    // comes.
    enum class Waiting : char { no, yes, out_of_date };

    void add_plane(std::size_t v, int t) {
        const Point twice = double_area_normal(positions_, triangles_, t);
        const double length = twice.norm();
        if (length <= 0) return;
        quadrics_[v].add_plane(twice / length, positions_.row(triangles_(t, 0)), length / 6);
        area_[v] += length / 6;
    }

    // A plane through the border edge, at right angles to its triangle, so that borders keep their line.
    void add_border(const Edge& edge) {
        const auto [a, b] = edge.vertices;
        boundary_[idx(a)] = boundary_[idx(b)] = 1;
        const Point along = positions_.row(b) - positions_.row(a);
        const Point across = along.cross(double_area_normal(positions_, triangles_, edge.triangles[0]));
        if (across.norm() <= 0) return;
        for (const int v : {a, b})
            quadrics_[idx(v)].add_plane(across.normalized(), positions_.row(a), along.squaredNorm());
    }

    // Calls visit(triangle) for the triangles that are left around v.
    template <typename Visit>
    void each_triangle(int v, const Visit& visit) {
        for (int* c = &first_[idx(v)]; *c >= 0;) {
            if (triangle_alive(*c / 3)) {
                visit(*c / 3);
                c = &next_[idx(*c)];
            } else {
                *c = next_[idx(*c)];
            }
        }
    }

    // Each once. Also says how many of them have the mark `of`.
    int find_neighbours(int v, std::vector<int>& list, int of = 0) {
        list.clear();
        int both = 0;
        const int own = ++last_mark_;
        each_triangle(v, [&](int t) {
            for (int k = 0; k < 3; ++k) {
                const int w = triangles_(t, k);
                int& mark = mark_[idx(w)];
                if (w == v || mark == own) continue;
                both += of > 0 && mark == of;
                mark = own;
                list.push_back(w);
            }
        });
        return both;
    }

    double cost(int v, int to) const {
        const Point at = positions_.row(to);
        return quadrics_[idx(v)].at(at) + quadrics_[idx(to)].at(at) +
               length_share * area_[idx(v)] * (positions_.row(v) - at).squaredNorm();
    }

    template <typename List, typename Accept>
    Candidate cheapest(int v, const List& neighbours, const Accept& accept) const {
        Candidate best{std::numeric_limits<double>::infinity(), v, -1};
        for (const int to : neighbours) {
            const double c = cost(v, to);
            const bool better = c < best.cost || (c == best.cost && to < best.to);
            if (better && accept(to)) best.cost = c, best.to = to;
        }
        return best;
    }

    template <typename Accept>
    void push(int v, const Accept& accept) {
        find_neighbours(v, pushed_);
        const Candidate best = cheapest(v, pushed_, accept);
        if (best.to < 0) return;
        waiting_[idx(v)] = Waiting::yes;
        heap_.push(best);
    }

    void neighbourhood_changed(int v) {
        Waiting& waiting = waiting_[idx(v)];
        if (waiting == Waiting::no)
            push(v, [](int) { return true; });
        else
            waiting = Waiting::out_of_date;
    }

    bool allowed(int v, int to) {
        find_neighbours(v, of_v_);
        const int shared = find_neighbours(to, of_to_, last_mark_);
        int opposite = 0;
        bool turned = false;
        each_triangle(v, [&](int t) {
            if (has(t, to))
                ++opposite;
            else
                turned = turned || turns(t, v, to);
        });
        if (turned || shared != opposite || std::ssize(of_v_) + std::ssize(of_to_) - shared < 5) return false;
        return !boundary_[idx(v)] || (opposite == 1 && boundary_[idx(to)]);
    }

    // The triangle would look another way with v at the place of `to`.
    bool turns(int t, int v, int to) const {
        std::array<Point, 3> after;
        for (int k = 0; k < 3; ++k) after[idx(k)] = positions_.row(triangles_(t, k) == v ? to : triangles_(t, k));
        const Point n = (after[1] - after[0]).cross(after[2] - after[0]);
        const Point before = double_area_normal(positions_, triangles_, t);
        return n.dot(before) <= least_turn * n.norm() * before.norm();
    }

    bool has(int t, int v) const { return triangles_(t, 0) == v || triangles_(t, 1) == v || triangles_(t, 2) == v; }

    void collapse(int v, int to) {
        each_triangle(v, [&](int t) {
            if (has(t, to))
                triangles_(t, 0) = -1;
            else
                for (int k = 0; k < 3; ++k)
                    if (triangles_(t, k) == v) triangles_(t, k) = to;
        });
        int* last = &first_[idx(to)];
        while (*last >= 0) last = &next_[idx(*last)];
        *last = first_[idx(v)];
        parent_[idx(v)] = to;
        quadrics_[idx(to)].add(quadrics_[idx(v)]);
        area_[idx(to)] += area_[idx(v)];
        --alive_;
        find_neighbours(to, around_);
        neighbourhood_changed(to);
        for (const int w : around_) neighbourhood_changed(w);
    }

    const Points& positions_;
    Triangles triangles_;           // -1 first where one is gone
    std::vector<int> first_, next_; // the corners at each vertex, 3 t + k, as a chain
    std::vector<char> boundary_;
    std::vector<Waiting> waiting_;
    std::vector<int> parent_, mark_;
    int last_mark_ = 0;
    std::vector<double> area_;
    std::vector<Quadric> quadrics_;
    Eigen::Index alive_;
    std::priority_queue<Candidate> heap_;
    std::vector<int> pushed_, around_, of_v_, of_to_; // scratch, made once
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
    const auto look = [&](int t) {
        const auto corners = level.triangles.row(t);
        const auto p = place_on_triangle(query, level.positions.row(corners[0]), level.positions.row(corners[1]),
                                         level.positions.row(corners[2]));
        if (p.squared_distance < least) least = p.squared_distance, best = {t, {1 - p.v - p.w, p.v, p.w}};
    };
    for (const int t : topology.vertex_triangles[start]) look(t);
    for (const int w : topology.neighbours[start])
        for (const int t : topology.vertex_triangles[w])
            if ((level.triangles.row(t).array() != start).all()) look(t);
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
        decimation.collapse_to(wanted < 2 * options.coarsest ? options.coarsest : wanted);
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
