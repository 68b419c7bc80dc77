// Shaded pictures without a graphics card: a z-buffer in software.
#pragma once

#include "meshtween/core/mesh.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace meshtween {

struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb; // width * height * 3, rows from the top
};

// One picture on a contact sheet.
struct Tile {
    std::string caption;
    Mesh mesh;
    Points marks; // M x 3 points to draw as dots, or empty
};

struct SheetOptions {
    int tile = 420;        // pixels, both ways
    int columns = 0;       // 0: as suits the number of tiles
    double azimuth = 25;   // degrees that the camera walks to the shape's left from its front (+z, y up)
    double elevation = 10; // degrees above the horizon
};

// All tiles at one scale and from one side, so that they can be compared.
Image contact_sheet(const std::vector<Tile>& tiles, const SheetOptions& options = {});

void write_png(const Image& image, const std::filesystem::path& path); // through write_whole

} // namespace meshtween
