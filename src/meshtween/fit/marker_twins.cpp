#include "meshtween/fit/marker_twins.h"

#include "meshtween/fit/symmetry.h"

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

using Eigen::Index;

constexpr double least_agreement = 0.7;  // cosine, between the normals and between the markers' heights
constexpr double apart = 0.02;           // diagonals: an image nearer to a marker is as good as that marker
constexpr double alike = 0.02;           // diagonals: where a shape is further from its image the weight falls away
constexpr double greatest_stretch = 1.5; // of the short way between a marker and another's image
constexpr double least_weight = 0.01;
constexpr double greatest_strain = 0.25; // of what lies between a twin and a marker, if the guess is off by its slack

double nearest(const Points& points, const Point& to) {
    return (points.rowwise() - to).rowwise().norm().minCoeff();
}

// The planes of source and target that belong together, null where none do.
struct Planes {
    const Symmetry *source = nullptr, *target = nullptr;
};

// Markers lie on the same side of both planes, and those on one lie on the other: the cosine between their heights. Of
// several pairs the one that holds for most of both shapes: a body is a little like its mirror image from front to
// back.
Planes matching(const std::vector<Symmetry>& of_source, const std::vector<Symmetry>& of_target, const Points& on_source,
                const Points& on_target) {
    Planes best;
    double most = 0;
    for (const Symmetry& a : of_source)
        for (const Symmetry& b : of_target) {
            if (std::abs(a.plane.normal.dot(b.plane.normal)) < least_agreement) continue;
            double both = 0, sources = 0, targets = 0;
            for (Index k = 0; k < on_source.rows(); ++k) {
                const double s = a.plane.height(on_source.row(k)), t = b.plane.height(on_target.row(k));
                both += s * t, sources += s * s, targets += t * t;
            }
            const double agreement = std::abs(both) / std::max(1e-300, std::sqrt(sources * targets));
            const double fitness = agreement * a.share * b.share;
            if (agreement >= least_agreement && fitness > most) most = fitness, best = {&a, &b};
        }
    return best;
}

double worse(const Symmetry& symmetry, const Point& place, const Point& image) {
    return std::max(asymmetry(symmetry, place), asymmetry(symmetry, image));
}

// Markers that are each other's images on the source, or their own, should be so on the target: by how much they are
// not, the root of the mean square. Along the surface this alone tells.
double error_of_pairs(const Planes& planes, const Points& on_source, const Points& on_target) {
    double squares = 0, pairs = 0;
    for (Index k = 0; k < on_source.rows(); ++k) {
        const Point s = planes.source->plane.image(on_source.row(k)), t = planes.target->plane.image(on_target.row(k));
        Index other = 0;
        const double way = std::sqrt((on_source.rowwise() - s).rowwise().squaredNorm().minCoeff(&other));
        if (way > apart || worse(*planes.source, on_source.row(k), s) > alike ||
            worse(*planes.target, on_target.row(k), t) > alike)
            continue;
        const double off = std::max(0.0, (on_target.row(other) - t).norm() - greatest_stretch * way);
        squares += off * off, ++pairs;
    }
    return pairs > 0 ? std::sqrt(squares / pairs) : 0;
}

} // namespace

std::vector<MarkerTwin> marker_twins(const Points& source, const Triangles& source_triangles, const Points& target,
                                     const Triangles& target_triangles, const ClosestPointIndex& target_index,
                                     const Points& on_source, const Points& on_target) {
    if (on_source.rows() < 3) return {};
    const ClosestPointIndex source_index(source, source_triangles, MeshIs::moving); // made faster, asked little
    const std::vector<Symmetry> of_source = symmetries(source, source_triangles, source_index);
    if (of_source.empty()) return {};
    const std::vector<Symmetry> of_target = symmetries(target, target_triangles, target_index);
    const Planes planes = matching(of_source, of_target, on_source, on_target);
    if (!planes.source) return {};
    const double common = error_of_pairs(planes, on_source, on_target);
    std::vector<MarkerTwin> result;
    for (Index k = 0; k < on_source.rows(); ++k) {
        const Point s = on_source.row(k), t = on_target.row(k);
        const ClosestPoint there = source_index.closest(planes.source->plane.image(s)),
                           beyond = target_index.closest(planes.target->plane.image(t));
        const double a = worse(*planes.source, s, there.position), b = worse(*planes.target, t, beyond.position);
        const double squares = a * a + b * b + there.squared_distance + beyond.squared_distance;
        const double weight = std::exp(-squares / (alike * alike)), slack = std::hypot(2 * std::sqrt(squares), common);
        const double room = slack / greatest_strain;
        if (weight < least_weight || nearest(on_source, there.position) < std::max(apart, room) ||
            nearest(on_target, beyond.position) < room)
            continue;
        result.push_back({there.where, beyond.position, weight, slack});
    }
    return result;
}

} // namespace meshtween
