#include "meshtween/geometry/slits.h"

#include "meshtween/geometry/measure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

const double folded = std::cos(20 * std::numbers::pi / 180);     // between faces: a sharp edge may be here
const double same_normal = std::cos(2 * std::numbers::pi / 180); // no more apart: equal, or what a side alone has

class Sets {
public:
    explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }
    int root(int i) {
        while (parent_[idx(i)] != i) i = parent_[idx(i)] = parent_[idx(parent_[idx(i)])];
        return i;
    }
    void join(int a, int b) {
        a = root(a), b = root(b);
        parent_[idx(std::max(a, b))] = std::min(a, b);
    }

private:
    std::vector<int> parent_;
};

using Texcoord = Eigen::RowVector2f;

class Judge {
public:
    Judge(const Mesh& mesh, const Points& positions, const std::vector<SeamEdge>& edges, const CornerAttributes& file)
        : mesh_(mesh), positions_(positions), file_(file) {
        if (!file.normal) return;
        own_ = Points::Zero(positions.rows(), 3);
        std::vector<char> wanted(idx(positions.rows()), 0);
        for (const SeamEdge& edge : edges)
            for (int side = 0; side < 2; ++side)
                for (int end = 0; end < 2; ++end) wanted[idx(edge.vertex(mesh.triangles, side, end))] = 1;
        for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
            for (int k = 0; k < 3; ++k)
                if (wanted[idx(mesh.triangles(t, k))] != 0)
                    own_.row(mesh.triangles(t, k)) += double_area_normal(positions, mesh.triangles, t);
    }

    // Nothing the file says changes from one side to the other, but perhaps the normals.
    bool goes_on(const SeamEdge& edge) const {
        if (handed(edge.triangle[0]) != handed(edge.triangle[1])) return false; // mirrored: tangents turn over
        for (int end = 0; end < 2; ++end) {
            const int t = edge.triangle[0], u = edge.triangle[1], k = edge.corner_at(0, end),
                      l = edge.corner_at(1, end);
            if (texcoord(t, k) != texcoord(u, l)) return false;
            const int a = mesh_.triangles(t, k), b = mesh_.triangles(u, l);
            if (mesh_.colors.rows() == mesh_.positions.rows() && mesh_.colors.row(a) != mesh_.colors.row(b))
                return false;
            if (file_.agree && !file_.agree(t, k, u, l)) return false;
        }
        return true;
    }

    // The normals were made for one surface, or split for a sharp edge of it.
    bool normals_tell_of_one(const SeamEdge& edge) const {
        if (!file_.normal) return false;
        for (int end = 0; end < 2; ++end) {
            const int t = edge.triangle[0], u = edge.triangle[1], k = edge.corner_at(0, end),
                      l = edge.corner_at(1, end);
            const int a = mesh_.triangles(t, k), b = mesh_.triangles(u, l);
            if (a == b) continue; // an end of the line
            const Point n = file_.normal(t, k), m = file_.normal(u, l);
            if (!(n.squaredNorm() > 0) || !(m.squaredNorm() > 0)) continue;
            if (alike(n, m, same_normal)) {
                if (!alike(own_.row(a), own_.row(b), same_normal)) return true;
            } else if (!alike(double_area_normal(positions_, mesh_.triangles, t),
                              double_area_normal(positions_, mesh_.triangles, u), folded)) {
                return true;
            }
        }
        return false;
    }

    Texcoord texcoord(int t, int k) const { return mesh_.texcoords.row(mesh_.texcoord_triangles(t, k)); }

private:
    static bool alike(const Point& a, const Point& b, double least_cosine) {
        return a.dot(b) >= least_cosine * a.norm() * b.norm();
    }
    int handed(int t) const { // which way round the triangle lies in the texture
        const Texcoord e = texcoord(t, 1) - texcoord(t, 0), f = texcoord(t, 2) - texcoord(t, 0);
        const float area = e[0] * f[1] - e[1] * f[0];
        return (area > 0) - (area < 0);
    }

    const Mesh& mesh_;
    const Points& positions_;
    const CornerAttributes& file_;
    Points own_; // a vertex: the normal of its own triangles, any length
};

} // namespace

std::vector<char> slit_edges(const Mesh& mesh, const Points& positions, const std::vector<int>& place,
                             const std::vector<SeamEdge>& edges, const CornerAttributes& file) {
    std::vector<char> slit(edges.size(), 0);
    if (edges.empty() || mesh.texcoords.rows() == 0) return slit;
    const Judge judge(mesh, positions, edges, file);
    Sets lines(place.size()); // places along edges that go on
    bool any = false;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        slit[e] = judge.goes_on(edges[e]) ? 1 : 0;
        any = any || slit[e] != 0;
        if (slit[e] != 0)
            lines.join(place[idx(edges[e].vertex(mesh.triangles, 0, 0))],
                       place[idx(edges[e].vertex(mesh.triangles, 0, 1))]);
    }
    if (!any) return slit;
    Sets parts(place.size()); // of the file's numbering
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 1; k < 3; ++k) parts.join(mesh.triangles(t, 0), mesh.triangles(t, k));
    std::vector<char> reason(place.size(), 0), varied(place.size(), 0); // a line
    const auto line_of = [&](const SeamEdge& edge) {
        return idx(lines.root(place[idx(edge.vertex(mesh.triangles, 0, 0))]));
    };
    for (std::size_t e = 0; e < edges.size(); ++e) {
        if (slit[e] == 0) continue;
        const SeamEdge& edge = edges[e];
        const std::size_t line = line_of(edge);
        if (parts.root(edge.vertex(mesh.triangles, 0, 0)) != parts.root(edge.vertex(mesh.triangles, 1, 0)) ||
            judge.normals_tell_of_one(edge))
            reason[line] = 1;
        if (judge.texcoord(edge.triangle[0], edge.corner_at(0, 0)) !=
            judge.texcoord(edge.triangle[0], edge.corner_at(0, 1)))
            varied[line] = 1;
    }
    for (std::size_t e = 0; e < edges.size(); ++e)
        if (slit[e] != 0 && (reason[line_of(edges[e])] != 0 || varied[line_of(edges[e])] == 0)) slit[e] = 0;
    return slit;
}

} // namespace meshtween
