// PNG (W3C, third edition), JPEG (ITU-T T.81), through stb_image and stb_image_write.
#include "meshtween/io/image.h"

#include "meshtween/io/output.h"
#include "meshtween/io/text.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wshadow"
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cctype>
#include <limits>
#include <memory>

namespace meshtween {
namespace {

constexpr int largest_side = 16384;

bool is_tga(const std::string& name) {
    std::string end = name.substr(name.size() < 4 ? 0 : name.size() - 4);
    std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
    return end == ".tga";
}

void require_known_format(std::string_view bytes, const std::string& name) {
    if (bytes.empty()) bad_file(name, "the picture is empty");
    const bool png = bytes.starts_with("\x89PNG\r\n\x1a\n"), jpeg = bytes.starts_with("\xFF\xD8");
    if (!png && !jpeg && !bytes.starts_with("BM") && !is_tga(name))
        bad_file(name, "is no PNG, JPEG, BMP or TGA picture; convert it to PNG");
    // The decoder fills up what is missing of a JPEG: look for the end mark after the last start of a scan.
    if (const auto scan = bytes.rfind("\xFF\xDA");
        jpeg && (scan == std::string_view::npos || bytes.find("\xFF\xD9", scan) == std::string_view::npos))
        bad_file(name, "the picture is cut short; save it again");
}

} // namespace

Image decoded_image(std::string_view bytes, const std::string& name) {
    require_known_format(bytes, name);
    if (bytes.size() > std::size_t(std::numeric_limits<int>::max())) bad_file(name, "the picture is over 2 GiB");
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int width = 0, height = 0, channels = 0;
    const auto broken = [&] {
        const char* why = stbi_failure_reason();
        bad_file(name, fmt::format("the picture is broken ({}); save it again", why != nullptr ? why : "unknown"));
    };
    if (stbi_info_from_memory(data, size, &width, &height, &channels) == 0) broken();
    if (width > largest_side || height > largest_side)
        bad_file(name, fmt::format("a picture of {} x {} pixels; {} a side is the most", width, height, largest_side));
    // Deflate shrinks to a thousandth at best, of single bits a pixel: a header that promises more lies.
    if (double(width) * height > 9000.0 * static_cast<double>(bytes.size()) + 1e6)
        bad_file(name, fmt::format("the picture promises {} x {} pixels, more than {} bytes can hold", width, height,
                                   bytes.size()));
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(data, size, &width, &height, &channels, 3), stbi_image_free);
    if (!pixels) broken();
    const auto count = static_cast<std::ptrdiff_t>(width) * height * 3;
    return {width, height, std::vector<std::uint8_t>(pixels.get(), pixels.get() + count)};
}

Image read_image(const TextureImage& texture) {
    if (!texture.bytes.empty()) return decoded_image(texture.bytes, texture.name.empty() ? "a picture" : texture.name);
    return decoded_image(read_whole(texture.path), texture.path.string());
}

std::string png_bytes(const Image& image) {
    std::string bytes;
    const auto append = [](void* to, void* data, int size) {
        static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
    };
    stbi_write_png_to_func(append, &bytes, image.width, image.height, 3, image.rgb.data(), image.width * 3);
    return bytes;
}

} // namespace meshtween
