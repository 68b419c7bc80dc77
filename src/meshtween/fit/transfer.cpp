#include "meshtween/fit/transfer.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/seams.h"
#include "meshtween/search/closest_point.h"

#include <Eigen/LU>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// The chart of each triangle: triangles that share two texture coordinates are in one.
std::vector<int> charts(const Triangles& corners) {
    std::vector<int> parent(idx(corners.rows()));
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&](int t) {
        while (parent[idx(t)] != t) t = parent[idx(t)] = parent[idx(parent[idx(t)])];
        return t;
    };
    std::map<std::pair<int, int>, int> first; // an edge's triangle
    for (Eigen::Index t = 0; t < corners.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const auto edge = std::minmax(corners(t, k), corners(t, (k + 1) % 3));
            const auto [entry, fresh] = first.try_emplace({edge.first, edge.second}, static_cast<int>(t));
            if (!fresh) parent[idx(root(static_cast<int>(t)))] = root(entry->second);
        }
    for (Eigen::Index t = 0; t < corners.rows(); ++t) parent[idx(t)] = root(static_cast<int>(t));
    return parent;
}

using Texcoord = Eigen::RowVector2d;

Texcoord texcoord_at(const Mesh& mesh, int triangle, const Point& barycentric) {
    Texcoord sum(0, 0);
    for (int k = 0; k < 3; ++k)
        sum += barycentric[k] * mesh.texcoords.row(mesh.texcoord_triangles(triangle, k)).cast<double>();
    return sum;
}

// Texture coordinates as a linear function of space: those of one triangle, and beyond it.
struct Continued {
    Point origin{0, 0, 0};
    Texcoord at_origin{0, 0};
    Eigen::Matrix<double, 3, 2> slope = Eigen::Matrix<double, 3, 2>::Zero();
    Texcoord operator()(const Point& x) const { return at_origin + (x - origin) * slope; }
};

Continued continued(const Mesh& mesh, int t) {
    Continued c;
    c.origin = mesh.positions.row(mesh.triangles(t, 0));
    c.at_origin = texcoord_at(mesh, t, {1, 0, 0});
    Eigen::Matrix3d edges;
    edges.row(0) = Point(mesh.positions.row(mesh.triangles(t, 1))) - c.origin;
    edges.row(1) = Point(mesh.positions.row(mesh.triangles(t, 2))) - c.origin;
    const Point normal = double_area_normal(mesh.positions, mesh.triangles, t);
    if (!(normal.squaredNorm() > 0)) return c;
    edges.row(2) = normal / std::sqrt(normal.norm()); // constant along it
    Eigen::Matrix<double, 3, 2> rise = Eigen::Matrix<double, 3, 2>::Zero();
    rise.row(0) = texcoord_at(mesh, t, {0, 1, 0}) - c.at_origin;
    rise.row(1) = texcoord_at(mesh, t, {0, 0, 1}) - c.at_origin;
    c.slope = edges.inverse() * rise;
    return c;
}

// True where a corner's own texture coordinates go on from the centre's: the same chart, and no further from what the
// centre's triangle says than the triangle is large there. A chart that meets itself at a seam fails the second.
bool goes_on(const Texcoord& own, const Texcoord& centre, const Continued& chart, const Point& from, const Point& to) {
    constexpr double most = 3, slack = 1e-6;
    const double expected = ((to - from) * chart.slope).norm();
    return (own - centre).norm() <= most * expected + slack;
}

// Corners of one vertex with the same texture coordinates share them from here on.
void share_texcoords(Mesh& mesh) {
    const auto corner_count = 3 * mesh.triangles.rows();
    std::vector<Eigen::Index> order(idx(corner_count));
    std::iota(order.begin(), order.end(), Eigen::Index(0));
    const auto key = [&](Eigen::Index c) {
        return std::tuple(mesh.triangles(c / 3, c % 3), mesh.texcoords(c, 0), mesh.texcoords(c, 1));
    };
    std::sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return key(a) < key(b); });
    Texcoords kept(corner_count, 2);
    Eigen::Index count = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || key(order[i]) != key(order[i - 1])) kept.row(count++) = mesh.texcoords.row(order[i]);
        mesh.texcoord_triangles(order[i] / 3, order[i] % 3) = static_cast<int>(count - 1);
    }
    mesh.texcoords = kept.topRows(count);
}

