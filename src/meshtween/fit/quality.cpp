// The symmetric Dirichlet energy: Smith and Schaefer, "Bijective Parameterization with Free Boundaries", 2015.
#include "meshtween/fit/quality.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/fit/markers.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/search/self_intersections.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numeric>
#include <random>

namespace meshtween {
namespace {

constexpr int sample_count = 100000;

struct Samples {
    Points points;
    std::vector<int> triangles; // on which each lies
};

// Points spread evenly over the surface, one in each of as many equal parts of its area; the same for the same seed.
Samples surface_samples(const Mesh& mesh, std::uint32_t seed) {
    const double share = 2 * surface_area(mesh.positions, mesh.triangles) / sample_count;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    Samples samples{Points(sample_count, 3), std::vector<int>(sample_count)};
    int t = 0;
    double before = 0, here = double_area_normal(mesh.positions, mesh.triangles, 0).norm();
    for (int i = 0; i < sample_count; ++i) {
        const double at = (i + unit(random)) * share;
        while (before + here < at && t + 1 < mesh.triangles.rows()) {
            before += here;
            here = double_area_normal(mesh.positions, mesh.triangles, ++t).norm();
        }
        const double a = std::sqrt(unit(random)), b = unit(random);
        samples.points.row(i) = position(mesh.positions, mesh.triangles, {t, {1 - a, a * (1 - b), a * b}});
        samples.triangles[static_cast<std::size_t>(i)] = t;
    }
    return samples;
}

// In percent.
std::vector<double> distances(const std::vector<ClosestPoint>& closest, double diagonal) {
    std::vector<double> result;
    result.reserve(closest.size());
    for (const ClosestPoint& c : closest) result.push_back(std::sqrt(c.squared_distance) * 100 / diagonal);
    return result;
}

// For points on the fitted mesh's triangles: where the first corner's closest point lies.
std::vector<int> hints(const Comparison& both, const std::vector<int>& triangles) {
    std::vector<int> result;
    result.reserve(triangles.size());
    for (const int t : triangles)
        result.push_back(both.vertices[static_cast<std::size_t>(both.fitted.triangles(t, 0))].where.triangle);
    return result;
}

void count_flips(const Comparison& both, Quality& quality) {
    const Mesh &fitted = both.fitted, &target = both.target;
    Points centres(fitted.triangles.rows(), 3);
    for (Eigen::Index t = 0; t < centres.rows(); ++t)
        centres.row(t) = (fitted.positions.row(fitted.triangles(t, 0)) + fitted.positions.row(fitted.triangles(t, 1)) +
                          fitted.positions.row(fitted.triangles(t, 2))) /
                         3;
    std::vector<int> all(static_cast<std::size_t>(centres.rows()));
    std::iota(all.begin(), all.end(), 0);
    const std::vector<ClosestPoint> closest = both.on_target.closest(centres, hints(both, all));
    const double tiny = 1e-14 * both.diagonal * both.diagonal;
    double flipped_area = 0, area = 0;
    for (Eigen::Index t = 0; t < centres.rows(); ++t) {
        const Point n = double_area_normal(fitted.positions, fitted.triangles, t);
        const Point m =
            double_area_normal(target.positions, target.triangles, closest[static_cast<std::size_t>(t)].where.triangle);
        quality.degenerate += n.norm() < tiny;
        area += n.norm();
        if (n.dot(m) >= 0) continue;
        quality.flipped.push_back(static_cast<int>(t));
        flipped_area += n.norm();
    }
    quality.flipped_area_percent = area > 0 ? 100 * flipped_area / area : 0;
}

// Edges of a triangle in its own plane, as the columns of a 2 x 2 matrix.
Eigen::Matrix2d planar_edges(const Points& positions, const Triangles& triangles, Eigen::Index t) {
    const Point a = positions.row(triangles(t, 0)), e = positions.row(triangles(t, 1)) - a,
                f = positions.row(triangles(t, 2)) - a;
    const Point x = e.norm() > 0 ? Point(e / e.norm()) : Point(0, 0, 0);
    Eigen::Matrix2d edges;
    edges << e.norm(), f.dot(x), 0, (f - f.dot(x) * x).norm();
    return edges;
}

// s1^2 + s2^2 + 1/s1^2 + 1/s2^2 of each face's map with area before and after.
std::vector<double> symmetric_dirichlet(const Mesh& source, const Mesh& fitted) {
    constexpr double least = 1e-12; // of a singular value, so that a collapsed face counts but stays finite
    std::vector<double> result;
    for (Eigen::Index t = 0; t < source.triangles.rows(); ++t) {
        const Eigen::Matrix2d before = planar_edges(source.positions, source.triangles, t);
        const Eigen::Matrix2d after = planar_edges(fitted.positions, fitted.triangles, t);
        if (before.determinant() <= 0) continue;
        const Eigen::Matrix2d map = after * before.inverse();
        const double sum = map.squaredNorm(), product = std::abs(map.determinant());
        const double s1 = std::sqrt((sum + std::sqrt(std::max(0.0, sum * sum - 4 * product * product))) / 2);
        const double larger = std::max(s1, least), smaller = std::max(s1 > 0 ? product / s1 : 0, least);
        result.push_back(larger * larger + smaller * smaller + 1 / (larger * larger) + 1 / (smaller * smaller));
    }
    return result;
}

std::vector<std::array<int, 2>> cuts(const Mesh& mesh, const Weld& seams) {
    return self_intersections(mesh.positions, seams.any() ? seams.by_first() : mesh.triangles);
}

// Of one row a vertex, those of the first of the vertices that are one.
template <typename Rows>
Rows counted_once(const Rows& rows, const Weld& seams) {
    if (!seams.any()) return rows;
    Rows result;
    for (const int i : seams.first) result.push_back(rows[static_cast<std::size_t>(i)]);
    return result;
}

void require_same_mesh(const Mesh& source, const Mesh& fitted, const Points& truth) {
    if (source.positions.rows() != fitted.positions.rows() || source.triangles.rows() != fitted.triangles.rows() ||
        source.triangles != fitted.triangles)
        throw Error(
            ErrorKind::argument,
            fmt::format("the fitted mesh ({} vertices, {} triangles) is not the source's ({}, {}); measure needs the "
                        "same vertices and faces in the same order",
                        fitted.positions.rows(), fitted.triangles.rows(), source.positions.rows(),
                        source.triangles.rows()));
    if (truth.rows() != 0 && truth.rows() != source.positions.rows())
        throw Error(ErrorKind::argument,
                    fmt::format("the truth has {} rows; it needs one for each of the source's {} vertices",
                                truth.rows(), source.positions.rows()));
}

} // namespace

Statistics statistics(std::vector<double> values) {
    Statistics s;
    if (values.empty()) return s;
    for (const double v : values) s.mean += v, s.rms += v * v;
    const auto count = static_cast<double>(values.size());
    s.mean /= count;
    s.rms = std::sqrt(s.rms / count);
    auto first = values.begin(); // what lies before it is smaller
    const auto at = [&](double q) {
        const auto place = values.begin() + static_cast<std::ptrdiff_t>(q * (count - 1));
        std::nth_element(first, place, values.end());
        first = place;
        return *place;
    };
    s.median = at(0.5), s.p95 = at(0.95), s.p99 = at(0.99), s.max = *std::max_element(first, values.end());
    return s;
}

AnsweredQuality answered_quality(const Comparison& both, const Quality& whole, const std::vector<char>& unanswered,
                                 std::uint32_t seed) {
    const Mesh& fitted = both.fitted;
    const auto counts = [&](int t) {
        return std::ranges::any_of(fitted.triangles.row(t),
                                   [&](int i) { return unanswered[static_cast<std::size_t>(i)] == 0; });
    };
    AnsweredQuality result{0, whole.fitted_to_target, whole.target_to_fitted, {}, 0};
    for (int t = 0; t < fitted.triangles.rows(); ++t) result.faces += counts(t) ? 1 : 0;
    std::ranges::copy_if(whole.flipped, std::back_inserter(result.flipped), counts);
    result.cuts =
        std::ranges::count_if(whole.cuts, [&](const auto& pair) { return counts(pair[0]) && counts(pair[1]); });
    if (result.faces == fitted.triangles.rows()) return result;
    const Samples samples = surface_samples(fitted, seed);
    const std::vector<ClosestPoint> closest = both.on_target.closest(samples.points, hints(both, samples.triangles));
    std::vector<double> answered;
    for (std::size_t i = 0; i < closest.size(); ++i)
        if (counts(samples.triangles[i]))
            answered.push_back(std::sqrt(closest[i].squared_distance) * 100 / both.diagonal);
    result.fitted_to_target = statistics(std::move(answered));
    return result;
}

AnsweredQuality answered_quality(const Mesh& source, const Comparison& both, const Quality& whole,
                                 const std::vector<char>& unanswered, const std::vector<int>& left_out,
                                 std::uint32_t seed) {
    if (left_out.empty() || std::ssize(left_out) == both.target.triangles.rows())
        return answered_quality(both, whole, unanswered, seed);
    std::vector<int> kept;
    for (int t = 0; t < both.target.triangles.rows(); ++t)
        if (!std::binary_search(left_out.begin(), left_out.end(), t)) kept.push_back(t);
    Mesh target;
    target.positions = both.target.positions;
    target.triangles = both.target.triangles(kept, Eigen::all);
    const Comparison fitted_to(both.fitted, target, both.weld);
    return answered_quality(fitted_to, measure(source, fitted_to, {}, {}, seed), unanswered, seed);
}

Quality measure(const Mesh& source, const Comparison& both, const Points& truth, std::span<const Marker> markers,
                std::uint32_t seed) {
    const Mesh &fitted = both.fitted, &target = both.target;
    require_same_mesh(source, fitted, truth);
    const double percent = 100 / both.diagonal;

    const Weld own = both.weld ? seams(source, {&source.positions, &fitted.positions}) : Weld();
    const std::vector<ClosestPoint> vertices = counted_once(both.vertices, own);
    Quality q;
    q.vertices = std::ssize(vertices);
    q.copies = fitted.positions.rows() - q.vertices;
    q.triangles = fitted.triangles.rows();
    for (const ClosestPoint& c : vertices) q.eq7 += c.squared_distance / (both.diagonal * both.diagonal);
    const std::vector<std::function<void()>> parts{
        // each on its own, for most of them have serial stretches
        [&] { q.vertex_to_target = statistics(distances(vertices, both.diagonal)); },
        [&] {
            const Samples on_fitted = surface_samples(fitted, seed);
            q.fitted_to_target = statistics(
                distances(both.on_target.closest(on_fitted.points, hints(both, on_fitted.triangles)), both.diagonal));
        },
        [&] {
            const Samples on_target = surface_samples(target, seed);
            q.target_to_fitted = statistics(distances(both.on_fitted.closest(on_target.points), both.diagonal));
        },
        [&] { count_flips(both, q); },
        [&] { q.cuts = cuts(fitted, own); },
        [&] { q.cuts_source = std::ssize(cuts(source, both.weld ? seams(source) : Weld())); },
        [&] { q.cuts_target = std::ssize(cuts(target, both.target_seams)); },
        [&] { q.symmetric_dirichlet = statistics(symmetric_dirichlet(source, fitted)); }};
    parallel_for(
        std::ssize(parts), [&](std::ptrdiff_t k) { parts[static_cast<std::size_t>(k)](); }, 1);
    if (truth.rows() > 0) {
        std::vector<double> errors;
        for (Eigen::Index i = 0; i < truth.rows(); ++i)
            errors.push_back((truth.row(i) - fitted.positions.row(i)).norm() * percent);
        q.truth_error = statistics(counted_once(errors, own));
    }
    if (!markers.empty()) {
        std::vector<double> errors;
        for (const Marker& m : markers)
            errors.push_back((position(fitted.positions, fitted.triangles, m.source) - m.target).norm() * percent);
        q.marker_error = statistics(errors);
    }
    return q;
}

} // namespace meshtween
