// Shaded pictures without a graphics card: a z-buffer in software.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/core/progress.h"
#include "meshtween/io/image.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace meshtween {

// One picture on a contact sheet.
struct Tile {
    std::string caption; // UTF-8; a second line, after '\n', is set smaller
    Mesh mesh;
    Points marks; // M x 3 points to draw as dots, or empty; those behind the surface are rings
    // The same triangles with another look, to which the tile has faded by this much; or none.
    std::shared_ptr<const Mesh> other = {};
    double faded = 0;
};

struct SheetOptions {
    int tile = 420;        // pixels, the longer side of a tile; the other is as the shapes need
    int columns = 0;       // 0: as suits the number of tiles
    double azimuth = 25;   // degrees that the camera walks to the shape's left from its front (+z, y up)
    double elevation = 10; // degrees above the horizon
};

// All tiles at one scale and from one side, so that they can be compared: each shape stands on the ground in the middle
// of its tile. Only where sizes differ more than fourfold (other units) is each shown as large as the largest. Insides
// of open or inverted surfaces are red. The same bits for any number of threads. Cancelled, it is the sheet with the
// shapes drawn until then. Throws Error(argument): no tiles, a size out of range, a picture of more than 100 million
// pixels.
Image contact_sheet(const std::vector<Tile>& tiles, const SheetOptions& options = {}, const Progress& progress = {});

void write_png(const Image& image, const std::filesystem::path& path); // through write_whole

} // namespace meshtween
