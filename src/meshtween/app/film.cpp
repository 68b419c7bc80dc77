#include "meshtween/app/film.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/measure.h"

#include <fmt/format.h>

namespace meshtween {

Film::Film(const Mesh& mesh, const std::vector<Points>& examples, int size, const Mesh* other)
    : mesh_(&mesh), look_(mesh) {
    if (other != nullptr) other_.emplace(*other);
    if (examples.empty()) throw Error(ErrorKind::argument, "a film needs at least one shape");
    if (size < 16 || size > 8192)
        throw Error(ErrorKind::argument, fmt::format("a picture of {} pixels: 16 to 8192 can be drawn", size));
    Eigen::AlignedBox3d box;
    for (const Points& p : examples) box.extend(bounding_box(p, mesh.triangles));
    origin_ = box.center().transpose();
    std::vector<Shape> shapes;
    for (const Points& p : examples) shapes.push_back(placed(p, mesh.triangles));
    layout_ = lay_out(shapes, {.tile = size, .columns = 1});
}

Shape Film::placed(const Points& positions, const Triangles& triangles) const {
    const Eigen::AlignedBox3d box = bounding_box(positions, triangles);
    Point origin = origin_;
    origin[1] = box.min().y();
    Points inside = positions; // vertices of no face may lie anywhere
    for (int k = 0; k < 3; ++k) inside.col(k) = positions.col(k).cwiseMax(box.min()[k]).cwiseMin(box.max()[k]);
    return {inside.rowwise() - origin, triangles, origin, 1};
}

Image Film::frame(const Points& positions, double faded) const {
    const int height = layout_.height + layout_.caption;
    Canvas canvas = backdrop(layout_.width, height);
    const Dress dress{look_, other_ ? &*other_ : nullptr, static_cast<float>(faded)};
    draw_shape(canvas, layout_.width, 0, 0, dress, placed(positions, mesh_->triangles), layout_);
    return developed(canvas, layout_.width, height);
}

} // namespace meshtween
