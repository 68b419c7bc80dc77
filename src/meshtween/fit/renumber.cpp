#include "meshtween/fit/renumber.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/gather.h"
#include "meshtween/search/visiting_order.h"

#include <algorithm>
#include <array>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

std::array<int, 3> sorted_corners(const Triangles& triangles, std::ptrdiff_t t) {
    std::array<int, 3> corners{triangles(t, 0), triangles(t, 1), triangles(t, 2)};
    std::sort(corners.begin(), corners.end());
    return corners;
}

} // namespace

Renumbered renumbered(const Points& positions, const Triangles& triangles) {
    Renumbered result;
    result.vertex = search::curve_order(positions);
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
                  [&](int s, int t) { return sorted_corners(corners, s) < sorted_corners(corners, t); });
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
