#include "meshtween/app/usd_morph.h"

#include "meshtween/app/export.h"
#include "meshtween/io/usd_write.h"

namespace meshtween {
namespace {

// Weights of degree 1 blend two neighbours: node k is whole at its own knot.
std::vector<float> stops_of(const Curve& curve) {
    std::vector<float> stops;
    if (curve.basis.degree != 1 || curve.nodes.size() < 3) return stops;
    for (std::size_t k = 1; k < curve.nodes.size(); ++k) stops.push_back(static_cast<float>(curve.basis.knots[k + 1]));
    return stops;
}

} // namespace

std::vector<std::string> write_morph_usd(const Mesh& mesh, const Curve& curve, const WeightKeys& keys,
                                         const std::filesystem::path& path, const WriteOptions& options) {
    Mesh base = mesh;
    base.positions = curve.nodes.front();
    const std::vector<Points> normals = control_normals(curve, mesh.triangles);
    UsdMorph morph;
    morph.shapes = std::span(curve.nodes).subspan(1);
    morph.normals = normals;
    morph.names = shape_names(curve);
    morph.times = keys.times;
    morph.weights = keys.weights;
    morph.stops = stops_of(curve);
    return write_usd(base, morph, path, options);
}

} // namespace meshtween
