// Botsch and Kobbelt 2004, "A remeshing approach to multiresolution modeling", with the edge lengths of Dunyach et al.
// 2013, "Adaptive remeshing for real-time mesh deformation": L = sqrt(6 e / k - 3 e^2) for deviation e, curvature k.
#include "meshtween/geometry/remesh.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/halfedges.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

std::size_t at(int i) {
    return static_cast<std::size_t>(i);
}

class Remesher {
public:
    Remesher(const Mesh& mesh, const Field& field, const RemeshOptions& options)
        : s_(halfedges(mesh)), field_(field), options_(options) {}

    Mesh run() {
        for (int round = 0; round < options_.rounds; ++round) {
            size();
            split_long();
            collapse_short();
            turn_edges();
            settle(0.6);
        }
        settle(0.6);
        turn_edges();
        settle(0.5, true);
        return compact(s_);
    }

private:
    double length(int h) const { return (s_.at(s_.origin(h)) - s_.at(s_.to(h))).norm(); }
    double wanted(int h) const { return (size_[at(s_.origin(h))] + size_[at(s_.to(h))]) / 2; }

    // Edge length wanted at each vertex, from the turn of the normal along its edges.
    void size() {
        const auto count = static_cast<std::ptrdiff_t>(s_.points.size());
        std::vector<Point> normal(s_.points.size(), Point(0, 0, 0));
        parallel_for(
            count,
            [&](std::ptrdiff_t v) {
                const auto i = static_cast<std::size_t>(v);
                if (s_.out[i] >= 0) normal[i] = gradient(field_, s_.points[i], options_.shortest / 4).normalized();
            },
            64);
        const double e = options_.deviation;
        size_.assign(s_.points.size(), options_.longest);
        for (std::size_t v = 0; v < s_.points.size(); ++v) {
            if (s_.out[v] < 0) continue;
            double curvature = 1e-9;
            s_.around(static_cast<int>(v), [&](int h) {
                const auto w = at(s_.to(h));
                curvature =
                    std::max(curvature, (normal[v] - normal[w]).norm() / std::max(length(h), options_.shortest));
            });
            size_[v] = std::clamp(std::sqrt(std::max(6 * e / curvature - 3 * e * e, 0.0)), options_.shortest,
                                  options_.longest);
        }
        for (int sweep = 0; sweep < 4; ++sweep)
            for (int h = 0; h < s_.count(); ++h)
                if (s_.alive(h)) {
                    double& here = size_[at(s_.origin(h))];
                    here = std::min(here, size_[at(s_.to(h))] + options_.growth * length(h));
                }
    }

    void split_long() {
        // Only edges that were there before: the fans that a split leaves would be split without end.
        for (int h = 0, end = s_.count(); h < end; ++h) {
            if (!s_.alive(h) || length(h) <= 4.0 / 3 * wanted(h)) continue;
            const double middle_size = wanted(h);
            s_.split(h, (s_.at(s_.origin(h)) + s_.at(s_.to(h))) / 2);
            size_.push_back(middle_size);
        }
    }

    void collapse_short() {
        for (int h = 0; h < s_.count(); ++h)
            if (s_.alive(h) && length(h) < 4.0 / 5 * wanted(h) && collapse_is_fair(h) && s_.may_collapse(h))
                s_.collapse(h);
    }

    // No edge grows too long and no triangle turns over when the vertex from[h] moves onto to(h).
    bool collapse_is_fair(int h) const {
        const int a = s_.origin(h), b = s_.to(h);
        const Point target = s_.at(b);
        bool fair = true;
        s_.around(a, [&](int g) {
            const int v = s_.to(g), w = s_.opposite(g);
            if (v != b && (s_.at(v) - target).norm() > 4.0 / 3 * (size_[at(v)] + size_[at(b)]) / 2) fair = false;
            if (v == b || w == b) return;
            const Point edge = s_.at(w) - s_.at(v);
            const Point before = edge.cross(s_.at(a) - s_.at(v)), after = edge.cross(target - s_.at(v));
            if (before.dot(after) < 0.5 * before.norm() * after.norm() || after.norm() < 0.1 * edge.squaredNorm())
                fair = false;
        });
        return fair;
    }

    // Turns edges where that brings valences nearer to six and neither folds nor makes a sliver.
    void turn_edges() {
        std::vector<int> valence(s_.points.size(), 0);
        for (int h = 0; h < s_.count(); ++h)
            if (s_.alive(h)) ++valence[at(s_.origin(h))];
        for (int h = 0; h < s_.count(); ++h) {
            if (!s_.alive(h) || s_.other(h) < h) continue;
            const int a = s_.origin(h), b = s_.to(h), c = s_.opposite(h), d = s_.opposite(s_.other(h));
            const auto off = [&](int v, int change) { return std::abs(valence[at(v)] + change - 6); };
            const int before = off(a, 0) + off(b, 0) + off(c, 0) + off(d, 0);
            const int after = off(a, -1) + off(b, -1) + off(c, 1) + off(d, 1);
            if (after >= before || valence[at(a)] <= 3 || valence[at(b)] <= 3 || !turn_is_fair(a, b, c, d) ||
                s_.neighbours(c, d))
                continue;
            s_.flip(h);
            --valence[at(a)], --valence[at(b)], ++valence[at(c)], ++valence[at(d)];
        }
    }

    bool turn_is_fair(int a, int b, int c, int d) const {
        const Point pa = s_.at(a), pb = s_.at(b), pc = s_.at(c), pd = s_.at(d);
        const Point n1 = (pb - pa).cross(pc - pa), n2 = (pa - pb).cross(pd - pb); // now
        const Point m1 = (pa - pc).cross(pd - pc), m2 = (pb - pd).cross(pc - pd); // turned
        const Point n = n1.normalized() + n2.normalized();
        const double longest = (pc - pd).squaredNorm();
        return m1.dot(n) > 0.7 * n.norm() * m1.norm() && m2.dot(n) > 0.7 * n.norm() * m2.norm() &&
               m1.norm() > 0.15 * longest && m2.norm() > 0.15 * longest;
    }

    // Moves each vertex by this part of the way to its neighbours' middle, along the surface, and back onto it.
    void settle(double part, bool last = false) {
        const double step = options_.shortest / 4;
        std::vector<Point> moved = s_.points;
        parallel_for(
            static_cast<std::ptrdiff_t>(s_.points.size()),
            [&](std::ptrdiff_t v) {
                const auto i = static_cast<std::size_t>(v);
                if (s_.out[i] < 0) return;
                Point& p = moved[i];
                Point middle(0, 0, 0), normal(0, 0, 0);
                double weights = 0;
                s_.around(static_cast<int>(v), [&](int h) {
                    const Point &q = s_.at(s_.to(h)), &r = s_.at(s_.opposite(h));
                    const Point n = (q - s_.points[i]).cross(r - s_.points[i]);
                    normal += n;
                    const double weight = std::sqrt(n.norm());
                    middle += weight * (s_.points[i] + q + r) / 3, weights += weight;
                });
                normal.normalize();
                const Point way = middle / weights - s_.points[i];
                p += part * (way - way.dot(normal) * normal);
                p = onto_surface(field_, p, step, last ? 3 : 1);
            },
            64);
        s_.points = std::move(moved);
    }

    Halfedges s_;
    const Field& field_;
    RemeshOptions options_;
    std::vector<double> size_;
};

} // namespace

Mesh remesh(const Mesh& mesh, const Field& field, const RemeshOptions& options) {
    return Remesher(mesh, field, options).run();
}

} // namespace meshtween
