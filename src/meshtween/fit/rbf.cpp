// Eq. 1-5: scattered displacements interpolated by radial functions and a first-degree polynomial.
// Turk and O'Brien 2002 and Carr et al. 2001 (the paper's references 21 and 22). The polynomial block of Eq. 5 is
// eliminated by an orthonormal basis of the weights that Eq. 4 allows, on which the radial block is definite
// (Wendland, Scattered Data Approximation, 2005, section 8): r^2 log r positive, r negative.
#include "meshtween/fit/rbf.h"

#include "meshtween/core/error.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace meshtween {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double same_place = 1e-9; // of the points' extent: closer than this is one place
constexpr double flat = 1e-7;       // thickness over extent under which points lie on a line or plane
constexpr double met = 1e-10;       // residual of Eq. 3, in parts of the points' extent

double kernel_value(Kernel kernel, double squared) { // Eq. 2, or r
    if (kernel == Kernel::linear) return std::sqrt(squared);
    return squared > 0 ? 0.5 * squared * std::log(squared) : 0;
}

std::string name_of(const std::vector<std::string>& names, Index i) {
    const auto k = static_cast<std::size_t>(i);
    return k < names.size() && !names[k].empty() ? fmt::format("'{}'", names[k]) : fmt::format("{}", i + 1);
}

void check_input(const Points& from, const Points& to, const RbfOptions& options,
                 const std::vector<std::string>& names) {
    if (from.rows() != to.rows())
        throw Error(
            ErrorKind::argument,
            fmt::format("{} markers on the source but {} on the target: give them in pairs", from.rows(), to.rows()));
    if (!(options.smoothing >= 0) || !std::isfinite(options.smoothing))
        throw Error(ErrorKind::argument,
                    fmt::format("the warp's smoothing is {}: give 0 or a positive number", options.smoothing));
    for (Index i = 0; i < from.rows(); ++i)
        if (!from.row(i).allFinite() || !to.row(i).allFinite())
            throw Error(
                ErrorKind::argument,
                fmt::format("marker {} has a coordinate that is not finite: correct or remove it", name_of(names, i)));
    if (from.rows() < 3)
        throw Error(ErrorKind::computation, fmt::format("{} marker{} given, at least 3 are needed: add more",
                                                        from.rows(), from.rows() == 1 ? "" : "s"));
}

// The rows to keep, in order: of markers that share both places only the first. Sorted along x, so that only
// neighbours within the tolerance are compared.
std::vector<Index> distinct_rows(const Points& from, const Points& to, const std::vector<std::string>& names) {
    const double near_from = same_place * (from.colwise().maxCoeff() - from.colwise().minCoeff()).norm();
    const double near_to = same_place * (to.colwise().maxCoeff() - to.colwise().minCoeff()).norm();
    std::vector<Index> order(static_cast<std::size_t>(from.rows()));
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return from(a, 0) < from(b, 0); });
    std::vector<char> dropped(order.size(), 0);
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t j = i + 1; j < order.size() && from(order[j], 0) - from(order[i], 0) <= near_from; ++j) {
            const auto [a, b] = std::minmax(order[i], order[j]);
            if ((from.row(a) - from.row(b)).norm() > near_from) continue;
            if ((to.row(a) - to.row(b)).norm() > near_to)
                throw Error(ErrorKind::computation,
                            fmt::format("markers {} and {} lie on the same point of the source but on different "
                                        "points of the target: move or remove one",
                                        name_of(names, a), name_of(names, b)));
            dropped[static_cast<std::size_t>(b)] = 1;
        }
    std::vector<Index> kept;
    for (Index i = 0; i < from.rows(); ++i)
        if (!dropped[static_cast<std::size_t>(i)]) kept.push_back(i);
    return kept;
}

// How many directions the points span (1, 2 or 3), and those directions, longest first, as columns.
struct Span {
    int dimensions = 0;
    Eigen::Matrix3d axes;
};

Span span_of(const Points& points) {
    const Points centred = points.rowwise() - points.colwise().mean();
    const Eigen::JacobiSVD<MatrixXd> svd(MatrixXd(centred), Eigen::ComputeThinU | Eigen::ComputeFullV);
    Span span;
    span.axes = svd.matrixV();
    for (Index k = 0; k < svd.singularValues().size(); ++k)
        span.dimensions += svd.singularValues()[k] > flat * svd.singularValues()[0];
    return span;
}

MatrixXd kernel_matrix(const Points& centres, const RbfOptions& options) { // the phi_ij of Eq. 5
    MatrixXd phi(centres.rows(), centres.rows());
    for (Index j = 0; j < phi.cols(); ++j)
        for (Index i = 0; i < phi.rows(); ++i)
            phi(i, j) = kernel_value(options.kernel, (centres.row(i) - centres.row(j)).squaredNorm());
    // Away from the interpolant on the side on which the kernel is definite.
    phi.diagonal().array() += options.kernel == Kernel::thin_plate ? options.smoothing : -options.smoothing;
    return phi;
}

struct Weights {
    MatrixXd lambda;     // N x 3
    MatrixXd polynomial; // columns of `basis` x 3
    double residual = 0; // the largest of Eq. 3
};

