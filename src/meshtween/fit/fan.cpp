#include "meshtween/fit/fan.h"

#include "meshtween/fit/facing.h"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

namespace meshtween {
namespace {

constexpr double least_area = 0.1; // of the smallest triangle's before
// What a triangle that looks into the target costs by how much it does, and squared distances from it, beside a detour
// in edges.
constexpr double by_cosine = 0.2, by_distance = 0.1;

using Box = Eigen::AlignedBox3d;

double squared_distance(const Pin& pin, const Sheet& s) {
    Point at(0, 0, 0);
    for (int k = 0; k < 3; ++k) at += pin.where.barycentric[k] * s.corners[static_cast<std::size_t>(k)];
    return (at - pin.target).squaredNorm();
}

// `place` is where the target answers, near the next answer. Where it is no less than `most`, any such number.
double wanting(const FanGround& ground, const Fan::Judged& judged, const Point& vertex, int& place,
               double most = std::numeric_limits<double>::infinity()) {
    double cost = 0;
    const Sheet own = judged.blade.with(vertex);
    const auto add = [&](const Sheet& other) {
        if (const auto length = cut_length(other, own)) cost += fault_costs + *length / ground.unit;
    };
    for (const Sheet& other : judged.sheets) add(other);
    for (const Blade& other : judged.fellows) add(other.with(vertex));
    const Point centre = (own.corners[0] + own.corners[1] + own.corners[2]) / 3;
    const double left = most - cost - fault_costs; // for the detour, at most
    const Facing there = facing(centre, own.normal, ground.target, place, ground.unit * std::max(left, 0.0));
    place = there.place;
    if (there.into()) cost += fault_costs + there.detour / ground.unit - by_cosine * there.cosine;
    return cost + by_distance * there.squared_distance / (ground.unit * ground.unit);
}

Blade blade(const Sheet& lies, Eigen::Index vertex) {
    return {lies, static_cast<std::size_t>(std::ranges::find(lies.vertices, vertex) - lies.vertices.begin())};
}

Box widened(const Box& box, double by) {
    return {box.min().array() - by, box.max().array() + by};
}

std::vector<Sheet> near_box(const Points& positions, const Triangles& triangles, std::span<const int> of,
                            const Box& box) {
    std::vector<Sheet> result;
    for (const int t : of) {
        Box own;
        for (int k = 0; k < 3; ++k) own.extend(positions.row(triangles(t, k)).transpose());
        if (box.intersects(own)) result.push_back(sheet(positions, triangles, t));
    }
    return result;
}

bool share_edge(const Sheet& s, const Sheet& t) { // or more
    return std::ranges::count_if(s.vertices,
                                 [&](int i) { return std::ranges::find(t.vertices, i) != t.vertices.end(); }) >= 2;
}

} // namespace

Sheet Blade::with(const Point& vertex) const {
    std::array<Point, 3> corners = lies.corners;
    corners[corner] = vertex;
    return sheet(lies.vertices, corners);
}

Fan fan_around(const FanGround& ground, const Points& positions, Eigen::Index vertex, std::span<const int> sheets,
               double reach) {
    const Triangles& triangles = ground.shell.triangles;
    const auto own_triangles = ground.shell.topology.vertex_triangles[vertex];
    Box around;
    for (const int t : own_triangles) around.extend(sheet(positions, triangles, t).box);
    const std::vector<Sheet> near = near_box(positions, triangles, sheets, widened(around, reach));
    Fan fan;
    fan.blades.reserve(static_cast<std::size_t>(std::ranges::size(own_triangles)));
    fan.least_area = std::numeric_limits<double>::infinity();
    int place = -1;
    for (const int t : own_triangles) {
        Fan::Judged judged{blade(sheet(positions, triangles, t), vertex), {}, {}, {}, 0};
        const Sheet& own = judged.blade.lies;
        const Box box = widened(own.box, reach);
        for (const Sheet& other : near) {
            if (!box.intersects(other.box) || share_edge(own, other)) continue;
            if (std::ranges::find(other.vertices, vertex) == other.vertices.end())
                judged.sheets.push_back(other);
            else
                judged.fellows.push_back(blade(other, vertex));
        }
        const auto triangle_of = [](const Pin& pin) { return pin.where.triangle; };
        for (auto pin = std::ranges::lower_bound(ground.pins, t, {}, triangle_of);
             pin != ground.pins.end() && triangle_of(*pin) == t; ++pin)
            judged.pins.push_back(*pin);
        for (const Pin& pin : judged.pins) fan.pins_off += squared_distance(pin, own);
        judged.wanting = wanting(ground, judged, positions.row(vertex), place);
        fan.wanting += judged.wanting;
        fan.least_area = std::min(fan.least_area, own.normal_size);
        fan.blades.push_back(std::move(judged));
    }
    std::ranges::stable_sort(fan.blades, std::greater(), &Fan::Judged::wanting);
    return fan;
}

bool bearable(const Fan& fan, const Point& vertex) {
    double off = 0;
    for (const Fan::Judged& judged : fan.blades) {
        const Sheet moved = judged.blade.with(vertex);
        if (moved.normal_size < least_area * fan.least_area) return false;
        for (const Pin& pin : judged.pins) off += squared_distance(pin, moved);
    }
    return off <= fan.pins_off;
}

double wanting(const FanGround& ground, const Fan& fan, const Point& vertex, double height, double most) {
    double cost = by_distance * height * height / (ground.unit * ground.unit);
    int place = -1;
    for (std::size_t k = 0; k < fan.blades.size() && cost < most; ++k)
        cost += wanting(ground, fan.blades[k], vertex, place, most - cost);
    return cost;
}

} // namespace meshtween
