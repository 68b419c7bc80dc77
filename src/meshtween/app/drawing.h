// One shape with its light and its shadow, drawn on a canvas.
#pragma once

#include "meshtween/app/preview.h"
#include "meshtween/app/raster.h"
#include "meshtween/app/stage.h"
#include "meshtween/fit/appearance.h"

namespace meshtween {

// A picture in linear light while it is made: a row a pixel, from the top left.
using Canvas = Eigen::Array<float, Eigen::Dynamic, 3, Eigen::RowMajor>;

Canvas backdrop(int width, int height);

// How a shape looks, or what lies between two looks of it.
struct Dress {
    const Appearance& look;
    const Appearance* other = nullptr;
    float faded = 0; // 1: all of the other
};

// Puts a tile's shape and shadow on the canvas at left, top; tells what is seen at each sample of the tile.
Samples draw_shape(Canvas& canvas, int canvas_width, int left, int top, const Dress& dress, const Shape& shape,
                   const Layout& layout);

Image developed(const Canvas& canvas, int width, int height);

} // namespace meshtween
