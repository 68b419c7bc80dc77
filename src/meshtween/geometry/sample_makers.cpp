#include "meshtween/geometry/sample_makers.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/surface_lookup.h"

namespace meshtween {

Sample pair_of(const SampleParts& parts) {
    Sample sample;
    sample.source = parts.source;
    sample.source.positions = parts.to_source(parts.source.positions);
    sample.target = parts.target;
    sample.target.positions = parts.to_target(parts.target.positions);
    const auto lookup = [](const Mesh& mesh) { return SurfaceLookup(mesh, 0.01 * diagonal(mesh.positions)); };
    const SurfaceLookup on_target = lookup(sample.target);
    sample.truth = on_target.closest(parts.to_target(parts.source.positions));
    sample.marker_names = parts.names;
    sample.marker_source = lookup(sample.source).closest(parts.to_source(parts.marks));
    sample.marker_target = on_target.closest(parts.to_target(parts.marks));
    return sample;
}

} // namespace meshtween
