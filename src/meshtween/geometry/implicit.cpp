// Blending after Quilez, "Smooth minimum" (cubic), distances to ellipsoids after the same, "Ellipsoid SDF" (first
// order), to round cones by the profile of two circles and their tangent.
#include "meshtween/geometry/implicit.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meshtween {
namespace {

// First-order distance to the unit level of |q|, q being p over its radii and k1 the gradient's length.
double from_level(double level, double slope, double smallest) {
    return slope > 1e-12 ? level * (level - 1) / slope : -smallest;
}

struct Slopes {
    double width, front, back, shift;
};

// Slopes at the knots as in Catmull and Rom's curves, for knots at any distance.
std::vector<Slopes> slopes(const std::vector<Section>& s) {
    std::vector<Slopes> m(s.size());
    for (std::size_t i = 0; i < s.size(); ++i) {
        const Section &a = s[i > 0 ? i - 1 : 0], &b = s[std::min(i + 1, s.size() - 1)];
        const double h = std::max(b.at - a.at, 1e-12);
        m[i] = {(b.width - a.width) / h, (b.front - a.front) / h, (b.back - a.back) / h, (b.shift - a.shift) / h};
    }
    return m;
}

Section section_at(const std::vector<Section>& s, const std::vector<Slopes>& m, double at) {
    std::size_t i = 0;
    while (i + 2 < s.size() && at > s[i + 1].at) ++i;
    const double h = s[i + 1].at - s[i].at, t = std::clamp((at - s[i].at) / h, 0.0, 1.0);
    const double a = (1 + 2 * t) * (1 - t) * (1 - t), b = t * t * (3 - 2 * t);
    const double c = t * (1 - t) * (1 - t) * h, d = t * t * (t - 1) * h;
    const auto mix = [&](double Section::*f, double Slopes::*g) {
        return a * s[i].*f + b * s[i + 1].*f + c * m[i].*g + d * m[i + 1].*g;
    };
    return {at, mix(&Section::width, &Slopes::width), mix(&Section::front, &Slopes::front),
            mix(&Section::back, &Slopes::back), mix(&Section::shift, &Slopes::shift)};
}

} // namespace

double smooth_min(double a, double b, double blend) {
    const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
    return std::min(a, b) - h * h * h * blend / 6;
}

double smooth_step(double from, double to, double x) {
    const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * t * (t * (6 * t - 15) + 10);
}

Point gradient(const Field& field, const Point& at, double step) {
    // Four points of a tetrahedron give the same order as six along the axes.
    const double e = step / std::numbers::sqrt3;
    Point sum(0, 0, 0);
    for (const Point& d : {Point(1, -1, -1), Point(-1, -1, 1), Point(-1, 1, -1), Point(1, 1, 1)})
        sum += d * field(at + e * d);
    return sum / (4 * e);
}

Point onto_surface(const Field& field, Point at, double step, int rounds) {
    for (int i = 0; i < rounds; ++i) {
        const Point g = gradient(field, at, step);
        at -= field(at) / std::max(g.squaredNorm(), 0.04) * g;
    }
    return at;
}

Point shoot(const Field& field, const Point& inside, const Point& direction, double reach) {
    const Point d = direction.normalized();
    constexpr int steps = 200;
    int last = 0;
    for (int i = 0; i <= steps; ++i)
        if (field(inside + reach * i / steps * d) < 0) last = i;
    double low = reach * last / steps, high = reach * (last + 1) / steps;
    for (int i = 0; i < 50; ++i) {
        const double middle = (low + high) / 2;
        (field(inside + middle * d) < 0 ? low : high) = middle;
    }
    return inside + low * d;
}

Part ellipsoid(const Point& centre, const Point& radii) {
    const auto distance = [=](const Point& p) {
        const Eigen::Array3d q = (p - centre).array().transpose(), r = radii.array().transpose();
        return from_level((q / r).matrix().norm(), (q / (r * r)).matrix().norm(), radii.minCoeff());
    };
    return {distance, centre, radii.maxCoeff()};
}

Part ellipsoid(const Point& centre, const Point& radii, double degrees) {
    const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    Part part = ellipsoid({0, 0, 0}, radii);
    const auto distance = [=, straight = part.distance](const Point& p) {
        const Point q = p - centre;
        return straight({q[0], c * q[1] + s * q[2], -s * q[1] + c * q[2]});
    };
    return {distance, centre, part.radius};
}

Part round_cone(const Point& from, double from_radius, const Point& to, double to_radius) {
    const double length = (to - from).norm(), slope = (from_radius - to_radius) / length;
    const double rise = std::sqrt(std::max(1 - slope * slope, 0.0));
    const Point axis = (to - from) / length;
    const auto distance = [=](const Point& p) {
        const Point q = p - from;
        const double along = q.dot(axis), across = std::sqrt(std::max(q.squaredNorm() - along * along, 0.0));
        const double foot = along * rise - across * slope; // along the tangent line, from its first end
        if (foot < 0) return q.norm() - from_radius;
        if (foot > length * rise * rise / std::max(rise, 1e-9)) return (p - to).norm() - to_radius;
        return across * rise + along * slope - from_radius;
    };
    return {distance, (from + to) / 2, length / 2 + std::max(from_radius, to_radius)};
}

Part loft(const Loft& shape) {
    const double length = (shape.to - shape.from).norm();
    const Point axis = (shape.to - shape.from) / length;
    const Point front = (shape.front - shape.front.dot(axis) * axis).normalized(), side = axis.cross(front);
    const std::vector<Slopes> knots = slopes(shape.sections);
    const auto distance = [=](const Point& p) {
        const Point q = p - shape.from;
        const double h = q.dot(axis), at = std::clamp(h, 0.0, length);
        const Section s = section_at(shape.sections, knots, at);
        const double u = q.dot(side), v = q.dot(front) - s.shift, depth = v > 0 ? s.front : s.back;
        const double e = h - at, cap = e > 0 ? shape.end_cap : shape.start_cap;
        const double level = Point(u / s.width, v / depth, e / cap).norm();
        const double slope = Point(u / (s.width * s.width), v / (depth * depth), e / (cap * cap)).norm();
        return from_level(level, slope, std::min(s.width, depth));
    };
    double reach = 0;
    for (const Section& s : shape.sections)
        reach = std::max(reach, std::hypot(s.width, std::max(s.front, s.back) + std::abs(s.shift)));
    return {distance, (shape.from + shape.to) / 2,
            std::hypot(length / 2 + std::max(shape.start_cap, shape.end_cap), reach)};
}

double Sculpture::operator()(const Point& p) const {
    // |x| rounded off near 0, so that mirrored parts meet without a crease.
    constexpr double roundness = 0.008;
    const Point q(std::sqrt(p[0] * p[0] + roundness * roundness), p[1], p[2]);
    double d = 1e9;
    for (const Step& step : steps_) {
        const Point& at = step.mirrored ? q : p;
        const double least = (at - step.part.centre).norm() - step.part.radius;
        if (step.carved) {
            if (least < step.blend - d) d = -smooth_min(-d, step.part.distance(at), step.blend);
        } else if (least < d + step.blend)
            d = smooth_min(d, step.part.distance(at), step.blend);
    }
    const double below = floor_ - p[1];
    return below > d - floor_blend_ ? -smooth_min(-d, -below, floor_blend_) : d;
}

} // namespace meshtween
