#include "meshtween/geometry/weld.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/slits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

constexpr double reach = 1e-6; // parts of the diagonal: what lies no further apart is in one place

double squared_reach(const Points& x, const std::vector<int>& used) {
    if (used.empty()) return 0;
    Point low = x.row(used.front()), high = low;
    for (const int i : used) low = low.cwiseMin(x.row(i)), high = high.cwiseMax(x.row(i));
    return reach * reach * (high - low).squaredNorm();
}

class Classes {
public:
    explicit Classes(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
    int root(int i) const {
        while (parent_[idx(i)] != i) i = parent_[idx(i)];
        return i;
    }
    void join(int a, int b) {
        a = shortened(a), b = shortened(b);
        parent_[idx(std::max(a, b))] = std::min(a, b);
    }
    void join(const Triangles& triangles, const SeamEdge& edge) {
        for (int end = 0; end < 2; ++end) join(edge.vertex(triangles, 0, end), edge.vertex(triangles, 1, end));
    }

private:
    int shortened(int i) {
        while (parent_[idx(i)] != i) i = parent_[idx(i)] = parent_[idx(parent_[idx(i)])];
        return i;
    }
    std::vector<int> parent_; // never above the vertex itself
};

std::vector<int> finite_vertices(const std::vector<const Points*>& shapes) {
    std::vector<int> result;
    for (Eigen::Index i = 0; i < shapes.front()->rows(); ++i)
        if (std::all_of(shapes.begin(), shapes.end(), [&](const Points* s) { return s->row(i).allFinite(); }))
            result.push_back(static_cast<int>(i));
    return result;
}

// Those of some triangle: vertices of none may lie anywhere and say nothing of the mesh's size.
std::vector<int> used_among(const std::vector<int>& vertices, const Triangles& triangles) {
    std::vector<char> used(vertices.empty() ? 0 : idx(std::max(vertices.back(), triangles.maxCoeff())) + 1, 0);
    for (const int v : triangles.reshaped())
        if (!used.empty()) used[idx(v)] = 1;
    std::vector<int> result;
    for (const int v : vertices)
        if (used[idx(v)] != 0) result.push_back(v);
    return result;
}

// For each vertex the first in its place: those within reach in all shapes, directly or through others. Neighbours are
// found along a direction in which no two points of a usual mesh lie at one height.
std::vector<int> places_of(const Triangles& triangles, const std::vector<const Points*>& shapes) {
    const std::vector<int> finite = finite_vertices(shapes), used = used_among(finite, triangles);
    std::vector<double> near;
    for (const Points* shape : shapes) near.push_back(squared_reach(*shape, used));
    const Point along(0.5257311, 0.6180213, 0.5846227);
    std::vector<std::pair<double, int>> heights(finite.size());
    parallel_for(std::ssize(finite), [&](std::ptrdiff_t i) {
        heights[idx(i)] = {shapes.front()->row(finite[idx(i)]).dot(along), finite[idx(i)]};
    });
    std::sort(heights.begin(), heights.end());
    const double step = std::sqrt(near.front()) * 1.01;
    constexpr std::size_t most = 256; // that may lie at one height: the rest of a heap hangs together in a chain
    Classes classes(idx(shapes.front()->rows()));
    for (std::size_t i = 0; i < heights.size(); ++i)
        for (std::size_t j = i + 1, end = std::min(i + most, heights.size());
             j < end && heights[j].first - heights[i].first <= step; ++j) {
            const int v = heights[i].second, w = heights[j].second;
            bool one = true;
            for (std::size_t s = 0; s < shapes.size() && one; ++s)
                one = (shapes[s]->row(v) - shapes[s]->row(w)).squaredNorm() <= near[s];
            if (one) classes.join(v, w);
        }
    std::vector<int> place(idx(shapes.front()->rows()));
    for (std::size_t i = 0; i < place.size(); ++i) place[i] = classes.root(static_cast<int>(i));
    return place;
}

// A triangle's edge from corner k to the next, between places.
struct Half {
    int low = 0, high = 0; // places
    int triangle = 0, corner = 0;
    bool forward = true; // from low to high
    bool proper = true;  // of a triangle with three places; others join nothing, but show that an edge is shared
    int at_low = 0, at_high = 0; // the file's vertices
};

// The half-edges with an end in a place of several vertices, those of one place edge together.
class PlaceEdges {
public:
    PlaceEdges(const Triangles& triangles, const std::vector<int>& place, const std::vector<char>& shared)
        : triangles_(triangles), place_(place) {
        for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
            const std::array<int, 3> p = places(static_cast<int>(t));
            const bool proper = p[0] != p[1] && p[1] != p[2] && p[2] != p[0];
            for (int k = 0; k < 3; ++k) {
                const int a = triangles(t, k), b = triangles(t, (k + 1) % 3);
                const int from = place[idx(a)], to = place[idx(b)];
                if (from == to || (shared[idx(from)] == 0 && shared[idx(to)] == 0)) continue;
                const bool forward = from < to;
                halves_.push_back({std::min(from, to), std::max(from, to), static_cast<int>(t), k, forward, proper,
                                   forward ? a : b, forward ? b : a});
            }
        }
        std::sort(halves_.begin(), halves_.end(), [](const Half& a, const Half& b) {
            return std::tuple(a.low, a.high, a.triangle, a.corner) < std::tuple(b.low, b.high, b.triangle, b.corner);
        });
        for (std::size_t i = 0; i < halves_.size(); ++i)
            if (i == 0 || halves_[i].low != halves_[i - 1].low || halves_[i].high != halves_[i - 1].high)
                first_.push_back(i);
        first_.push_back(halves_.size());
    }

