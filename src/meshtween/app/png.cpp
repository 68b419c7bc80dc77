// PNG files, still and animated (the APNG extension of the PNG specification, third edition).
#include "meshtween/app/film.h"
#include "meshtween/core/error.h"
#include "meshtween/io/output.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h> // for its sum of a chunk
#pragma GCC diagnostic pop

#include <algorithm>
#include <cmath>
#include <string_view>

namespace meshtween {
namespace {

std::string big_endian(std::uint64_t value, int bytes) {
    std::string text;
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xFF);
    return text;
}

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

std::string chunk(const std::string& name, const std::string& data) {
    std::string named = name + data;
    const unsigned crc = stbiw__crc32(reinterpret_cast<unsigned char*>(named.data()), static_cast<int>(named.size()));
    return big_endian(static_cast<std::uint32_t>(data.size()), 4) + named + big_endian(crc, 4);
}

constexpr std::size_t signature = 8, around = 12; // bytes: of a file's start, and of a chunk beside its data

// The data of all chunks of this name.
std::string data_of(const std::string& png, std::string_view name) {
    std::string data;
    for (std::size_t at = signature; at + around <= png.size(); at += around + number_at(png, at))
        if (png.compare(at + 4, 4, name) == 0) data += png.substr(at + 8, number_at(png, at));
    return data;
}

} // namespace

void write_png(const Image& image, const std::filesystem::path& path) {
    write_whole(path, png_bytes(image));
}

void write_animated_png(const std::vector<Image>& frames, double seconds_per_frame, const std::filesystem::path& path) {
    if (frames.empty()) throw Error(ErrorKind::argument, "an animated picture needs at least one frame");
    std::string bytes;
    std::uint32_t number = 0;
    const auto milliseconds = static_cast<std::uint32_t>(std::clamp(std::lround(1000 * seconds_per_frame), 1L, 60000L));
    for (const Image& frame : frames) {
        const std::string png = png_bytes(frame);
        if (bytes.empty())
            bytes = png.substr(0, signature) + chunk("IHDR", data_of(png, "IHDR")) +
                    chunk("acTL", big_endian(static_cast<std::uint32_t>(frames.size()), 4) + big_endian(0, 4));
        const bool first = number == 0; // which is also the picture where animation is unknown
        bytes += chunk("fcTL", big_endian(number++, 4) + big_endian(static_cast<std::uint32_t>(frame.width), 4) +
                                   big_endian(static_cast<std::uint32_t>(frame.height), 4) + big_endian(0, 8) +
                                   big_endian(milliseconds, 2) + big_endian(1000, 2) + big_endian(0, 2));
        const std::string pixels = data_of(png, "IDAT");
        bytes += first ? chunk("IDAT", pixels) : chunk("fdAT", big_endian(number++, 4) + pixels);
    }
    write_whole(path, bytes + chunk("IEND", ""));
}

} // namespace meshtween
