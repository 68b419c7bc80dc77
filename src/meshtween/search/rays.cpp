// Moeller, Trumbore: Fast, minimum storage ray/triangle intersection. Journal of Graphics Tools 1997.
#include "meshtween/search/rays.h"

#include "meshtween/search/box_tree.h"

#include <Eigen/Geometry>

#include <array>
#include <cmath>

namespace meshtween {

struct RayIndex::Data {
    const Points& positions;
    const Triangles& triangles;
    search::Frame frame;
    search::BoxTree tree;
};

namespace {

// How far along the ray the box is met, in the direction's lengths; infinity where it is not. A little before, so that
// floats lose nothing.
double entry(const search::FloatBox& box, const Point& origin, const Point& inverse) {
    double near = 0, far = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
        const double low = (static_cast<double>(box.low[k]) - origin[k]) * inverse[k],
                     high = (static_cast<double>(box.high[k]) - origin[k]) * inverse[k];
        near = std::fmax(near, std::fmin(low, high)); // a ray in the plane of a side says nothing: NaN
        far = std::fmin(far, std::fmax(low, high));
    }
    return near <= far ? near : std::numeric_limits<double>::infinity();
}

} // namespace

RayIndex::RayIndex(const Points& positions, const Triangles& triangles) {
    const search::Frame frame = search::frame(positions, triangles);
    data_.reset(new Data{positions, triangles, frame,
                         search::box_tree(search::triangle_boxes(positions, triangles, frame), 4)});
}
RayIndex::~RayIndex() = default;
RayIndex::RayIndex(RayIndex&&) noexcept = default;
RayIndex& RayIndex::operator=(RayIndex&&) noexcept = default;

RayHit RayIndex::first(const Point& origin, const Point& direction, double least) const {
    RayHit hit;
    const Data& d = *data_;
    if (d.tree.nodes.empty()) return hit;
    const Point from = d.frame.into(origin), inverse = (direction * d.frame.scale).cwiseInverse();
    const auto meet = [&](int t) {
        const Point a = d.positions.row(d.triangles(t, 0)), ab = Point(d.positions.row(d.triangles(t, 1))) - a,
                    ac = Point(d.positions.row(d.triangles(t, 2))) - a, p = direction.cross(ac);
        const double det = ab.dot(p);
        if (det == 0) return;
        const Point s = (origin - a) / det, q = s.cross(ab);
        const double u = s.dot(p), v = direction.dot(q), distance = ac.dot(q);
        if (u < 0 || v < 0 || u + v > 1 || distance <= least) return;
        if (distance < hit.distance || (distance == hit.distance && t < hit.triangle)) hit = {t, distance};
    };
    std::array<int, 2 * search::BoxTree::deepest> stack{};
    int top = 0;
    stack[0] = 0;
    while (top >= 0) {
        const search::BoxTree::Node& node =
            d.tree.nodes[static_cast<std::size_t>(stack[static_cast<std::size_t>(top--)])];
        const double met = entry(node.box, from, inverse);
        if (!std::isfinite(met) || met > hit.distance) continue;
        if (node.count > 0) {
            for (int i = 0; i < node.count; ++i) meet(d.tree.order[static_cast<std::size_t>(node.first + i)]);
            continue;
        }
        const auto box = [&](int child) { return d.tree.nodes[static_cast<std::size_t>(child)].box; };
        const bool second_nearer = entry(box(node.first + 1), from, inverse) < entry(box(node.first), from, inverse);
        stack[static_cast<std::size_t>(++top)] = node.first + (second_nearer ? 0 : 1);
        stack[static_cast<std::size_t>(++top)] = node.first + (second_nearer ? 1 : 0);
    }
    return hit;
}

} // namespace meshtween