    std::size_t size() const { return first_.size() - 1; }

    // Appends the pairs of edge e whose partners are certain while vertices with equal roots are one; tells whether
    // more edges could be paired later.
    template <typename Root>
    bool pair(std::size_t e, const Root& root, std::vector<SeamEdge>& pairs) const {
        constexpr std::size_t most = 256; // halves on one edge: nobody means so many sheets
        if (first_[e + 1] - first_[e] > most) return false;
        std::vector<const Half*> open[2];
        for (std::size_t i = first_[e]; i < first_[e + 1]; ++i) {
            const Half& half = halves_[i];
            if (!half.proper) continue;
            const auto same = [&](const Half& other) {
                return root(half.at_low) == root(other.at_low) && root(half.at_high) == root(other.at_high);
            };
            const auto uses = std::count_if(halves_.begin() + std::ptrdiff_t(first_[e]),
                                            halves_.begin() + std::ptrdiff_t(first_[e + 1]), same);
            if (uses == 1) open[half.forward ? 0 : 1].push_back(&half);
        }
        if (open[0].empty() || open[1].empty()) return false;
        const auto partner = [&](const Half* half, const std::vector<const Half*>& others) -> const Half* {
            const Half* found = nullptr;
            for (const Half* other : others) {
                if (back_to_back(half->triangle, other->triangle)) continue;
                if (found != nullptr) return nullptr;
                found = other;
            }
            return found;
        };
        const std::size_t before = pairs.size();
        for (const Half* half : open[0])
            if (const Half* other = partner(half, open[1]); other != nullptr && partner(other, open[0]) == half)
                pairs.push_back({{half->triangle, other->triangle}, {half->corner, other->corner}});
        const std::size_t paired = pairs.size() - before;
        return open[0].size() > paired && open[1].size() > paired;
    }

private:
    std::array<int, 3> places(int t) const {
        return {place_[idx(triangles_(t, 0))], place_[idx(triangles_(t, 1))], place_[idx(triangles_(t, 2))]};
    }
    // One triangle and its other side: a leaf with a front and a back is not joined at its rim.
    bool back_to_back(int t, int u) const {
        std::array<int, 3> a = places(t), b = places(u);
        std::sort(a.begin(), a.end());
        std::sort(b.begin(), b.end());
        return a == b;
    }

    const Triangles& triangles_;
    const std::vector<int>& place_;
    std::vector<Half> halves_;
    std::vector<std::size_t> first_; // a place edge: its first half-edge
};

