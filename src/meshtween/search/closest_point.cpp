// The wide searches behind the public class: the hint first, then the tree.
#include "meshtween/search/closest_point.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/search/visiting_order.h"
#include "meshtween/search/wide_build.h"

#include <fmt/format.h>

#include <cmath>

namespace meshtween {
namespace {

void check(const Points& positions, const Triangles& triangles) {
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
}

} // namespace

struct ClosestPointIndex::Data {
    Points positions;
    Triangles triangles;
    Points normals;
    search::WideTree tree;

    search::WideView view() const;
    ClosestPoint search(const Point& query, const Compatible& compatible, double bound, int hint) const;
};

search::WideView ClosestPointIndex::Data::view() const {
    const auto rows = [](const auto* data) {
        using Row = std::remove_pointer_t<decltype(data)>[3];
        return reinterpret_cast<Row*>(data);
    };
    return {tree.nodes.data(),
            tree.blocks.data(),
            tree.neighbourhoods.data(),
            tree.home.data(),
            {tree.origin[0], tree.origin[1], tree.origin[2]},
            tree.scale,
            rows(positions.data()),
            rows(triangles.data()),
            rows(normals.data())};
}

ClosestPoint ClosestPointIndex::Data::search(const Point& query, const Compatible& compatible, double bound,
                                             int hint) const {
    if (!query.allFinite()) return {};
    const search::WideView seen = view();
    const Point& n = compatible.normal;
    search::WideQuery asked{
        {query[0], query[1], query[2]}, {n[0], n[1], n[2]}, compatible.least_cosine, !n.isZero(0), bound, -1, 0, 0};
    if (hint >= 0 && hint < triangles.rows() && agrees(seen, asked, hint)) settle(seen, asked, hint);
    constexpr double far_away = 64; // times the mesh's size
    if ((query - tree.origin).cwiseAbs().maxCoeff() * tree.scale > far_away)
        search_far(seen, asked);
    else
        search::current_search()(seen, asked);
    if (asked.triangle < 0) return {};
    ClosestPoint answer;
    answer.squared_distance = asked.squared_distance;
    answer.where = {asked.triangle, {1 - asked.v - asked.w, asked.v, asked.w}};
    answer.position = position(positions, triangles, answer.where);
    return answer;
}

ClosestPointIndex::ClosestPointIndex(const Points& positions, const Triangles& triangles, MeshIs mesh)
    : data_(std::make_unique<Data>()) {
    check(positions, triangles);
    data_->positions = positions;
    data_->triangles = triangles;
    data_->normals = triangle_normals(positions, triangles);
    data_->tree = search::wide_tree(positions, triangles, mesh);
}

void ClosestPointIndex::move(const Points& positions) {
    if (positions.rows() != data_->positions.rows())
        throw Error(ErrorKind::argument, fmt::format("{} vertices moved to {} places: give as many",
                                                     data_->positions.rows(), positions.rows()));
    check(positions, data_->triangles);
    data_->positions = positions;
    data_->normals = triangle_normals(positions, data_->triangles);
    search::refit(data_->tree, positions, data_->triangles);
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
    const std::vector<int> order = search::visiting_order(queries);
    constexpr Eigen::Index block = 256;
    parallel_for((queries.rows() + block - 1) / block,
                 [&](Eigen::Index b) {
                     int last = -1; // the answer to the query before is a hint for the next
                     for (Eigen::Index i = b * block; i < std::min(queries.rows(), (b + 1) * block); ++i) {
                         const auto q =
                             static_cast<std::size_t>(order.empty() ? i : order[static_cast<std::size_t>(i)]);
                         const int hint = hints.empty() || hints[q] < 0 ? last : hints[q];
                         answers[q] = closest(Point(queries.row(static_cast<Eigen::Index>(q))), hint);
                         last = answers[q].where.triangle;
                     }
                 },
                 1);
    return answers;
}

const Points& ClosestPointIndex::normals() const {
    return data_->normals;
}

} // namespace meshtween
