// Eq. 9 of Yoo, Three-dimensional Morphing of Similar Shapes Using a Template Mesh.
#include "meshtween/morph/laplacian_coordinates.h"

#include "meshtween/core/parallel.h"

namespace meshtween {
namespace {

Point direction(const Point& delta, double length) {
    return length > 0 ? Point(delta / length) : Point::Zero().eval();
}

} // namespace

Points blended_coordinates(const Points& from, const Points& to, double u) {
    return blended_coordinates(from, to, Eigen::VectorXd::Constant(from.rows(), u));
}

Points blended_coordinates(const Points& from, const Points& to, const Eigen::VectorXd& u) {
    Points blended(from.rows(), 3);
    parallel_for(from.rows(), [&](Eigen::Index i) {
        const Point s = from.row(i), t = to.row(i);
        const double length_s = s.norm(), length_t = t.norm();
        const Point unit = (1 - u[i]) * direction(s, length_s) + u[i] * direction(t, length_t); // Eq. 9a
        const double length = (1 - u[i]) * length_s + u[i] * length_t;                          // Eq. 9b
        blended.row(i) = length * unit;                                                         // Eq. 9c
    });
    return blended;
}

Points middle_coordinates(const Points& from, const Points& to) {
    Points middle(from.rows(), 3);
    parallel_for(from.rows(), [&](Eigen::Index i) {
        const Point s = from.row(i), t = to.row(i);
        const double length_s = s.norm(), length_t = t.norm();
        middle.row(i) = (length_s * direction(t, length_t) + length_t * direction(s, length_s)) / 2;
    });
    return middle;
}

Points quadratic(const Points& from, const Points& middle, const Points& to, double u) {
    const double v = 1 - u;
    return v * v * from + 2 * u * v * middle + u * u * to;
}

Points quadratic(const Points& from, const Points& middle, const Points& to, const Eigen::VectorXd& u) {
    const Eigen::ArrayXd v = 1 - u.array();
    return v.square().matrix().asDiagonal() * from + (2 * u.array() * v).matrix().asDiagonal() * middle +
           u.array().square().matrix().asDiagonal() * to;
}

} // namespace meshtween
