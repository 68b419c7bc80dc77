// Bodies as the inside of a function: negative inside, positive outside, about the distance near the surface.
#pragma once

#include "meshtween/core/mesh.h"

#include <functional>
#include <vector>

namespace meshtween {

using Field = std::function<double(const Point&)>;

// min(a, b) with the crease rounded where they differ by less than `blend`; twice continuously differentiable.
double smooth_min(double a, double b, double blend);

// Rises smoothly from 0 at `from` to 1 at `to`, with no slope at either end.
double smooth_step(double from, double to, double x);

// The field's gradient by differences over `step`. 1 x 3.
Point gradient(const Field& field, const Point& at, double step);

// The nearby point where the field is nought, by a few Newton steps along the gradient.
Point onto_surface(const Field& field, Point at, double step, int rounds = 3);

// Where the ray from a point inside leaves the body for the last time within `reach`.
Point shoot(const Field& field, const Point& inside, const Point& direction, double reach);

// What part of a body: its distance, and a ball that holds it (nothing is asked of it far outside).
struct Part {
    Field distance;
    Point centre{0, 0, 0};
    double radius = 0;
};

Part ellipsoid(const Point& centre, const Point& radii);

// An ellipsoid turned by `degrees` about the x axis (y towards z).
Part ellipsoid(const Point& centre, const Point& radii, double degrees);

// The hull of two balls.
Part round_cone(const Point& from, double from_radius, const Point& to, double to_radius);

// A cross-section of a loft: `at` along the axis, its half width to the sides, its depth to the front and the back, and
// by how much its middle lies in front of the axis.
struct Section {
    double at = 0, width = 0, front = 0, back = 0, shift = 0;
};

// A body of elliptic sections along a straight axis, smooth between them, with ends rounded over the given lengths.
// `at` counts from the axis's start (0) to its end (its length).
struct Loft {
    Point from{0, 0, 0}, to{0, 1, 0}, front{0, 0, 1};
    std::vector<Section> sections;
    double start_cap = 0.01, end_cap = 0.01;
};
Part loft(const Loft& shape);

// A body put together from parts, in order, each melted into what is there.
class Sculpture {
public:
    void add(Part part, double blend) { steps_.push_back({std::move(part), blend, false, false}); }
    void add_pair(Part part, double blend) {
        steps_.push_back({std::move(part), blend, true, false});
    } // and its mirror
    void carve_pair(Part part, double blend) { steps_.push_back({std::move(part), blend, true, true}); }
    void carve(Part part, double blend) { steps_.push_back({std::move(part), blend, false, true}); }
    void floor(double height, double blend) { floor_ = height, floor_blend_ = blend; } // cut off below
    double operator()(const Point& p) const;

private:
    struct Step {
        Part part;
        double blend;
        bool mirrored, carved;
    };
    std::vector<Step> steps_;
    double floor_ = -1e9, floor_blend_ = 0.01;
};

} // namespace meshtween
