// G. M. Morton, A computer oriented geodetic data base and a new technique in file sequencing, IBM, 1966: the bits of
// the three coordinates in turn are the place on the curve.
#include "meshtween/search/visiting_order.h"

#include "meshtween/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace meshtween::search {
namespace {

constexpr int bits_an_axis = 10;

std::uint32_t spread(std::uint32_t x) { // two noughts between any two of ten bits
    x = (x | x << 16) & 0x030000ff;
    x = (x | x << 8) & 0x0300f00f;
    x = (x | x << 4) & 0x030c30c3;
    return (x | x << 2) & 0x09249249;
}

struct Extent {
    Point low = Point::Constant(INFINITY), high = Point::Constant(-INFINITY);
    Extent& operator+=(const Extent& other) {
        low = low.cwiseMin(other.low);
        high = high.cwiseMax(other.high);
        return *this;
    }
};

Extent extent(const Points& points) {
    return parallel_sum(points.rows(), Extent{}, [&](Eigen::Index i) -> Extent {
        if (!points.row(i).allFinite()) return {};
        return {points.row(i), points.row(i)};
    });
}

// Whether neighbours in the list are near each other, as vertices of a mesh mostly are, by a thousand of them.
bool in_order(const Points& points) {
    const Extent all = extent(points);
    const double diagonal = (all.high - all.low).norm();
    if (!(diagonal > 0) || !std::isfinite(diagonal)) return true;
    const Eigen::Index step = std::max<Eigen::Index>(1, points.rows() / 1000);
    double sum = 0;
    Eigen::Index count = 0;
    for (Eigen::Index i = step; i < points.rows(); i += step, ++count)
        sum += std::min((points.row(i) - points.row(i - 1)).norm(), diagonal);
    return sum < 0.05 * diagonal * static_cast<double>(count);
}

} // namespace

std::vector<int> curve_order(const Points& points) {
    const Eigen::Index count = points.rows();
    const Extent all = extent(points);
    const double size = (all.high - all.low).maxCoeff(), cells = (1 << bits_an_axis) - 1;
    std::vector<std::uint64_t> keys(static_cast<std::size_t>(count)), other(keys.size());
    parallel_for(count, [&](Eigen::Index i) {
        std::uint64_t key = 0;
        for (int k = 0; k < 3; ++k) {
            const double cell = (points(i, k) - all.low[k]) / size * cells;
            key |= static_cast<std::uint64_t>(spread(cell > 0 ? static_cast<std::uint32_t>(std::min(cell, cells)) : 0))
                   << k;
        }
        keys[static_cast<std::size_t>(i)] = key << 32 | static_cast<std::uint64_t>(i);
    });
    for (int shift = 32; shift < 32 + 3 * bits_an_axis; shift += bits_an_axis) { // sorted digit by digit
        std::array<std::size_t, (1 << bits_an_axis) + 1> first{};
        const auto digit = [&](std::uint64_t key) { return key >> shift & ((1 << bits_an_axis) - 1); };
        for (const std::uint64_t key : keys) ++first[digit(key) + 1];
        std::partial_sum(first.begin(), first.end(), first.begin());
        for (const std::uint64_t key : keys) other[first[digit(key)]++] = key;
        keys.swap(other);
    }
    std::vector<int> order(keys.size());
    std::transform(keys.begin(), keys.end(), order.begin(),
                   [](std::uint64_t key) { return static_cast<int>(key & 0xffffffff); });
    const auto place = [&](int i) {
        std::array<double, 3> p{};
        for (int k = 0; k < 3; ++k) p[static_cast<std::size_t>(k)] = std::isnan(points(i, k)) ? INFINITY : points(i, k);
        return p;
    };
    for (std::size_t begin = 0, end = 0; begin < keys.size(); begin = end) {
        while (end < keys.size() && keys[end] >> 32 == keys[begin] >> 32) ++end;
        std::sort(order.begin() + static_cast<std::ptrdiff_t>(begin), order.begin() + static_cast<std::ptrdiff_t>(end),
                  [&](int i, int j) { return place(i) < place(j) || (place(i) == place(j) && i < j); });
    }
    return order;
}

std::vector<int> visiting_order(const Points& points) {
    constexpr Eigen::Index few = 2000;
    return points.rows() < few || in_order(points) ? std::vector<int>() : curve_order(points);
}

} // namespace meshtween::search
