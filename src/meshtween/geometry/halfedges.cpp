// The three operators of Hoppe et al. 1993, "Mesh optimization", with their link condition.
#include "meshtween/geometry/halfedges.h"

#include <array>
#include <cassert>

namespace meshtween {
namespace {
std::size_t slot(int i) {
    return static_cast<std::size_t>(i);
}
} // namespace

int Halfedges::valence(int vertex) const {
    int count = 0;
    around(vertex, [&](int) { ++count; });
    return count;
}

bool Halfedges::neighbours(int a, int b) const {
    bool found = false;
    around(a, [&](int h) { found = found || to(h) == b; });
    return found;
}

void Halfedges::flip(int h) {
    const int n = next(h), p = previous(h), t = other(h), tn = next(t), tp = previous(t);
    const int a = origin(h), b = origin(t), c = origin(p), d = origin(tp);
    const int bc = other(n), ca = other(p), ad = other(tn), db = other(tp);
    const auto glue = [&](int x, int y) { twin[slot(x)] = y, twin[slot(y)] = x; };
    from[slot(h)] = d, from[slot(n)] = c, from[slot(p)] = a;   // d -> c -> a
    from[slot(t)] = c, from[slot(tn)] = d, from[slot(tp)] = b; // c -> d -> b
    glue(n, ca), glue(p, ad), glue(tn, db), glue(tp, bc);
    out[slot(a)] = p, out[slot(b)] = tp, out[slot(c)] = n, out[slot(d)] = tn;
}

int Halfedges::split(int h, const Point& middle) {
    const int n = next(h), p = previous(h), t = other(h), tn = next(t), tp = previous(t);
    const int a = origin(h), b = origin(t), c = origin(p), d = origin(tp), m = static_cast<int>(points.size());
    const int bc = other(n), ad = other(tn), first = count();
    points.push_back(middle);
    from.resize(from.size() + 6), twin.resize(twin.size() + 6);
    const auto glue = [&](int x, int y) { twin[slot(x)] = y, twin[slot(y)] = x; };
    from[slot(n)] = m, from[slot(tn)] = m; // a -> m -> c and b -> m -> d
    const std::array<int, 6> corners{m, b, c, m, a, d};
    for (int i = 0; i < 6; ++i) from[slot(first + i)] = corners[slot(i)];
    glue(first + 1, bc), glue(first + 2, n), glue(first, t);
    glue(first + 4, ad), glue(first + 5, tn), glue(first + 3, h);
    out.push_back(n);
    out[slot(a)] = h, out[slot(b)] = t, out[slot(c)] = p, out[slot(d)] = tp;
    return m;
}

bool Halfedges::may_collapse(int h) const {
    const int a = origin(h), b = to(h), c = opposite(h), d = opposite(other(h));
    if (c == d || valence(c) <= 3 || valence(d) <= 3) return false;
    int common = 0;
    around(a, [&](int g) { common += to(g) != b && neighbours(b, to(g)); });
    return common == 2;
}

void Halfedges::collapse(int h) {
    const int n = next(h), p = previous(h), t = other(h), tn = next(t), tp = previous(t);
    const int a = origin(h), b = origin(t), c = origin(p), d = origin(tp);
    const int cb = other(n), ac = other(p), da = other(tn), bd = other(tp);
    std::vector<int> leaving;
    around(a, [&](int g) { leaving.push_back(g); });
    for (const int g : leaving) from[slot(g)] = b;
    const auto glue = [&](int x, int y) { twin[slot(x)] = y, twin[slot(y)] = x; };
    glue(cb, ac), glue(da, bd);
    out[slot(a)] = -1, out[slot(b)] = ac, out[slot(c)] = cb, out[slot(d)] = da;
    for (const int g : {h, n, p, t, tn, tp}) from[slot(g)] = -1;
}

Halfedges halfedges(const Mesh& mesh) {
    Halfedges surface;
    const auto vertices = static_cast<std::size_t>(mesh.positions.rows());
    const auto count = static_cast<std::size_t>(mesh.triangles.size());
    surface.points.resize(vertices);
    for (std::size_t v = 0; v < vertices; ++v) surface.points[v] = mesh.positions.row(static_cast<Eigen::Index>(v));
    surface.from.assign(mesh.triangles.data(), mesh.triangles.data() + count);
    surface.twin.assign(count, -1);
    surface.out.assign(vertices, -1);
    // The half-edges that leave each vertex, in one array.
    std::vector<int> first(vertices + 1, 0), leaving(count);
    for (const int v : surface.from) ++first[slot(v) + 1];
    for (std::size_t v = 0; v < vertices; ++v) first[v + 1] += first[v];
    std::vector<int> filled(first.begin(), first.end() - 1);
    for (int h = 0; h < surface.count(); ++h) {
        leaving[slot(filled[slot(surface.origin(h))]++)] = h;
        surface.out[slot(surface.origin(h))] = h;
    }
    for (int h = 0; h < surface.count(); ++h) {
        const std::size_t to = slot(surface.to(h));
        for (int i = first[to]; i < first[to + 1]; ++i)
            if (surface.to(leaving[slot(i)]) == surface.origin(h)) surface.twin[slot(h)] = leaving[slot(i)];
        assert(surface.twin[slot(h)] >= 0);
    }
    return surface;
}

Mesh compact(const Halfedges& surface) {
    std::vector<int> number(surface.points.size(), -1);
    int vertices = 0, triangles = 0;
    for (std::size_t v = 0; v < number.size(); ++v)
        if (surface.out[v] >= 0) number[v] = vertices++;
    for (int h = 0; h < surface.count(); h += 3) triangles += surface.alive(h);
    Mesh mesh;
    mesh.positions.resize(vertices, 3);
    mesh.triangles.resize(triangles, 3);
    for (std::size_t v = 0; v < number.size(); ++v)
        if (number[v] >= 0) mesh.positions.row(number[v]) = surface.points[v];
    int t = 0;
    for (int h = 0; h < surface.count(); h += 3)
        if (surface.alive(h)) {
            mesh.triangles.row(t++) << number[slot(surface.origin(h))], number[slot(surface.origin(h + 1))],
                number[slot(surface.origin(h + 2))];
        }
    return mesh;
}

} // namespace meshtween
