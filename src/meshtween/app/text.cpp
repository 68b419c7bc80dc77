// The typeface is Inter (assets/inter-licence.txt); its outlines become pixels in stb_truetype.
#include "meshtween/app/text.h"

#include <algorithm>
#include <cmath>

#define STB_TRUETYPE_IMPLEMENTATION
#define STBTT_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_truetype.h>
#pragma GCC diagnostic pop

extern "C" const unsigned char meshtween_font_begin[]; // the embedded file

namespace meshtween {
namespace {

const stbtt_fontinfo& font() {
    static const stbtt_fontinfo info = [] {
        stbtt_fontinfo f;
        stbtt_InitFont(&f, meshtween_font_begin, 0);
        return f;
    }();
    return info;
}

// Calls visit(glyph, x) for each glyph with the pen's place before it; tells where the pen ends.
template <typename Visit>
double walk(std::string_view text, double size, const Visit& visit) {
    const double scale = stbtt_ScaleForMappingEmToPixels(&font(), static_cast<float>(size));
    double pen = 0;
    int previous = 0;
    for (const char32_t code : code_points(text)) {
        const int glyph = stbtt_FindGlyphIndex(&font(), static_cast<int>(code));
        if (previous != 0) pen += scale * stbtt_GetGlyphKernAdvance(&font(), previous, glyph);
        visit(glyph, pen);
        int advance = 0, bearing = 0;
        stbtt_GetGlyphHMetrics(&font(), glyph, &advance, &bearing);
        pen += scale * advance;
        previous = glyph;
    }
    return pen;
}

void blend(Image& image, int x, int y, Rgb color, int alpha) {
    if (x < 0 || y < 0 || x >= image.width || y >= image.height) return;
    std::uint8_t* pixel = image.rgb.data() + 3 * (static_cast<std::ptrdiff_t>(y) * image.width + x);
    for (std::size_t c = 0; c < 3; ++c)
        pixel[c] = static_cast<std::uint8_t>((pixel[c] * (255 - alpha) + color[c] * alpha + 127) / 255);
}

} // namespace

std::vector<char32_t> code_points(std::string_view text) {
    std::vector<char32_t> result;
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = static_cast<unsigned char>(text[i]);
        if (byte < 0x20) break;
        const std::size_t length = byte < 0x80 ? 1 : byte >> 5 == 6 ? 2 : byte >> 4 == 14 ? 3 : byte >> 3 == 30 ? 4 : 0;
        char32_t code = length == 1 ? byte : byte & (0x7FU >> length);
        std::size_t used = 1;
        while (used < length && i + used < text.size() && (text[i + used] & 0xC0) == 0x80)
            code = code << 6 | (static_cast<unsigned char>(text[i + used++]) & 0x3FU);
        const bool sound = length > 0 && used == length && code <= 0x10FFFF;
        result.push_back(sound ? code : U'\uFFFD');
        i += used;
    }
    return result;
}

double text_width(std::string_view text, double size) {
    return walk(text, size, [](int, double) {});
}

void draw_text(Image& image, double x, double y, std::string_view text, double size, Rgb color) {
    const float scale = stbtt_ScaleForMappingEmToPixels(&font(), static_cast<float>(size));
    walk(text, size, [&](int glyph, double pen) {
        const double left = std::floor(x + pen), top = std::floor(y);
        int width = 0, height = 0, dx = 0, dy = 0;
        unsigned char* ink =
            stbtt_GetGlyphBitmapSubpixel(&font(), scale, scale, static_cast<float>(x + pen - left),
                                         static_cast<float>(y - top), glyph, &width, &height, &dx, &dy);
        for (int row = 0; ink != nullptr && row < height; ++row)
            for (int column = 0; column < width; ++column)
                if (const int alpha = ink[row * width + column]; alpha > 0)
                    blend(image, static_cast<int>(left) + dx + column, static_cast<int>(top) + dy + row, color, alpha);
        stbtt_FreeBitmap(ink, nullptr);
    });
}

std::string fitted_text(std::string_view text, double size, double width) {
    if (text_width(text, size) <= width) return std::string(text);
    const std::string dots = "\u2026";
    std::string kept(text);
    while (!kept.empty() && text_width(kept + dots, size) > width) {
        while (!kept.empty() && (kept.back() & 0xC0) == 0x80) kept.pop_back(); // the tail of one code point
        if (!kept.empty()) kept.pop_back();
    }
    while (!kept.empty() && kept.back() == ' ') kept.pop_back();
    return kept + dots;
}

} // namespace meshtween
