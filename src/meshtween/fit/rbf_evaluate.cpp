// Eq. 1 at many points. r^2 log r is r^2 / 2 times log(r^2), which saves the root; the logarithm is written so that
// compilers turn the loop over points into vector instructions: exponent and mantissa by integer arithmetic on the bits
// (as in fdlibm's e_log.c), then 2 atanh((m - 1) / (m + 1)) by a polynomial through Chebyshev nodes.
#include "meshtween/core/parallel.h"
#include "meshtween/fit/rbf.h"

#include <bit>
#include <cmath>
#include <cstdint>

// One build for every machine: the loader picks the widest vectors that it has. Sanitizers start too late for that.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) &&               \
    !defined(__SANITIZE_THREAD__)
#define MESHTWEEN_WIDEST __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define MESHTWEEN_WIDEST
#endif

namespace meshtween {
namespace {

constexpr int block = 64; // points at a time: nine such arrays stay in the fastest cache

struct Block { // normalised points and their summed displacements
    double x[block], y[block], z[block], fx[block], fy[block], fz[block];
};

// s / 2 * log(s) for s >= 0, to 4e-16 of s times the largest of 1 and |log s|. 0 at 0.
[[gnu::always_inline]] inline double half_s_log_s(double s) {
    constexpr std::uint64_t root_half = 0x3FE6A09E667F3BCDU, one = 0x3FF0000000000000U;
    constexpr std::uint64_t mantissa = 0x000FFFFFFFFFFFFFU, two_to_52 = 0x4330000000000000U;
    constexpr double half_log_2 = 0.34657359027997264;
    const std::uint64_t u = std::bit_cast<std::uint64_t>(s) + (one - root_half);
    const double exponent = std::bit_cast<double>((u >> 52) | two_to_52) - (4503599627370496.0 + 1023.0);
    const double m = std::bit_cast<double>((u & mantissa) + root_half); // in sqrt(1/2) .. sqrt(2)
    const double t = (m - 1) / (m + 1), z = t * t;
    const double atanh_over_t =
        1.0 + z * (0.3333333333327646 +
                   z * (0.20000000030870824 +
                        z * (0.1428570801055127 +
                             z * (0.11111717273945879 + z * (0.09060967209394291 + z * (0.0841883006213892))))));
    return s * (exponent * half_log_2 + t * atanh_over_t);
}

MESHTWEEN_WIDEST void add_thin_plates(Block& b, const double* centres, const double* lambda, std::ptrdiff_t count) {
    for (std::ptrdiff_t j = 0; j < count; ++j) {
        const double cx = centres[3 * j], cy = centres[3 * j + 1], cz = centres[3 * j + 2];
        const double lx = lambda[3 * j], ly = lambda[3 * j + 1], lz = lambda[3 * j + 2];
        for (int i = 0; i < block; ++i) {
            const double dx = b.x[i] - cx, dy = b.y[i] - cy, dz = b.z[i] - cz;
            const double phi = half_s_log_s(dx * dx + dy * dy + dz * dz); // Eq. 2
            b.fx[i] += lx * phi;
            b.fy[i] += ly * phi;
            b.fz[i] += lz * phi;
        }
    }
}

MESHTWEEN_WIDEST void add_distances(Block& b, const double* centres, const double* lambda, std::ptrdiff_t count) {
    for (std::ptrdiff_t j = 0; j < count; ++j) {
        const double cx = centres[3 * j], cy = centres[3 * j + 1], cz = centres[3 * j + 2];
        const double lx = lambda[3 * j], ly = lambda[3 * j + 1], lz = lambda[3 * j + 2];
        for (int i = 0; i < block; ++i) {
            const double dx = b.x[i] - cx, dy = b.y[i] - cy, dz = b.z[i] - cz;
            const double phi = std::sqrt(dx * dx + dy * dy + dz * dz);
            b.fx[i] += lx * phi;
            b.fy[i] += ly * phi;
            b.fz[i] += lz * phi;
        }
    }
}

} // namespace

Points RbfWarp::operator()(const Points& points) const {
    Points result(points.rows(), 3);
    const Eigen::Index blocks = (points.rows() + block - 1) / block;
    parallel_for(
        blocks,
        [&](Eigen::Index k) {
            const Eigen::Index begin = k * block, count = std::min<Eigen::Index>(block, points.rows() - begin);
            Block b;
            for (int i = 0; i < block; ++i) { // the last block is filled up, so that all points go the same way
                const Point p = (points.row(begin + std::min<Eigen::Index>(i, count - 1)) - origin) * scale;
                b.x[i] = p.x(), b.y[i] = p.y(), b.z[i] = p.z();
                const Point q = polynomial.row(0) + p * polynomial.bottomRows<3>();
                b.fx[i] = q.x(), b.fy[i] = q.y(), b.fz[i] = q.z();
            }
            if (kernel == Kernel::thin_plate)
                add_thin_plates(b, centres.data(), lambda.data(), centres.rows());
            else
                add_distances(b, centres.data(), lambda.data(), centres.rows());
            for (Eigen::Index i = 0; i < count; ++i)
                result.row(begin + i) = points.row(begin + i) + Point(b.fx[i], b.fy[i], b.fz[i]) / scale;
        },
        16);
    return result;
}

} // namespace meshtween
