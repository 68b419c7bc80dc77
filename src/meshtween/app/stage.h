// Where shapes and camera stand on a contact sheet.
#pragma once

#include "meshtween/app/light.h"
#include "meshtween/app/preview.h"

#include <vector>

namespace meshtween {

constexpr int supersample = 3;     // samples a pixel, each way
constexpr double eye_distance = 7; // from a tile's origin, in radii of the largest shape

// One camera for all tiles. A tile's origin is the middle of its shape's box, on the ground.
struct Camera {
    ViewAxes axes;
    double distance = 1; // from the origin to the eye
    double scale = 1;    // samples a unit at the origin's distance
    double x = 0, y = 0; // the origin's place on the tile, in samples

    Eigen::Vector3d eye() const { return axes.row(2).transpose() * distance; }
    // To x, y in samples and the distance along the view.
    Eigen::Vector3d project(const Eigen::Vector3d& p) const {
        const Eigen::Vector3d q = axes * p;
        const double away = distance - q[2], s = scale * distance / away;
        return {x + q[0] * s, y - q[1] * s, away};
    }
};

struct Layout {
    Camera camera;
    int width = 0, height = 0; // of a tile without its caption, pixels
    int caption = 0;           // the caption's height
    int margin = 0;            // around the sheet
    int columns = 1, rows = 1;
};

// A tile's shape as it stands on the sheet.
struct Shape {
    Points positions; // relative to the tile's origin, in the sheet's unit
    Triangles triangles;
    Point origin{0, 0, 0};      // in the mesh's coordinates
    double unit = 1;            // the sheet's units in one of the mesh's
    std::vector<int> kept = {}; // a triangle: its number in the mesh; empty where all are there
};

// All shapes on the ground, at one scale; but where their sizes differ so much that one could not be seen (metres and
// millimetres), each as large as the largest. What is not finite is left out.
std::vector<Shape> grounded(const std::vector<Tile>& tiles);

// Scale and places such that every tile's shape fits.
Layout lay_out(const std::vector<Shape>& shapes, const SheetOptions& options);

} // namespace meshtween
