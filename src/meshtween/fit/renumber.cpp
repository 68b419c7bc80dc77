#include "meshtween/fit/renumber.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/gather.h"
#include "meshtween/search/visiting_order.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// Sorted, then as they are.
std::array<int, 6> key(const Triangles& triangles, std::ptrdiff_t t) {
    const int a = triangles(t, 0), b = triangles(t, 1), c = triangles(t, 2);
    std::array<int, 6> corners{a, b, c, a, b, c};
    std::sort(corners.begin(), corners.begin() + 3);
    return corners;
}

// Along the curve; vertices of no triangle come anywhere, so that they do not widen its cells.
std::vector<int> along_curve(const Points& positions, const Triangles& triangles) {
    std::vector<char> used(idx(positions.rows()), 0);
    for (const int v : triangles.reshaped()) used[idx(v)] = 1;
    Points places = positions;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (!used[v]) places.row(static_cast<Eigen::Index>(v)).setConstant(NAN);
    return search::curve_order(places);
}

} // namespace

Renumbered renumbered(const Points& positions, const Triangles& triangles) {
    Renumbered result;
    result.vertex = along_curve(positions, triangles);
    result.positions = in_order_of(result.vertex, positions);
    std::vector<int> now(result.vertex.size());
    parallel_for(std::ssize(now), [&](std::ptrdiff_t i) { now[idx(result.vertex[idx(i)])] = static_cast<int>(i); });
    Triangles corners(triangles.rows(), 3);
    parallel_for(triangles.rows(), [&](std::ptrdiff_t t) {
        for (int k = 0; k < 3; ++k) corners(t, k) = now[idx(triangles(t, k))];
    });
    Lists by_first = gather(positions.rows(), [&](const auto& put) {
        for (std::ptrdiff_t t = 0; t < corners.rows(); ++t) put(corners.row(t).minCoeff(), static_cast<int>(t));
    });
    parallel_for(by_first.size(), [&](std::ptrdiff_t i) {
        std::sort(by_first.items.begin() + by_first.first[idx(i)], by_first.items.begin() + by_first.first[idx(i + 1)],
                  [&](int s, int t) { return key(corners, s) < key(corners, t); });
    });
    result.triangle = std::move(by_first.items);
    result.triangles.resize(corners.rows(), 3);
    parallel_for(corners.rows(),
                 [&](std::ptrdiff_t t) { result.triangles.row(t) = corners.row(result.triangle[idx(t)]); });
    return result;
}

Points in_order_of(const std::vector<int>& before, const Points& x) {
    Points result(x.rows(), 3);
    parallel_for(x.rows(), [&](std::ptrdiff_t i) { result.row(i) = x.row(before[idx(i)]); });
    return result;
}

Points as_before(const std::vector<int>& before, const Points& x) {
    Points result(x.rows(), 3);
    parallel_for(x.rows(), [&](std::ptrdiff_t i) { result.row(before[idx(i)]) = x.row(i); });
    return result;
}

} // namespace meshtween
