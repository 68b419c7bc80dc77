#include "meshtween/fit/comparison.h"

#include "meshtween/geometry/measure.h"

namespace meshtween {

Comparison::Comparison(const Mesh& fitted_mesh, const Mesh& target_mesh, bool with_weld)
    : fitted(fitted_mesh), target(target_mesh), weld(with_weld), diagonal(meshtween::diagonal(target)),
      fitted_seams(weld ? seams(fitted) : Weld()), target_seams(weld ? seams(target) : Weld()), on_fitted(fitted),
      on_target(target), vertices(on_target.closest(fitted.positions)) {}

} // namespace meshtween
