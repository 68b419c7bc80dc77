// A tree of boxes over the triangles, searched from the nearer child on.
#include "meshtween/search/closest_point.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/search/triangle_distance.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numeric>

namespace meshtween {
namespace {

using Box = Eigen::AlignedBox3d;

struct Node {
    Box box;
    int first = 0; // of its triangles in the order, or its left child (the right one follows)
    int count = 0; // of triangles; 0 for an inner node
};

constexpr int leaf_size = 4;

double squared_distance(const Box& box, const Point& query) {
    const Eigen::Vector3d outside =
        (box.min() - query.transpose()).cwiseMax(query.transpose() - box.max()).cwiseMax(0.0);
    return outside.squaredNorm();
}

} // namespace

struct ClosestPointIndex::Data {
    Points positions;
    Triangles triangles;
    Points normals;
    std::vector<Node> nodes;
    std::vector<int> order;

    void build();
    void split(int node, int begin, int end, const Points& centres);
    ClosestPoint search(const Point& query, const Compatible& compatible, double bound, int hint) const;
};

void ClosestPointIndex::Data::split(int node, int begin, int end, const Points& centres) {
    Box box, middle;
    for (int i = begin; i < end; ++i) {
        const int t = order[static_cast<std::size_t>(i)];
        for (int k = 0; k < 3; ++k) box.extend(positions.row(triangles(t, k)).transpose());
        middle.extend(centres.row(t).transpose());
    }
    nodes[static_cast<std::size_t>(node)].box = box;
    if (end - begin <= leaf_size) {
        nodes[static_cast<std::size_t>(node)].first = begin;
        nodes[static_cast<std::size_t>(node)].count = end - begin;
        return;
    }
    int axis = 0;
    middle.sizes().maxCoeff(&axis);
    const int half = (begin + end) / 2;
    std::nth_element(order.begin() + begin, order.begin() + half, order.begin() + end, [&](int s, int t) {
        return centres(s, axis) != centres(t, axis) ? centres(s, axis) < centres(t, axis) : s < t;
    });
    const int left = static_cast<int>(nodes.size());
    nodes[static_cast<std::size_t>(node)].first = left;
    nodes.resize(nodes.size() + 2);
    split(left, begin, half, centres);
    split(left + 1, half, end, centres);
}

void ClosestPointIndex::Data::build() {
    if (triangles.rows() == 0)
        throw Error(ErrorKind::computation, "a mesh without triangles has no closest point: give one with faces");
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const int v = triangles(t, k);
            if (v < 0 || v >= positions.rows())
                throw Error(ErrorKind::computation,
                            fmt::format("triangle {} names vertex {}, but there are {}", t, v, positions.rows()));
            if (!positions.row(v).allFinite())
                throw Error(ErrorKind::computation, fmt::format("vertex {} has a coordinate that is not finite", v));
        }
    normals = triangle_normals(positions, triangles);
    Points centres(triangles.rows(), 3);
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
        centres.row(t) =
            (positions.row(triangles(t, 0)) + positions.row(triangles(t, 1)) + positions.row(triangles(t, 2))) / 3;
    order.resize(static_cast<std::size_t>(triangles.rows()));
    std::iota(order.begin(), order.end(), 0);
    nodes.resize(1);
    split(0, 0, static_cast<int>(order.size()), centres);
}

ClosestPoint ClosestPointIndex::Data::search(const Point& query, const Compatible& compatible, double bound,
                                             int hint) const {
    const bool any = compatible.normal.isZero(0);
    ClosestPoint best;
    best.squared_distance = bound;
    const auto visit = [&](int t) {
        if (!any && normals.row(t).dot(compatible.normal) < compatible.least_cosine) return;
        const auto found = search::closest_on_triangle(query, positions.row(triangles(t, 0)),
                                                       positions.row(triangles(t, 1)), positions.row(triangles(t, 2)));
        const double d = found.squared_distance;
        // Of triangles equally close the first one answers, whatever the hint and the tree.
        if (d < best.squared_distance || (d == best.squared_distance && (!best.found() || t < best.where.triangle))) {
            best.squared_distance = d;
            best.where = {t, {1 - found.v - found.w, found.v, found.w}};
        }
    };
    if (hint >= 0 && hint < triangles.rows()) visit(hint);
    struct Waiting {
        int node;
        double distance;
    };
    std::array<Waiting, 128> stack; // the halving tree is at most 32 deep
    int top = 0;
    stack[static_cast<std::size_t>(top++)] = {0, squared_distance(nodes[0].box, query)};
    while (top > 0) {
        const Waiting here = stack[static_cast<std::size_t>(--top)];
        // The box's distance and the triangle's differ by rounding, and equal distances are to be seen.
        if (!(here.distance <= best.squared_distance * (1 + 1e-12))) continue;
        const Node& node = nodes[static_cast<std::size_t>(here.node)];
        if (node.count > 0) {
            for (int i = node.first; i < node.first + node.count; ++i) visit(order[static_cast<std::size_t>(i)]);
            continue;
        }
        Waiting near{node.first, squared_distance(nodes[static_cast<std::size_t>(node.first)].box, query)};
        Waiting far{node.first + 1, squared_distance(nodes[static_cast<std::size_t>(node.first + 1)].box, query)};
        if (far.distance < near.distance) std::swap(near, far);
        stack[static_cast<std::size_t>(top++)] = far;
        stack[static_cast<std::size_t>(top++)] = near;
    }
    if (!best.found()) return {};
    best.position = position(positions, triangles, best.where);
    return best;
}

ClosestPointIndex::ClosestPointIndex(const Points& positions, const Triangles& triangles)
    : data_(std::make_unique<Data>()) {
    data_->positions = positions;
    data_->triangles = triangles;
    data_->build();
}
ClosestPointIndex::~ClosestPointIndex() = default;
ClosestPointIndex::ClosestPointIndex(ClosestPointIndex&&) noexcept = default;
ClosestPointIndex& ClosestPointIndex::operator=(ClosestPointIndex&&) noexcept = default;

ClosestPoint ClosestPointIndex::closest(const Point& query, int hint) const {
    return data_->search(query, {}, std::numeric_limits<double>::infinity(), hint);
}

ClosestPoint ClosestPointIndex::closest(const Point& query, const Compatible& compatible, double max_distance,
                                        int hint) const {
    return data_->search(query, compatible, max_distance * max_distance, hint);
}

std::vector<ClosestPoint> ClosestPointIndex::closest_of_each(const Points& queries, std::span<const int> hints) const {
    std::vector<ClosestPoint> answers(static_cast<std::size_t>(queries.rows()));
    parallel_for(
        queries.rows(),
        [&](Eigen::Index i) {
            const auto k = static_cast<std::size_t>(i);
            answers[k] = closest(Point(queries.row(i)), hints.empty() ? -1 : hints[k]);
        },
        256);
    return answers;
}

const Points& ClosestPointIndex::normals() const {
    return data_->normals;
}

} // namespace meshtween
