// Williams 1978, Casting curved shadows on curved surfaces: one depth map a light. An area light, and the dome, are
// many small lights (Heckbert and Herf 1997, Simulating soft shadows with graphics hardware).
#include "meshtween/app/light.h"

#include "meshtween/app/raster.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/geometry/weld.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meshtween {
namespace {

constexpr int map_side = 448;      // of a shadow map
constexpr int dome_lights = 56;    // directions over the whole sphere
constexpr int key_lights = 20;     // over the key's softbox
constexpr double key_radius = 0.2; // of the softbox, as the sine of the angle at which it is seen
constexpr int batch = 8;           // maps alive at once

struct SmallLight {
    Eigen::Vector3d towards; // unit, from the shape to the light
    Eigen::Vector3f radiance;
    bool key = false;
};

Eigen::Vector3d key_direction(const ViewAxes& view) {
    return (view.transpose() * Eigen::Vector3d(-0.62, 0.74, 0.50)).normalized();
}

// Points k of n spread evenly over the unit sphere.
Eigen::Vector3d fibonacci(int k, int n) {
    const double y = 1 - (2 * k + 1.0) / n, around = k * std::numbers::pi * (3 - std::sqrt(5.0));
    const double radius = std::sqrt(1 - y * y);
    return {radius * std::cos(around), y, radius * std::sin(around)};
}

// A light floor, a brighter ceiling, and a large dim panel at the right that fills the key's shadows.
Eigen::Vector3f dome_radiance(const Eigen::Vector3d& towards, const ViewAxes& view) {
    const auto height = static_cast<float>(towards.y());
    const Eigen::Vector3f floor(0.26F, 0.235F, 0.21F), wall(0.24F, 0.26F, 0.29F), ceiling(0.40F, 0.44F, 0.50F);
    const Eigen::Vector3f fill(0.26F, 0.27F, 0.30F);
    const auto right =
        static_cast<float>(std::max(0.0, towards.dot(view.transpose() * Eigen::Vector3d(0.8, 0.1, 0.6))));
    const Eigen::Vector3f base = height > 0 ? Eigen::Vector3f(wall + height * (ceiling - wall))
                                            : Eigen::Vector3f(wall + -height * (floor - wall));
    return base + right * right * fill;
}

std::vector<SmallLight> studio(const ViewAxes& view, Eigen::Index triangle_count) {
    // A large mesh covers a map with many triangles a sample: fewer maps keep the time in hand.
    const double share =
        std::clamp(400000.0 / static_cast<double>(std::max<Eigen::Index>(1, triangle_count)), 0.3, 1.0);
    const int dome = static_cast<int>(dome_lights * share), keys = static_cast<int>(key_lights * share);
    std::vector<SmallLight> lights;
    for (int k = 0; k < dome; ++k) {
        const Eigen::Vector3d towards = fibonacci(k, dome);
        lights.push_back({towards, dome_radiance(towards, view) * (4.0F / static_cast<float>(dome)), false});
    }
    const Eigen::Vector3d key = key_direction(view);
    const Eigen::Vector3d side = key.unitOrthogonal(), other = key.cross(side);
    for (int k = 0; k < keys; ++k) { // Vogel's sunflower over the softbox
        const double radius = key_radius * std::sqrt((k + 0.5) / keys);
        const double around = k * std::numbers::pi * (3 - std::sqrt(5.0));
        const Eigen::Vector3d towards = key + radius * (std::cos(around) * side + std::sin(around) * other);
        lights.push_back({towards.normalized(), Eigen::Vector3f(1.10F, 1.04F, 0.95F) / static_cast<float>(keys), true});
    }
    return lights;
}

// The map of a light: the shape seen from it, whole, on map_side x map_side samples.
struct ShadowMap {
    Eigen::Matrix3d axes; // rows: right, down, away from the light
    Eigen::Vector3d centre;
    double scale = 1; // samples a unit
    std::vector<float> depth;

    Eigen::Vector3d project(const Eigen::Vector3d& p) const {
        const Eigen::Vector3d q = axes * (p - centre) * scale;
        return {q[0] + map_side * 0.5, q[1] + map_side * 0.5, q[2]};
    }

    // The share of the four samples around p that see the light; lets nothing lie in its own shadow within `slack`.
    float seen(const Eigen::Vector3d& p, double slack) const {
        const Eigen::Vector3d q = project(p);
        const double x = q[0] - 0.5, y = q[1] - 0.5;
        if (!(x >= 0 && y >= 0 && x < map_side - 1 && y < map_side - 1)) return 1;
        const int left = static_cast<int>(x), top = static_cast<int>(y);
        const auto fx = static_cast<float>(x - left), fy = static_cast<float>(y - top);
        const float* row = depth.data() + static_cast<std::ptrdiff_t>(top) * map_side + left;
        const auto limit = static_cast<float>(q[2] - slack);
        const auto open = [&](float d) { return d >= limit ? 1.0F : 0.0F; };
        return (1 - fy) * ((1 - fx) * open(row[0]) + fx * open(row[1])) +
               fy * ((1 - fx) * open(row[map_side]) + fx * open(row[map_side + 1]));
    }
};

ShadowMap shadow_map(const Points& positions, const Triangles& triangles, const Eigen::Vector3d& towards) {
    ShadowMap map;
    const Eigen::Vector3d right = towards.unitOrthogonal();
    map.axes << right.transpose(), towards.cross(right).transpose(), -towards.transpose();
    const Eigen::AlignedBox3d box = bounding_box(positions, triangles);
    map.centre = box.center();
    map.scale = (map_side - 4) / std::max(1e-300, box.diagonal().norm());
    Points screen(positions.rows(), 3);
    for (Eigen::Index i = 0; i < positions.rows(); ++i)
        screen.row(i) = map.project(positions.row(i).transpose()).transpose();
    map.depth = depth_map(screen, triangles, map_side);
    return map;
}

} // namespace