// Where the file's numbering is cut, texture coordinates are too, also where they go on.
Triangles texcoord_corners(const Mesh& mesh) {
    const Weld found = seams(mesh);
    if (!found.any()) return mesh.texcoord_triangles;
    Mesh whole = welded(mesh, found);
    whole.texcoords.resize(3 * mesh.triangles.rows(), 2); // one a corner
    for (Eigen::Index c = 0; c < whole.texcoords.rows(); ++c)
        whole.texcoords.row(c) = mesh.texcoords.row(mesh.texcoord_triangles(c / 3, c % 3));
    share_texcoords(whole);
    return whole.texcoord_triangles;
}

void carry_texcoords(Mesh& receiver, const Mesh& giver, const std::vector<SurfacePoint>& places) {
    const std::vector<int> chart = charts(texcoord_corners(giver));
    Points centres(receiver.triangles.rows(), 3);
    for (Eigen::Index t = 0; t < centres.rows(); ++t)
        centres.row(t) =
            position(receiver.positions, receiver.triangles, {static_cast<int>(t), Point::Constant(1.0 / 3)});
    const Points normals = triangle_normals(receiver.positions, receiver.triangles);
    const ClosestPointIndex index(giver);
    const Eigen::Index count = receiver.triangles.rows();
    receiver.texcoords.resize(3 * count, 2);
    receiver.texcoord_triangles.resize(count, 3);
    parallel_for(
        count,
        [&](std::ptrdiff_t t) {
            const ClosestPoint any = index.closest(Point(centres.row(t)));
            const ClosestPoint alike = index.closest(Point(centres.row(t)), {normals.row(t), 0.0},
                                                     2 * std::sqrt(any.squared_distance) + 1e-300, any.where.triangle);
            const ClosestPoint& middle = alike.found() ? alike : any;
            const Continued plane = continued(giver, middle.where.triangle);
            const Texcoord centre = texcoord_at(giver, middle.where.triangle, middle.where.barycentric);
            for (int k = 0; k < 3; ++k) {
                const SurfacePoint& place = places[idx(receiver.triangles(t, k))];
                const Point at = position(giver.positions, giver.triangles, place);
                Texcoord uv = texcoord_at(giver, place.triangle, place.barycentric);
                if (chart[idx(place.triangle)] != chart[idx(middle.where.triangle)] ||
                    !goes_on(uv, centre, plane, middle.position, at))
                    uv = plane(at);
                receiver.texcoord_triangles(t, k) = static_cast<int>(3 * t + k);
                receiver.texcoords.row(3 * t + k) = uv.cast<float>();
            }
        },
        256);
    share_texcoords(receiver);
}

} // namespace

Eigen::MatrixXd carried(const Eigen::MatrixXd& values, const Triangles& giver,
                        const std::vector<SurfacePoint>& places) {
    Eigen::MatrixXd result(std::ssize(places), values.cols());
    for (Eigen::Index i = 0; i < result.rows(); ++i) {
        const SurfacePoint& p = places[idx(i)];
        result.row(i).setZero();
        for (int k = 0; k < 3; ++k)
            if (p.barycentric[k] != 0) result.row(i) += p.barycentric[k] * values.row(giver(p.triangle, k));
    }
    return result;
}

Mesh with_attributes(const Mesh& receiver, const Mesh& giver, const std::vector<SurfacePoint>& places) {
    Mesh result = receiver;
    if (giver.colors.rows() > 0)
        result.colors = carried(giver.colors.cast<double>(), giver.triangles, places).cast<float>();
    if (giver.texcoords.rows() > 0) carry_texcoords(result, giver, places);
    return result;
}

Points carried_points(const Points& points, const TwoShapes& giver, const TwoShapes& receiver,
                      std::vector<double>* distances) {
    const ClosestPointIndex start(giver.rest), end(receiver.fitted);
    const Points normals = triangle_normals(giver.fitted.positions, giver.fitted.triangles);
    Points result(points.rows(), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const ClosestPoint foot = start.closest(Point(points.row(i)));
        const SurfacePoint& from = foot.where;
        if (distances != nullptr) distances->push_back(std::sqrt(foot.squared_distance));
        const Point at = position(giver.fitted.positions, giver.fitted.triangles, from);
        ClosestPoint to = end.closest(at);
        const ClosestPoint alike = end.closest(at, {normals.row(from.triangle), 0.0},
                                               2 * std::sqrt(to.squared_distance) + 1e-300, to.where.triangle);
        if (alike.found()) to = alike;
        result.row(i) = position(receiver.rest.positions, receiver.rest.triangles, to.where);
    }
    return result;
}

} // namespace meshtween
