#include "meshtween/fit/rotate.h"

#include "meshtween/core/error.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace meshtween {

Points rotate(const Points& positions, const Points& turning, const Points& holding, const Point& axis,
              const Point& centre, double angle, const RotateOptions& options) {
    if (!(axis.norm() > 0) || !axis.allFinite())
        throw Error(ErrorKind::argument, "the axis has no length; give a direction such as 0,1,0");
    if (!std::isfinite(angle) || !centre.allFinite())
        throw Error(ErrorKind::argument, "the angle and the centre of a rotation must be finite numbers");
    if (!(options.max_step > 0)) throw Error(ErrorKind::argument, "the largest step of a rotation must be positive");

    const int steps = static_cast<int>(std::ceil(std::abs(angle) / options.max_step));
    if (steps == 0) return positions;
    const Eigen::AngleAxisd turn(angle / steps * std::numbers::pi / 180, axis.transpose().normalized());
    const Eigen::Matrix3d by_rows = turn.toRotationMatrix().transpose(); // points are rows

    Points from(turning.rows() + holding.rows(), 3), to(from.rows(), 3);
    from << turning, holding;
    Points result = positions;
    for (int step = 0; step < steps; ++step) {
        to = from;
        to.topRows(turning.rows()) = ((from.topRows(turning.rows()).rowwise() - centre) * by_rows).rowwise() + centre;
        result = warp(from, to, options.warp)(result);
        from = to;
    }
    return result;
}

} // namespace meshtween
