#include "meshtween/morph/methods.h"

namespace meshtween {

Morph linear_morph(const Points& from, const Points& to) {
    return {[from, to](double u) -> Points { return (1 - u) * from + u * to; },
            [from, to](const Eigen::VectorXd& u, double) -> Points { return from + u.asDiagonal() * (to - from); },
            [] { return SolveReport{}; }};
}

} // namespace meshtween
