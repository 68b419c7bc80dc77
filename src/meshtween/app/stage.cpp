#include "meshtween/app/stage.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshtween {
namespace {

constexpr double shadow_room = 0.06; // at the sides of the shapes, parts of their extent

// Moves the middle of the mesh's box, on the ground, to the origin. Leaves out what is not finite.
Shape grounded(const Mesh& mesh) {
    Point low = Point::Constant(std::numeric_limits<double>::infinity()), high = -low;
    std::vector<int> kept;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
        const auto finite = [&](int c) { return mesh.positions.row(mesh.triangles(t, c)).allFinite(); };
        if (!finite(0) || !finite(1) || !finite(2)) continue;
        kept.push_back(static_cast<int>(t));
        for (int c = 0; c < 3; ++c) {
            low = low.cwiseMin(mesh.positions.row(mesh.triangles(t, c)));
            high = high.cwiseMax(mesh.positions.row(mesh.triangles(t, c)));
        }
    }
    Shape shape;
    if (kept.empty()) return shape;
    shape.triangles = mesh.triangles(kept, Eigen::all);
    shape.kept = kept;
    shape.origin << (low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2;
    shape.positions.resizeLike(mesh.positions);
    for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
        const Point p = mesh.positions.row(i);
        const bool inside = (p.array() >= low.array()).all() && (p.array() <= high.array()).all(); // and finite
        shape.positions.row(i) = inside ? Point(p - shape.origin) : Point(0, 0, 0); // else of no triangle
    }
    return shape;
}

double radius(const Shape& shape) {
    return shape.positions.rows() > 0 ? std::sqrt(shape.positions.rowwise().squaredNorm().maxCoeff()) : 0;
}

int columns_for(int count, double width, double height) {
    int best = 1;
    double least = std::numeric_limits<double>::infinity();
    for (int columns = 1; columns <= count; ++columns) {
        const int rows = (count + columns - 1) / columns;
        const double aspect = columns * width / (rows * height);
        const double cost = std::abs(std::log(aspect / 1.8)) + 1.5 * (rows * columns - count) / count;
        if (cost < least) least = cost, best = columns;
    }
    return best;
}

} // namespace

std::vector<Shape> grounded(const std::vector<Tile>& tiles) {
    std::vector<Shape> shapes;
    double least = std::numeric_limits<double>::infinity(), largest = 0;
    for (const Tile& tile : tiles) {
        shapes.push_back(grounded(tile.mesh));
        const double r = radius(shapes.back());
        if (r <= 0) continue;
        least = std::min(least, r);
        largest = std::max(largest, r);
    }
    if (largest <= least * 4) return shapes;
    for (Shape& shape : shapes)
        if (const double r = radius(shape); r > 0) {
            shape.unit = largest / r;
            shape.positions *= shape.unit;
        }
    return shapes;
}

Layout lay_out(const std::vector<Shape>& shapes, const SheetOptions& options) {
    Layout layout;
    layout.camera.axes = view_axes(options.azimuth, options.elevation);
    double largest = 0;
    for (const Shape& shape : shapes) largest = std::max(largest, radius(shape));
    layout.camera.distance = eye_distance * (largest > 0 ? largest : 1);
    Eigen::AlignedBox2d box(Eigen::Vector2d::Zero().eval());
    for (const Shape& shape : shapes)
        for (Eigen::Index i = 0; i < shape.positions.rows(); ++i)
            box.extend(layout.camera.project(shape.positions.row(i).transpose()).head<2>());
    if (box.sizes().maxCoeff() <= 0) box.extend(Eigen::Vector2d(1, -1));
    const double pad = std::max(box.sizes()[1] * shadow_room, box.sizes()[0] * shadow_room);
    box.extend(Eigen::Vector2d(box.min().array() - pad)).extend(Eigen::Vector2d(box.max().array() + pad));
    const double aspect = std::clamp(box.sizes()[0] / box.sizes()[1], 0.5, 2.0);
    layout.width = static_cast<int>(options.tile * std::min(1.0, aspect));
    layout.height = static_cast<int>(options.tile * std::min(1.0, 1 / aspect));
    layout.camera.scale = supersample * std::min(layout.width / box.sizes()[0], layout.height / box.sizes()[1]);
    layout.camera.x = supersample * layout.width * 0.5 - layout.camera.scale * box.center()[0];
    layout.camera.y = supersample * layout.height * 0.5 - layout.camera.scale * box.center()[1];
    layout.caption = static_cast<int>(std::max(30.0, options.tile * 0.13));
    layout.margin = static_cast<int>(options.tile * 0.06);
    const int count = static_cast<int>(shapes.size());
    layout.columns = options.columns > 0 ? std::min(options.columns, count)
                                         : columns_for(count, layout.width, layout.height + layout.caption);
    layout.rows = (count + layout.columns - 1) / layout.columns;
    return layout;
}

} // namespace meshtween