// All that pair up, in rounds: what was paired in one is certain in the next.
std::vector<SeamEdge> paired_edges(const Triangles& triangles, const std::vector<int>& place,
                                   const std::vector<char>& shared) {
    const PlaceEdges edges(triangles, place, shared);
    Classes classes(place.size());
    std::vector<SeamEdge> all;
    std::vector<std::size_t> waiting(edges.size());
    std::iota(waiting.begin(), waiting.end(), std::size_t{0});
    while (!waiting.empty()) {
        std::vector<SeamEdge> pairs;
        std::vector<std::size_t> later;
        for (const std::size_t e : waiting)
            if (edges.pair(
                    e, [&](int i) { return classes.root(i); }, pairs))
                later.push_back(e);
        if (pairs.empty()) break;
        for (const SeamEdge& edge : pairs) classes.join(triangles, edge);
        all.insert(all.end(), pairs.begin(), pairs.end());
        waiting = std::move(later);
    }
    return all;
}

// Lines, points and vertices of no face that hang together with no triangle belong to the surface in their place, where
// there is one.
void join_loose(const Triangles& triangles, const std::vector<int>& place, const std::vector<char>& shared,
                Classes& classes) {
    std::vector<char> proper(place.size(), 0), loose(place.size(), 1);
    const auto each = [&](bool of_proper, const auto& visit) {
        for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
            const int a = place[idx(triangles(t, 0))], b = place[idx(triangles(t, 1))], c = place[idx(triangles(t, 2))];
            if ((a != b && b != c && c != a) == of_proper) visit(t);
        }
    };
    each(true, [&](Eigen::Index t) {
        for (int k = 0; k < 3; ++k) proper[idx(triangles(t, k))] = 1, loose[idx(triangles(t, k))] = 0;
    });
    each(false, [&](Eigen::Index t) {
        if (std::any_of(triangles.row(t).begin(), triangles.row(t).end(), [&](int v) { return proper[idx(v)] != 0; }))
            for (int k = 0; k < 3; ++k) loose[idx(triangles(t, k))] = 0;
    });
    std::vector<int> only(place.size(), -1); // a place: the root of its surface; -2: there are several
    for (std::size_t i = 0; i < place.size(); ++i)
        if (proper[i] != 0) {
            const int root = classes.root(static_cast<int>(i));
            int& here = only[idx(place[i])];
            here = here == -1 || here == root ? root : -2;
        }
    for (std::size_t i = 0; i < place.size(); ++i)
        if (shared[idx(place[i])] != 0 && loose[i] != 0 && only[idx(place[i])] >= 0)
            classes.join(static_cast<int>(i), only[idx(place[i])]);
}

// Numbers in order of their first vertices, and who is in company.
void number(Weld& result, const Triangles& triangles, const std::vector<int>& place, const Classes& classes) {
    const std::size_t n = place.size();
    std::vector<int> vertex(n), size;
    for (std::size_t i = 0; i < n; ++i) {
        const int root = classes.root(static_cast<int>(i)); // the first of its class
        if (root == static_cast<int>(i)) {
            vertex[i] = static_cast<int>(result.first.size());
            result.first.push_back(root);
            size.push_back(0);
        } else {
            vertex[i] = vertex[idx(root)];
        }
        ++size[idx(vertex[i])];
    }
    std::vector<char> used(n, 0);
    for (const int v : triangles.reshaped()) used[idx(v)] = 1;
    std::vector<int> one(n, -1); // a place: the class of its used vertices; -2: there are several
    for (std::size_t i = 0; i < n; ++i)
        if (used[i] != 0) {
            int& here = one[idx(place[i])];
            here = here == -1 || here == vertex[i] ? vertex[i] : -2;
        }
    for (std::size_t i = 0; i < n; ++i) {
        if (size[idx(vertex[i])] > 1) result.on_seam.push_back(static_cast<int>(i));
        if (used[i] != 0 && one[idx(place[i])] == -2) result.touching.push_back(static_cast<int>(i));
    }
    if (result.first.size() == n) {
        result.first.clear();
        return;
    }
    result.triangles.resize(triangles.rows(), 3);
    parallel_for(triangles.rows(), [&](Eigen::Index t) {
        for (int k = 0; k < 3; ++k) result.triangles(t, k) = vertex[idx(triangles(t, k))];
    });
    result.vertex = std::move(vertex);
}

} // namespace

