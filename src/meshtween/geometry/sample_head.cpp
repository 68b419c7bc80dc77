// A pair of stylised heads: one sculpted body, and the space around it bulged, squeezed and turned for the other.
#include "meshtween/geometry/isosurface.h"
#include "meshtween/geometry/landmarks.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/remesh.h"
#include "meshtween/geometry/sample_makers.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/geometry/surface_lookup.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meshtween {
namespace {

void add_skull(Sculpture& head) {
    head.add(ellipsoid({0, 0.10, -0.04}, {0.330, 0.400, 0.425}), 0.1);
    head.add(ellipsoid({0, -0.15, 0.140}, {0.240, 0.365, 0.268}), 0.16);
    head.add_pair(ellipsoid({0.155, -0.300, 0.07}, {0.075, 0.110, 0.150}, 20), 0.15);
    head.add(ellipsoid({0, -0.440, 0.285}, {0.080, 0.060, 0.080}), 0.13);
    head.add_pair(ellipsoid({0.165, -0.105, 0.255}, {0.075, 0.060, 0.085}), 0.11);
    head.add(round_cone({0, -0.98, -0.10}, 0.25, {0, -0.25, -0.06}, 0.205), 0.14);
    head.add(ellipsoid({0, -1.02, -0.09}, {0.46, 0.15, 0.30}), 0.25);
    head.floor(-1.05, 0.06);
}

void add_face(Sculpture& head) {
    head.add_pair(ellipsoid({0.112, 0.072, 0.316}, {0.105, 0.036, 0.058}), 0.13);
    head.carve_pair(ellipsoid({0.128, -0.005, 0.430}, {0.080, 0.050, 0.060}), 0.07);
    head.add_pair(ellipsoid({0.126, -0.012, 0.312}, {0.066, 0.052, 0.056}), 0.025);
    head.add(round_cone({0, 0.070, 0.372}, 0.028, {0, -0.125, 0.462}, 0.040), 0.075);
    head.add_pair(ellipsoid({0.044, -0.142, 0.425}, {0.032, 0.028, 0.042}), 0.035);
    head.add_pair(ellipsoid({0.034, -0.258, 0.378}, {0.062, 0.020, 0.042}), 0.030);
    head.add(ellipsoid({0, -0.302, 0.376}, {0.068, 0.026, 0.044}), 0.030);
    head.add_pair(ellipsoid({0.318, -0.025, -0.05}, {0.036, 0.128, 0.080}, -14), 0.07);
    head.carve_pair(ellipsoid({0.372, -0.015, -0.035}, {0.032, 0.080, 0.042}, -14), 0.03);
}

void add_hair(Sculpture& head) {
    head.add(ellipsoid({0, 0.185, -0.095}, {0.352, 0.368, 0.430}, -12), 0.02);
    head.add(ellipsoid({0, 0.14, -0.545}, {0.150, 0.145, 0.125}), 0.05);
}

Sculpture head_body() {
    Sculpture head;
    add_skull(head);
    add_face(head);
    add_hair(head);
    return head;
}

std::vector<LandmarkSpot> head_places() {
    const Point up(0, 1, 0), down(0, -1, 0), ahead(0, 0, 1), back(0, 0, -1), out(1, 0, 0);
    return {
        {"crown", {0, 0.2, -0.05}, up},
        {"forehead", {0, 0.17, 0.1}, ahead},
        {"nasion", {0, 0.045, 0.2}, ahead},
        {"nose_tip", {0, -0.125, 0.3}, ahead},
        {"nose_base", {0, -0.185, 0.2}, ahead},
        {"upper_lip", {0, -0.258, 0.2}, ahead},
        {"mouth", {0, -0.281, 0.2}, ahead},
        {"lower_lip", {0, -0.302, 0.2}, ahead},
        {"chin", {0, -0.440, 0.2}, {0, -0.2, 1}},
        {"throat", {0, -0.62, 0}, ahead},
        {"nape", {0, -0.5, -0.1}, back},
        {"bun", {0, 0.14, -0.5}, back},
        {"bun_top", {0, 0.14, -0.545}, {0, 1, -0.1}},
        {"base_front", {0, -0.99, 0}, ahead},
        {"base_back", {0, -0.99, -0.1}, back},
        {"base", {0, -0.95, -0.1}, down},
        {"eye", {0.126, -0.012, 0.25}, ahead, true},
        {"eye_inner", {0.062, -0.012, 0.2}, ahead, true},
        {"eye_outer", {0.190, -0.012, 0.15}, ahead, true},
        {"brow", {0.125, 0.075, 0.2}, ahead, true},
        {"cheekbone", {0.165, -0.105, 0.2}, {0.5, 0, 1}, true},
        {"nose_wing", {0.044, -0.142, 0.40}, {1, 0, 0.35}, true},
        {"mouth_corner", {0.085, -0.281, 0.2}, ahead, true},
        {"jaw", {0.155, -0.310, 0.05}, {1, -0.3, 0}, true},
        {"ear_top", {0.322, 0.03, -0.06}, {0.1, 1, -0.2}, true},
        {"ear_lobe", {0.322, -0.08, -0.04}, {0.1, -1, 0.2}, true},
        {"temple", {0.1, 0.10, 0.10}, out, true},
        {"base_side", {0.1, -0.99, -0.09}, out, true},
    };
}

// Moves what lies near `middle` by `move` and stretches it about that point.
struct Bulge {
    Point middle;
    double reach;
    Point move{0, 0, 0}, stretch{0, 0, 0};
    bool pair = false;
};

Point bulged(const Point& p, const std::vector<Bulge>& bulges) {
    Point moved = p;
    for (const Bulge& b : bulges)
        for (const double side : {1.0, -1.0}) {
            if (side < 0 && !b.pair) continue;
            const Point q(side * p[0], p[1], p[2]), away = q - b.middle;
            const Point d =
                std::exp(-away.squaredNorm() / (b.reach * b.reach)) * (b.move + b.stretch.cwiseProduct(away));
            moved += Point(side * d[0], d[1], d[2]);
        }
    return moved;
}

// Slender: a finer jaw and nose, fuller lips, larger eyes.
const std::vector<Bulge> slender{
    {{0, -0.36, 0.15}, 0.25, {0, 0.01, 0}, {-0.12, 0, 0}},
    {{0, -0.05, 0.43}, 0.12, {0, 0, -0.012}, {-0.15, 0, 0}},
    {{0, -0.70, -0.08}, 0.25, {0, 0, 0}, {-0.20, 0, -0.16}},
    {{0.126, -0.012, 0.33}, 0.09, {0, 0.004, 0.006}, {0.10, 0.20, 0}, true},
    {{0, -0.280, 0.40}, 0.07, {0, 0, 0.006}, {0, 0.25, 0}},
};

// Rugged: a heavy brow and jaw, a long nose, large ears, a thick neck, the bun drawn in to the hair.
const std::vector<Bulge> rugged{
    {{0, -0.40, 0.20}, 0.24, {0, -0.030, 0.025}, {0.26, 0.10, 0}},
    {{0, -0.07, 0.44}, 0.13, {0, -0.020, 0.045}, {0.22, 0.15, 0}},
    {{0.12, 0.075, 0.36}, 0.12, {0, -0.008, 0.028}, {0, 0, 0}, true},
    {{0.33, -0.03, -0.05}, 0.16, {0.022, 0, 0}, {0.20, 0.20, 0.20}, true},
    {{0, -0.70, -0.08}, 0.28, {0, 0, 0}, {0.22, 0, 0.16}},
    {{0, 0.15, -0.55}, 0.22, {0, 0.02, 0.07}, {-0.30, -0.30, -0.25}},
    {{0, 0.30, 0.20}, 0.30, {0, -0.03, -0.035}, {0, 0, 0}},
    {{0, -0.280, 0.40}, 0.08, {0, -0.006, -0.010}, {0.18, -0.20, 0}},
    {{0.17, -0.20, 0.22}, 0.13, {-0.012, 0, -0.022}, {0, 0, 0}, true},
};

Points slender_head(const Points& rest) {
    Points moved(rest.rows(), 3);
    for (Eigen::Index i = 0; i < rest.rows(); ++i) moved.row(i) = bulged(rest.row(i), slender);
    return moved;
}

constexpr double degree = std::numbers::pi / 180, nod = 8 * degree, look_aside = 22 * degree, larger = 1.06;
const Point pivot(0, -0.55, -0.08);

// Turned to its left and nodding, the base held.
Points rugged_head(const Points& rest) {
    Points moved(rest.rows(), 3);
    for (Eigen::Index i = 0; i < rest.rows(); ++i) {
        const double share = smooth_step(-1.0, -0.25, rest(i, 1));
        Points p(1, 3);
        p.row(0) = bulged(rest.row(i), rugged) - pivot;
        moved.row(i) = turn(turn(p, {1, 0, 0}, nod * share), {0, 1, 0}, look_aside * share).row(0) + pivot;
    }
    return larger * moved;
}

// What a scanner in front of the rugged head has seen of it, a flag a point: the face as far as the ears, without a
// hole in one cheek.
std::vector<char> seen_from_front(const Points& points) {
    const Points upright =
        turn(turn((points / larger).rowwise() - pivot, {0, 1, 0}, -look_aside), {1, 0, 0}, -nod).rowwise() + pivot;
    const Point hole(-0.2, -0.25, 0.25);
    std::vector<char> seen;
    for (const auto& p : upright.rowwise())
        seen.push_back(p[2] > 0.05 + 0.03 * std::sin(12 * p[1]) && p[1] > -0.5 && (p - hole).norm() > 0.09);
    return seen;
}

Mesh seen_part(const Mesh& whole) {
    const std::vector<char> seen = seen_from_front(whole.positions);
    std::vector<int> triangles, vertices, number(seen.size(), -1);
    for (int t = 0; t < static_cast<int>(whole.triangles.rows()); ++t)
        if (std::ranges::all_of(whole.triangles.row(t), [&](int i) { return seen[static_cast<std::size_t>(i)] != 0; }))
            triangles.push_back(t);
    Mesh part;
    part.triangles = whole.triangles(triangles, Eigen::all);
    for (int& i : part.triangles.reshaped()) {
        int& own = number[static_cast<std::size_t>(i)];
        if (own < 0) own = static_cast<int>(vertices.size()), vertices.push_back(i);
        i = own;
    }
    part.positions = whole.positions(vertices, Eigen::all);
    return part;
}

void append(Mesh& mesh, const Points& positions, const Triangles& triangles) {
    const auto first = static_cast<int>(mesh.positions.rows());
    const Eigen::Index rows = mesh.triangles.rows();
    mesh.positions.conservativeResize(first + positions.rows(), 3);
    mesh.positions.bottomRows(positions.rows()) = positions;
    mesh.triangles.conservativeResize(rows + triangles.rows(), 3);
    mesh.triangles.bottomRows(triangles.rows()) = (triangles.array() + first).matrix();
}

// Eyeballs that show between the lids, and a row of teeth behind the lips, in the head before it is shaped.
std::vector<Mesh> eyes_and_teeth() {
    std::vector<Mesh> parts;
    const auto add = [&](const Point& centre, double radius, int subdivisions) {
        parts.push_back(sphere(subdivisions));
        parts.back().positions = (radius * parts.back().positions).rowwise() + centre;
    };
    for (const double side : {-1.0, 1.0}) add({0.126 * side, -0.012, 0.27}, 0.075, 3);
    for (int k = 0; k < 8; ++k) {
        const double x = 0.02 * (k - 3.5);
        add({x, -0.28, 0.34 - 3 * x * x}, 0.011, 1);
    }
    return parts;
}

// What a scanner has beside the subject: the table under it, and bits in the air.
void add_surroundings(Mesh& scan) {
    const double low = scan.positions.col(1).minCoeff();
    const Mesh table = bar({2.4, 2.4, 0.02}, {24, 24, 1});
    Points flat(table.positions.rows(), 3);
    for (Eigen::Index i = 0; i < flat.rows(); ++i)
        flat.row(i) << table.positions(i, 0) - 1.2, table.positions(i, 2) + low, -table.positions(i, 1);
    append(scan, flat, table.triangles);
    Triangles one(1, 3);
    one << 0, 1, 2;
    for (int k = 0; k < 20; ++k) {
        const double angle = std::numbers::pi * (3 - std::sqrt(5.0)) * k, height = 0.08 * k - 0.9;
        const Point at((0.7 + 0.02 * k) * std::cos(angle), height, (0.7 + 0.02 * k) * std::sin(angle));
        Points corners(3, 3);
        corners << at, at + Point(0.04, 0, 0.02), at + Point(0, 0.04, 0);
        append(scan, corners, one);
    }
}

} // namespace

