// Pictures as pixels, from and to encoded bytes.
#pragma once

#include "meshtween/io/mesh_file.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace meshtween {

struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb; // width * height * 3, sRGB, rows from the top
};

// A PNG, JPEG, BMP or TGA (the last by the name's extension). Transparency is left out. Throws Error(file) naming the
// picture: another format, broken, cut short, sides over 16384 pixels.
Image decoded_image(std::string_view bytes, const std::string& name);

// The picture of a mesh's texture: its bytes, or its file. Throws Error(file) also where there is no such file.
Image read_image(const TextureImage& texture);

std::string png_bytes(const Image& image);

} // namespace meshtween
