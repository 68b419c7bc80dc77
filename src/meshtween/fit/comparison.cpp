#include "meshtween/fit/comparison.h"

#include "meshtween/geometry/measure.h"

namespace meshtween {

Comparison::Comparison(const Mesh& fitted_mesh, const Mesh& target_mesh)
    : fitted(fitted_mesh), target(target_mesh), diagonal(meshtween::diagonal(target.positions)), on_fitted(fitted),
      on_target(target), vertices(on_target.closest(fitted.positions)) {}

} // namespace meshtween