// Solves [Phi B; B' 0] [lambda; c] = [d; 0] for a full-rank B (Eq. 5), refined until it no longer gains.
Weights solve(const MatrixXd& phi, const MatrixXd& B, const MatrixXd& d, double sign) {
    const Index rank = B.cols();
    const Eigen::HouseholderQR<MatrixXd> qr(B); // B = Q [R; 0]; the last columns of Q span what Eq. 4 allows
    const auto Q = qr.householderQ();
    MatrixXd rotated = Q.adjoint() * phi;
    rotated = (rotated * Q).eval();
    const Index free = phi.rows() - rank;
    const MatrixXd definite = sign * rotated.bottomRightCorner(free, free);
    const Eigen::LLT<MatrixXd> cholesky(definite);
    Eigen::PartialPivLU<MatrixXd> lu; // rounding can cost definiteness where markers nearly coincide
    if (free > 0 && cholesky.info() != Eigen::Success) lu.compute(definite);
    const auto R = qr.matrixQR().topRows(rank).triangularView<Eigen::Upper>();

    Weights weights{MatrixXd::Zero(phi.rows(), d.cols()), MatrixXd::Zero(rank, d.cols()), d.cwiseAbs().maxCoeff()};
    for (int round = 0; round < 4; ++round) {
        const MatrixXd rest = d - phi * weights.lambda - B * weights.polynomial;
        const MatrixXd turned = Q.adjoint() * rest;
        MatrixXd mu = MatrixXd::Zero(phi.rows(), d.cols());
        if (free > 0) {
            const MatrixXd right = sign * turned.bottomRows(free);
            mu.bottomRows(free) =
                cholesky.info() == Eigen::Success ? MatrixXd(cholesky.solve(right)) : MatrixXd(lu.solve(right));
        }
        Weights next;
        next.lambda = weights.lambda + Q * mu;
        const MatrixXd top = turned.topRows(rank) - (rotated * mu).topRows(rank);
        next.polynomial = weights.polynomial + R.solve(top);
        next.residual = (d - phi * next.lambda - B * next.polynomial).cwiseAbs().maxCoeff();
        if (!(next.residual < weights.residual)) break;
        weights = std::move(next);
    }
    return weights;
}

// The pair that is stretched most: the likely reason where Eq. 3 cannot be met in double precision.
std::string steepest_pair(const Points& from, const Points& to, const std::vector<Index>& rows,
                          const std::vector<std::string>& names) {
    double worst = -1;
    Index a = 0, b = 0;
    for (Index i = 0; i < from.rows(); ++i)
        for (Index j = i + 1; j < from.rows(); ++j) {
            const double stretch = (to.row(i) - to.row(j)).norm() / (from.row(i) - from.row(j)).norm();
            if (stretch > worst) worst = stretch, a = i, b = j;
        }
    return fmt::format("markers {} and {}", name_of(names, rows[static_cast<std::size_t>(a)]),
                       name_of(names, rows[static_cast<std::size_t>(b)]));
}

} // namespace

RbfWarp warp(const Points& from, const Points& to, const RbfOptions& options, const std::vector<std::string>& names) {
    check_input(from, to, options, names);
    const std::vector<Index> rows = distinct_rows(from, to, names);
    const Points c_raw = from(rows, Eigen::all), goals_raw = to(rows, Eigen::all);

    RbfWarp result;
    result.kernel = options.kernel;
    result.origin = c_raw.colwise().mean();
    const double spread = std::sqrt((c_raw.rowwise() - result.origin).rowwise().squaredNorm().mean());
    result.scale = spread > 0 ? 1 / (2 * spread) : 1; // a box would make smoothing depend on the axes
    result.centres = (c_raw.rowwise() - result.origin) * result.scale;
    const Points goals = (goals_raw.rowwise() - result.origin) * result.scale;

    const Span span = span_of(result.centres);
    if (rows.size() < 3 || span.dimensions < 2)
        throw Error(ErrorKind::computation,
                    fmt::format("the {} different markers lie on one line ({} to {}), which leaves the turn around it "
                                "open: add one beside it",
                                rows.size(), name_of(names, rows.front()), name_of(names, rows.back())));

    // The best rigid motion with scale first; Eq. 5 for what it leaves. Without it nothing would say where the normal
    // direction of a plane of markers goes.
    const Eigen::Matrix4d similar =
        Eigen::umeyama(Eigen::Matrix3Xd(result.centres.transpose()), Eigen::Matrix3Xd(goals.transpose()), true);
    const Eigen::Matrix3d linear = similar.topLeftCorner<3, 3>();
    const Point shift = similar.topRightCorner<3, 1>().transpose();
    const MatrixXd rest = goals - ((result.centres * linear.transpose()).rowwise() + shift);

    MatrixXd B(result.centres.rows(), 1 + span.dimensions); // 1 and the coordinates along the spanned directions
    B.col(0).setOnes();
    B.rightCols(span.dimensions) = result.centres * span.axes.leftCols(span.dimensions);
    const double sign = options.kernel == Kernel::thin_plate ? 1 : -1;
    const Weights weights = solve(kernel_matrix(result.centres, options), B, rest, sign);
    const double size = std::max(1.0, goals.cwiseAbs().maxCoeff());
    if (!(weights.residual <= met * size))
        throw Error(ErrorKind::computation,
                    fmt::format("the marker warp cannot be solved: {} lie too close together on the source for where "
                                "they go on the target; move or remove one",
                                steepest_pair(result.centres, goals, rows, names)));

    result.lambda = weights.lambda;
    result.polynomial.row(0) = shift + Point(weights.polynomial.row(0));
    result.polynomial.bottomRows<3>() =
        linear.transpose() - Eigen::Matrix3d::Identity() +
        span.axes.leftCols(span.dimensions) * weights.polynomial.bottomRows(span.dimensions);
    return result;
}

} // namespace meshtween