Weld weld(const Mesh& mesh, const std::vector<const Points*>& given, const CornerAttributes& file) {
    const std::vector<const Points*> shapes = given.empty() ? std::vector{&mesh.positions} : given;
    Weld result;
    const auto n = static_cast<int>(shapes.front()->rows());
    if (mesh.triangles.rows() == 0 || mesh.triangles.minCoeff() < 0 || mesh.triangles.maxCoeff() >= n) return result;
    const std::vector<int> place = places_of(mesh.triangles, shapes);
    std::vector<char> shared(place.size(), 0); // a place: it has several vertices
    bool any = false;
    for (std::size_t i = 0; i < place.size(); ++i)
        if (place[i] != static_cast<int>(i)) shared[idx(place[i])] = 1, any = true;
    if (!any) return result;
    const std::vector<SeamEdge> pairs = paired_edges(mesh.triangles, place, shared);
    const std::vector<char> slit = slit_edges(mesh, *shapes.front(), place, pairs, file);
    Classes classes(place.size());
    for (std::size_t e = 0; e < pairs.size(); ++e) {
        if (slit[e] == 0) {
            classes.join(mesh.triangles, pairs[e]);
            ++result.seam_edges;
            continue;
        }
        for (int side = 0; side < 2; ++side)
            for (int end = 0; end < 2; ++end) result.left_open.push_back(pairs[e].vertex(mesh.triangles, side, end));
    }
    std::sort(result.left_open.begin(), result.left_open.end());
    result.left_open.erase(std::unique(result.left_open.begin(), result.left_open.end()), result.left_open.end());
    join_loose(mesh.triangles, place, shared, classes);
    number(result, mesh.triangles, place, classes);
    return result;
}

Points Weld::reduced(const Points& x) const {
    if (!any()) return x;
    Points result(std::ssize(first), 3);
    parallel_for(result.rows(), [&](Eigen::Index i) { result.row(i) = x.row(first[idx(i)]); });
    return result;
}

Points Weld::expanded(const Points& x) const {
    if (!any()) return x;
    Points result(std::ssize(vertex), 3);
    parallel_for(result.rows(), [&](Eigen::Index i) { result.row(i) = x.row(vertex[idx(i)]); });
    return result;
}

Triangles Weld::by_first() const {
    Triangles result(triangles.rows(), 3);
    parallel_for(result.rows(), [&](Eigen::Index t) {
        for (int k = 0; k < 3; ++k) result(t, k) = first[idx(triangles(t, k))];
    });
    return result;
}

std::vector<int> Weld::files_vertices(const std::vector<int>& welded) const {
    if (!any()) return welded;
    std::vector<char> wanted(first.size(), 0);
    for (const int v : welded) wanted[idx(v)] = 1;
    std::vector<int> result;
    for (std::size_t i = 0; i < vertex.size(); ++i)
        if (wanted[idx(vertex[i])] != 0) result.push_back(static_cast<int>(i));
    return result;
}

Mesh welded(const Mesh& mesh, const Weld& weld) {
    if (!weld.any()) return mesh;
    Mesh result;
    result.positions = weld.reduced(mesh.positions);
    result.triangles = weld.triangles;
    result.texcoords = mesh.texcoords;
    result.texcoord_triangles = mesh.texcoord_triangles;
    if (mesh.colors.rows() > 0) result.colors = mesh.colors(weld.first, Eigen::all);
    return result;
}

Points vertex_normals(const Points& positions, const Triangles& triangles, const Weld& weld) {
    if (!weld.any()) return vertex_normals(positions, triangles);
    return weld.expanded(vertex_normals(weld.reduced(positions), weld.triangles));
}

} // namespace meshtween
