// Bodies with handles: a pair of rings (genus 1) and a pair of two-handled cups (genus 2).
#include "meshtween/geometry/isosurface.h"
#include "meshtween/geometry/landmarks.h"
#include "meshtween/geometry/remesh.h"
#include "meshtween/geometry/sample_makers.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace meshtween {
namespace {

constexpr double pi = std::numbers::pi;

SpaceMap each(const std::function<Point(const Point&)>& map) {
    return [map](const Points& points) {
        Points moved(points.rows(), 3);
        for (Eigen::Index i = 0; i < points.rows(); ++i) moved.row(i) = map(points.row(i));
        return moved;
    };
}

// The source's mesh and a finer one from another lattice.
std::array<Mesh, 2> two_meshes(const Field& body, const Box& box, double cell, const RemeshOptions& options) {
    RemeshOptions finer = options;
    finer.deviation *= 0.6, finer.shortest *= 0.85, finer.longest *= 0.85;
    const Box other{box.low + 0.4 * cell * Point(1, 0.6, 0.3), box.high};
    return {remesh(isosurface(body, box, cell), body, options),
            remesh(isosurface(body, other, 1.05 * cell), body, finer)};
}

double ring(const Point& p) {
    return std::hypot(std::hypot(p[0], p[2]) - 1, p[1]) - 0.36;
}

// A ring whose tube is scaled and whose middle circle is moved, both along its turn u.
Point reshaped_ring(const Point& p, double thickness, double waves, double lift) {
    const double u = std::atan2(p[0], p[2]);
    const Point middle(std::sin(u), 0, std::cos(u));
    const double tube = thickness * (1 + waves * std::cos(3 * u + 0.5)), reach = 1 + 0.5 * lift * std::cos(2 * u);
    return reach * middle + Point(0, lift * std::sin(2 * u + 0.8), 0) + tube * (p - middle);
}

// A part given by its circle in the plane x-y and the radius of its tube, for handles.
Part handle(const Point& centre, double radius, double tube) {
    const auto distance = [=](const Point& p) {
        const Point q = p - centre;
        return std::hypot(std::hypot(q[0], q[1]) - radius, q[2]) - tube;
    };
    return {distance, centre, radius + tube};
}

constexpr double handle_out = 0.50, handle_up = 0.66, handle_radius = 0.27;

Sculpture cup() {
    const auto round = [](double at, double r) { return Section{at, r, r, r, 0}; };
    Sculpture body;
    body.add(loft({{0, 0.05, 0},
                   {0, 1.20, 0},
                   {0, 0, 1},
                   {round(0, 0.26), round(0.12, 0.33), round(0.35, 0.44), round(0.65, 0.47), round(0.9, 0.455),
                    round(1.15, 0.50)},
                   0.05,
                   0.04}),
             0.01);
    body.add_pair(handle({handle_out, handle_up, 0}, handle_radius, 0.062), 0.09);
    body.carve(loft({{0, 0.22, 0},
                     {0, 1.40, 0},
                     {0, 0, 1},
                     {round(0, 0.26), round(0.15, 0.34), round(0.45, 0.385), round(0.70, 0.375), round(0.95, 0.425),
                      round(1.18, 0.46)},
                     0.09,
                     0.05}),
               0.05);
    body.floor(0.02, 0.04);
    return body;
}

std::vector<LandmarkSpot> cup_places() {
    const Point up(0, 1, 0), down(0, -1, 0);
    std::vector<LandmarkSpot> places{{"bottom", {0, 0.1, 0}, down, false}, {"well", {0, 0.08, 0}, up, false}};
    const auto around = [&](const std::string& name, double radius, double height, double lean, double from) {
        for (int i = 0; i < 4; ++i) {
            const double u = from + pi / 2 * i;
            const Point out(std::sin(u), 0, std::cos(u));
            places.push_back(
                {fmt::format("{}_{}", name, i), radius * out + Point(0, height, 0), out + lean * up, false});
        }
    };
    around("foot", 0.27, 0.10, -1, pi / 4);
    around("belly", 0.42, 0.65, 0, pi / 4);
    around("rim", 0.465, 1.19, 8, pi / 4);
    for (const auto& [name, degrees] : {std::pair("handle_top", 80.0), {"handle_out", 0.0}, {"handle_low", -80.0}}) {
        const Point way(std::cos(degrees * pi / 180), std::sin(degrees * pi / 180), 0);
        const Point inside = Point(handle_out, handle_up, 0) + handle_radius * way;
        places.push_back({name, inside, way, true});
        places.push_back({std::string(name) + "_in", inside, -way, true});
    }
    return places;
}

// Taller, with a full belly and a narrow neck; the handles go out with the belly, and the body turns a little.
Point amphora(const Point& p) {
    const double y = p[1], reach = std::hypot(p[0], p[2]), on_handle = smooth_step(0.46, 0.62, reach);
    const auto belly = [](double height) { return 0.40 * std::exp(-(height - 0.60) * (height - 0.60) / 0.08); };
    const double girth = -0.30 + (1 - on_handle) * belly(y) + on_handle * belly(0.66);
    const double further = 1 + girth * smooth_min(reach, 0.50, 0.10) / std::max(reach, 1e-9);
    const double swing = 0.30 * (y - 0.6) * std::exp(-reach * reach / 0.5), c = std::cos(swing), s = std::sin(swing);
    return {further * (c * p[0] + s * p[2]), 1.40 * y, further * (c * p[2] - s * p[0])};
}

} // namespace

Sample torus_sample(int subdivisions) {
    const auto meshes = two_meshes(ring, {{-1.5, -0.5, -1.5}, {1.5, 0.5, 1.5}}, 0.06,
                                   {.deviation = 0.0025, .shortest = 0.03, .longest = 0.09});
    std::vector<LandmarkSpot> places;
    for (int i = 0; i < 8; ++i) {
        const double u = pi / 4 * i;
        const Point out(std::sin(u), 0, std::cos(u));
        for (const auto& [name, way] :
             {std::pair("outer", out), {"top", Point(0, 1, 0)}, {"inner", -out}, {"bottom", Point(0, -1, 0)}})
            places.push_back({fmt::format("{}_{}", name, 45 * i), out, way, false});
    }
    const Landmarks marks = landmarks(ring, places, 0.6);
    return pair_of({meshes[0], meshes[1], each([](const Point& p) { return reshaped_ring(p, 1, 0.08, 0); }),
                    each([](const Point& p) { return reshaped_ring(p, 0.62, 0.28, 0.22); }), marks.names, marks.points},
                   subdivisions);
}

Sample cup_sample(int subdivisions) {
    const Field body = cup();
    const auto meshes = two_meshes(body, {{-0.95, -0.1, -0.65}, {0.95, 1.35, 0.65}}, 0.03,
                                   {.deviation = 0.0016, .shortest = 0.015, .longest = 0.05});
    const Landmarks marks = landmarks(body, cup_places(), 0.12);
    return pair_of(
        {meshes[0], meshes[1], each([](const Point& p) { return p; }), each(amphora), marks.names, marks.points},
        subdivisions);
}

} // namespace meshtween
