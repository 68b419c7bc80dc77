#include "meshtween/geometry/sample_makers.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/subdivide.h"
#include "meshtween/geometry/surface_lookup.h"

namespace meshtween {

Sample pair_of(const SampleParts& parts, int subdivisions) {
    Sample sample;
    sample.source = subdivide(parts.source, subdivisions);
    sample.target = subdivide(parts.target, subdivisions);
    const Points rest = sample.source.positions;
    sample.source.positions = parts.to_source(rest);
    sample.target.positions = parts.to_target(sample.target.positions);
    const auto lookup = [](const Mesh& mesh) { return SurfaceLookup(mesh, 0.01 * diagonal(mesh)); };
    const SurfaceLookup on_target = lookup(sample.target);
    sample.truth = on_target.closest(parts.to_target(rest));
    sample.marker_names = parts.names;
    sample.marker_source = lookup(sample.source).closest(parts.to_source(parts.marks));
    sample.marker_target = on_target.closest(parts.to_target(parts.marks));
    return sample;
}

} // namespace meshtween