Sample head_sample(int subdivisions) {
    const Field body = head_body();
    const Box box{{-0.6, -1.2, -0.8}, {0.6, 0.7, 0.65}}, other{{-0.617, -1.21, -0.814}, {0.6, 0.7, 0.65}};
    const Landmarks marks = landmarks(body, head_places(), 0.8);
    return pair_of(
        {remesh(isosurface(body, box, 0.03), body, {.deviation = 0.0010, .shortest = 0.010, .longest = 0.045}),
         remesh(isosurface(body, other, 0.031), body, {.deviation = 0.0007, .shortest = 0.008, .longest = 0.040}),
         slender_head, rugged_head, marks.names, marks.points},
        subdivisions);
}

Sample scan_sample(int subdivisions) {
    Sample sample = head_sample(subdivisions);
    sample.target = seen_part(sample.target);
    const SurfaceLookup on_part(sample.target, 0.01 * diagonal(sample.target));
    const Points nearest = on_part.closest(sample.marker_target);
    const std::vector<char> seen = seen_from_front(sample.marker_target);
    std::vector<int> kept;
    std::vector<std::string> names;
    for (Eigen::Index m = 0; m < nearest.rows(); ++m)
        if (seen[static_cast<std::size_t>(m)] != 0 && (nearest.row(m) - sample.marker_target.row(m)).norm() < 1e-9) {
            kept.push_back(static_cast<int>(m));
            names.push_back(sample.marker_names[static_cast<std::size_t>(m)]);
        }
    sample.marker_names = names;
    sample.marker_source = Points(sample.marker_source(kept, Eigen::all));
    sample.marker_target = Points(nearest(kept, Eigen::all));
    return sample;
}

Sample bust_sample(int subdivisions) {
    Sample sample = head_sample(subdivisions);
    for (const Mesh& part : eyes_and_teeth()) {
        append(sample.source, slender_head(part.positions), part.triangles);
        const Eigen::Index before = sample.truth.rows();
        sample.truth.conservativeResize(before + part.positions.rows(), 3);
        sample.truth.bottomRows(part.positions.rows()) = rugged_head(part.positions);
    }
    add_surroundings(sample.target);
    return sample;
}

} // namespace meshtween
