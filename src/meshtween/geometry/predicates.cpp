// J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates, Discrete &
// Computational Geometry 18, 1997. A plain evaluation whose error is bounded decides nearly always; else the
// determinant is summed without error as an expansion, a sum of doubles of which none overlaps another. This file has
// to be compiled without contraction of products and sums, which would break the error terms.
#include "meshtween/geometry/predicates.h"

#include <array>
#include <cmath>
#include <limits>

namespace meshtween {
namespace {

constexpr double unit = std::numeric_limits<double>::epsilon() / 2;
constexpr double bound2d = (3 + 16 * unit) * unit; // Shewchuk's ccwerrboundA
constexpr double bound3d = (7 + 56 * unit) * unit; // and his o3derrboundA

struct Two {
    double high, low; // the rounded result and its error
};

Two two_sum(double a, double b) {
    const double x = a + b, from_b = x - a, from_a = x - from_b;
    return {x, (a - from_a) + (b - from_b)};
}

Two split(double a) {
    const double c = 134217729.0 * a, high = c - (c - a); // 2^27 + 1
    return {high, a - high};
}

Two two_product(double a, double b) {
    const double x = a * b;
    const Two p = split(a), q = split(b);
    return {x, p.low * q.low - (((x - p.high * q.high) - p.low * q.high) - p.high * q.low)};
}

// Components from the smallest to the largest, none of them nil; no components for nil.
template <int most>
struct Expansion {                      // NOLINT(cppcoreguidelines-pro-type-member-init): mostly a few of many are used
    std::array<double, most> component; // the first `count` of them hold anything
    int count = 0;

    void push(double x) {
        if (x != 0) component[static_cast<std::size_t>(count++)] = x;
    }
    double operator[](int i) const { return component[static_cast<std::size_t>(i)]; }
    int sign() const { return count == 0 ? 0 : component[static_cast<std::size_t>(count - 1)] > 0 ? 1 : -1; }
};

Expansion<2> difference(double a, double b) {
    const Two d = two_sum(a, -b);
    Expansion<2> result;
    result.push(d.low);
    result.push(d.high);
    return result;
}

template <int n>
Expansion<n> negative(Expansion<n> e) {
    for (int i = 0; i < e.count; ++i) e.component[static_cast<std::size_t>(i)] *= -1;
    return e;
}

template <int n, int m>
Expansion<n + m> sum(const Expansion<n>& e, const Expansion<m>& f) { // his Fig. 8
    Expansion<n + m> result;
    double carried = 0;
    for (int i = 0, j = 0; i < e.count || j < f.count;) {
        const bool from_e = j == f.count || (i < e.count && std::abs(e[i]) < std::abs(f[j]));
        const Two s = two_sum(carried, from_e ? e[i++] : f[j++]);
        result.push(s.low);
        carried = s.high;
    }
    result.push(carried);
    return result;
}

template <int n>
Expansion<2 * n> scaled(const Expansion<n>& e, double factor) { // his Fig. 13
    Expansion<2 * n> result;
    double carried = 0;
    for (int i = 0; i < e.count; ++i) {
        const Two product = two_product(e[i], factor), low = two_sum(carried, product.low),
                  high = two_sum(product.high, low.high);
        result.push(low.low);
        result.push(high.low);
        carried = high.high;
    }
    result.push(carried);
    return result;
}

template <int n>
Expansion<4 * n> product(const Expansion<n>& e, const Expansion<2>& f) {
    if (f.count == 0) return {};
    const Expansion<2 * n> first = scaled(e, f[0]);
    return sum(first, f.count == 2 ? scaled(e, f[1]) : Expansion<2 * n>{});
}

int exact_orient2d(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
    const auto acx = difference(a[0], c[0]), acy = difference(a[1], c[1]), bcx = difference(b[0], c[0]),
               bcy = difference(b[1], c[1]);
    return sum(product(acx, bcy), negative(product(acy, bcx))).sign();
}

int exact_orient3d(const Point& a, const Point& b, const Point& c, const Point& d) {
    const auto minor = [](const auto& px, const auto& py, const auto& qx, const auto& qy) {
        return sum(product(px, qy), negative(product(py, qx)));
    };
    std::array<Expansion<2>, 3> ad, bd, cd;
    for (int k = 0; k < 3; ++k) {
        const auto i = static_cast<std::size_t>(k);
        ad[i] = difference(a[k], d[k]);
        bd[i] = difference(b[k], d[k]);
        cd[i] = difference(c[k], d[k]);
    }
    const auto first = product(minor(bd[0], bd[1], cd[0], cd[1]), ad[2]);
    const auto second = product(minor(cd[0], cd[1], ad[0], ad[1]), bd[2]);
    const auto third = product(minor(ad[0], ad[1], bd[0], bd[1]), cd[2]);
    return -sum(sum(first, second), third).sign();
}

int sign(double x) {
    return (x > 0) - (x < 0);
}

} // namespace

int orient2d(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c) {
    const double left = (a[0] - c[0]) * (b[1] - c[1]), right = (a[1] - c[1]) * (b[0] - c[0]);
    const double determinant = left - right;
    if (std::abs(determinant) > bound2d * (std::abs(left) + std::abs(right))) return sign(determinant);
    return exact_orient2d(a, b, c);
}

int orient3d(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Point ad = a - d, bd = b - d, cd = c - d;
    // The usual case in which the filter cannot decide: all four on a plane of constant x, y or z.
    for (int k = 0; k < 3; ++k)
        if (ad[k] == 0 && bd[k] == 0 && cd[k] == 0) return 0;
    const double bxcy = bd[0] * cd[1], cxby = cd[0] * bd[1], cxay = cd[0] * ad[1], axcy = ad[0] * cd[1],
                 axby = ad[0] * bd[1], bxay = bd[0] * ad[1];
    const double determinant = ad[2] * (bxcy - cxby) + bd[2] * (cxay - axcy) + cd[2] * (axby - bxay);
    const double size = (std::abs(bxcy) + std::abs(cxby)) * std::abs(ad[2]) +
                        (std::abs(cxay) + std::abs(axcy)) * std::abs(bd[2]) +
                        (std::abs(axby) + std::abs(bxay)) * std::abs(cd[2]);
    if (std::abs(determinant) > bound3d * size) return -sign(determinant);
    return exact_orient3d(a, b, c, d);
}

bool collinear(const Point& a, const Point& b, const Point& c) {
    const auto along = [&](int x, int y) {
        return orient2d(PlanePoint(a[x], a[y]), PlanePoint(b[x], b[y]), PlanePoint(c[x], c[y]));
    };
    return along(0, 1) == 0 && along(1, 2) == 0 && along(2, 0) == 0;
}

} // namespace meshtween
