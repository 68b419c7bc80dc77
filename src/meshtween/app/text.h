// Captions on pictures.
#pragma once

#include "meshtween/app/preview.h"

#include <array>
#include <string_view>

namespace meshtween {

using Rgb = std::array<std::uint8_t, 3>;

// UTF-8 to code points; bytes that are no UTF-8 become U+FFFD. A line ends at the first control character.
std::vector<char32_t> code_points(std::string_view text);

double text_width(std::string_view text, double size); // pixels; size is that of the letter M's em square

// Sets one line whose baseline's left end is at x, y. What lies beyond the picture's edges is cut off.
void draw_text(Image& image, double x, double y, std::string_view text, double size, Rgb color);

// The text, or as much of its beginning as fits with an ellipsis.
std::string fitted_text(std::string_view text, double size, double width);

} // namespace meshtween