ViewAxes view_axes(double azimuth_degrees, double elevation_degrees) {
    const double a = azimuth_degrees * std::numbers::pi / 180, e = elevation_degrees * std::numbers::pi / 180;
    ViewAxes axes;
    axes << std::cos(a), 0, -std::sin(a),                                    //
        -std::sin(a) * std::sin(e), std::cos(e), -std::cos(a) * std::sin(e), //
        std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e);
    return axes;
}

std::vector<Lit> light(const std::vector<SurfaceSpot>& places, const Points& positions, const Triangles& triangles,
                       const ViewAxes& view) {
    std::vector<Lit> result(places.size());
    const std::vector<SmallLight> lights = studio(view, triangles.rows());
    const auto keys = static_cast<float>(std::count_if(lights.begin(), lights.end(), [](auto& l) { return l.key; }));
    std::vector<ShadowMap> maps(batch);
    for (std::size_t first = 0; first < lights.size(); first += batch) {
        const std::size_t count = std::min<std::size_t>(batch, lights.size() - first);
        const auto draw = [&](std::ptrdiff_t k) {
            const auto i = static_cast<std::size_t>(k);
            maps[i] = shadow_map(positions, triangles, lights[first + i].towards);
        };
        parallel_for(static_cast<std::ptrdiff_t>(count), draw, 1);
        parallel_for(static_cast<std::ptrdiff_t>(places.size()), [&](std::ptrdiff_t p) {
            const SurfaceSpot& place = places[static_cast<std::size_t>(p)];
            Lit& lit = result[static_cast<std::size_t>(p)];
            for (std::size_t k = 0; k < count; ++k) {
                const SmallLight& source = lights[first + k];
                const double cosine = place.normal.dot(source.towards);
                if (cosine <= 0) continue;
                // A step off the surface and some depth: what the map's samples cannot resolve is no shadow.
                const Eigen::Vector3d from = place.position + place.normal * (1.5 / maps[k].scale);
                const float seen = maps[k].seen(from, 0.5 + 1.5 * std::sqrt(1 - cosine * cosine));
                (source.key ? lit.softbox : lit.dome) += source.radiance * static_cast<float>(cosine) * seen;
                if (source.key) lit.key += seen / keys;
            }
        });
    }
    return result;
}

Eigen::Vector3f shade(const SurfaceSpot& place, const Lit& lit, const Eigen::Vector3f& albedo,
                      const Eigen::Vector3d& to_eye, const ViewAxes& view) {
    const Eigen::Vector3d half = (key_direction(view) + to_eye).normalized();
    const double facing = std::max(0.0, place.normal.dot(to_eye));
    const double gloss = std::pow(std::max(0.0, place.normal.dot(half)), 36) * 0.10 * lit.key;
    const Eigen::Vector3d behind = (view.transpose() * Eigen::Vector3d(0.75, 0.45, -0.6)).normalized();
    const double rim = std::pow(1 - facing, 3) * std::max(0.0, 0.25 + 0.75 * place.normal.dot(behind)) * 0.55;
    const auto added = static_cast<float>(gloss + rim);
    return albedo.cwiseProduct(lit.dome + lit.softbox) + Eigen::Vector3f(added, added, added * 1.04F);
}

CornerNormals corner_normals(const Points& positions, const Triangles& given, double sharp_degrees) {
    const Weld found = weld({positions, given, {}, {}, {}}); // smooth across the seams of a file
    const Triangles triangles = found.any() ? found.by_first() : given;
    CornerNormals result(triangles.rows(), 9);
    const Points faces = triangle_normals(positions, triangles);
    const Lists around = topology(positions.rows(), triangles).vertex_triangles;
    const double limit = std::cos(sharp_degrees * std::numbers::pi / 180);
    parallel_for(triangles.rows(), [&](std::ptrdiff_t t) {
        for (int c = 0; c < 3; ++c) {
            Point sum(0, 0, 0);
            for (const int f : around[triangles(t, c)])
                if (faces.row(f).dot(faces.row(t)) > limit || f == t)
                    sum += double_area_normal(positions, triangles, f);
            const double length = sum.norm();
            result.block<1, 3>(t, 3 * c) = (length > 0 ? Point(sum / length) : Point(0, 1, 0)).cast<float>();
        }
    });
    return result;
}

} // namespace meshtween
