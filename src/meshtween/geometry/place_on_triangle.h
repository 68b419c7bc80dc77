// The closest point of one triangle to a point.
#pragma once

#include "meshtween/core/mesh.h"

#include <algorithm>

namespace meshtween {

struct PlaceOnTriangle {
    double v = 0, w = 0; // barycentric coordinates of the second and third corner
    double squared_distance = 0;
};

// The least of the distances to the three edges and, where the query's foot lies inside, to the foot. Each candidate is
// a point of the triangle whatever the rounding, so that slivers and triangles without area need no case of their own.
inline PlaceOnTriangle place_on_triangle(const Point& query, const Point& a, const Point& b, const Point& c) {
    const auto dot = [](const Point& x, const Point& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; };
    const auto cross = [](const Point& x, const Point& y) {
        return Point(x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]);
    };
    const Point ab = b - a, ac = c - a, bc = c - b, ap = query - a, bp = query - b;
    const auto along = [&](const Point& from, const Point& edge) {
        const double length = dot(edge, edge), t = std::clamp(dot(from, edge), 0.0, length);
        return length > 0 ? t / length : 0.0;
    };
    const auto squared = [&](const Point& x) { return dot(x, x); };
    PlaceOnTriangle best;
    const auto offer = [&](double v, double w, double d) {
        if (d < best.squared_distance) best = {v, w, d};
    };
    const double on_ab = along(ap, ab), on_ac = along(ap, ac), on_bc = along(bp, bc);
    best = {on_ab, 0, squared(ap - on_ab * ab)};
    offer(0, on_ac, squared(ap - on_ac * ac));
    offer(1 - on_bc, on_bc, squared(bp - on_bc * bc));
    const Point n = cross(ab, ac);
    const double nn = squared(n), v = dot(cross(ap, ac), n), w = dot(cross(ab, ap), n);
    if (nn > 0 && v >= 0 && w >= 0 && v + w <= nn) offer(v / nn, w / nn, squared(ap - (v / nn) * ab - (w / nn) * ac));
    return best;
}

} // namespace meshtween
