// Pictures painted onto a mesh's own texture coordinates.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/core/progress.h"
#include "meshtween/fit/picture_layout.h"
#include "meshtween/io/image.h"

#include <functional>
#include <span>
#include <vector>

namespace meshtween {

struct BakeOptions {
    int size = 2048; // pixels a side, 16 to 8192
    int margin = 16; // pixels around charts that continue them; the rest is filled smoothly
};

struct Baked {
    std::vector<Image> pictures;
    double twice = 0; // the part of the painted surface that lies on the pictures where another part does already
    bool cancelled = false;
};

// The colours, linear RGB, of places on the mesh. Called from several threads, for a row of pixels at a time.
using Painter = std::function<void(std::span<const SurfacePoint> places, std::span<Eigen::Vector3f> colors)>;

// Each pixel is the mean of the colours at those of its four samples that lie in a triangle, the first one where
// several do; a pixel that triangles only touch takes the colour of the nearest place. `layout` has no problem. The
// same bits for any number of threads. Throws Error(argument) for a size out of range.
Baked bake(const Mesh& mesh, const PictureLayout& layout, const BakeOptions& options, const Painter& paint,
           const Progress& progress = {});

// Pixels that are not covered get the mean of their covered neighbours, `margin` times over; what is left then is
// filled from coarser and coarser means, so that no filter brings in a foreign colour. `covered`: a flag a pixel.
void fill_around(Image& image, std::vector<char> covered, int margin);

} // namespace meshtween
