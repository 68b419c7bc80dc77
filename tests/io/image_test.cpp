#include "meshtween/io/image.h"

#include "support/errors.h"
#include "support/scratch.h"

#include <gtest/gtest.h>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

using namespace meshtween;

namespace {

Image ramp(int width, int height) {
    Image image{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const int value : {5 * x, 7 * y, x ^ y}) image.rgb.push_back(static_cast<std::uint8_t>(value));
    return image;
}

std::string jpeg_bytes(const Image& image) {
    std::string bytes;
    const auto append = [](void* to, void* data, int size) {
        static_cast<std::string*>(to)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
    };
    stbi_write_jpg_to_func(append, &bytes, image.width, image.height, 3, image.rgb.data(), 95);
    return bytes;
}

TEST(Image, APngComesBackAsItWas) {
    const Image image = ramp(37, 21);
    const Image back = decoded_image(png_bytes(image), "x.png");
    EXPECT_EQ(back.width, 37);
    EXPECT_EQ(back.height, 21);
    EXPECT_EQ(back.rgb, image.rgb);
}

TEST(Image, FromAFileToo) {
    const Scratch scratch;
    const Image image = ramp(8, 8);
    const TextureImage texture{"skin", "image/png", "", scratch.file("skin.png", png_bytes(image))};
    EXPECT_EQ(read_image(texture).rgb, image.rgb);
}

TEST(Image, AJpegIsNearlyAsItWas) {
    Image image = ramp(32, 24);
    for (std::size_t i = 2; i < image.rgb.size(); i += 3) image.rgb[i] = 100; // smooth
    const Image back = decoded_image(jpeg_bytes(image), "x.jpg");
    ASSERT_EQ(back.rgb.size(), image.rgb.size());
    for (std::size_t i = 0; i < image.rgb.size(); ++i) EXPECT_NEAR(back.rgb[i], image.rgb[i], 12);
}

struct BadPicture {
    const char* name;
    std::string bytes;
    const char* says;
};

TEST(Image, BadPicturesAreRefusedByName) {
    const std::string png = png_bytes(ramp(64, 64));
    std::string promises = png;
    promises.replace(16, 8, std::string("\0\0\x3f\xff\0\0\x3f\xff", 8)); // 16383 x 16383
    std::string huge = png;
    huge.replace(16, 4, std::string("\0\1\0\0", 4));
    std::string twisted = png;
    for (std::size_t i = 60; i < twisted.size() - 20; ++i) twisted[i] = static_cast<char>(i * 37);
    const std::string jpeg = jpeg_bytes(ramp(64, 64));
    const BadPicture table[] = {
        {"empty.png", "", "empty"},
        {"garbage.png", "this is no picture at all", "no PNG"},
        {"cut.png", png.substr(0, png.size() / 2), "broken"},
        {"head.png", png.substr(0, 20), "broken"},
        {"promises.png", promises, "more than"},
        {"huge.png", huge, "16384"},
        {"twisted.png", twisted, "broken"},
        {"cut.jpg", jpeg.substr(0, jpeg.size() - 2), "cut short"},
        {"head.jpg", jpeg.substr(0, 40), "cut short"},
        {"twisted.jpg", jpeg.substr(0, 20) + "\xFF\xDA\xFF\xD9", "broken"},
        {"webp.webp", std::string("RIFF\0\0\0\0WEBPVP8 ", 16), "convert it to PNG"},
        {"garbage.tga", "this is no picture at all, nor a Targa, whatever it is", "broken"},
    };
    for (const BadPicture& bad : table) {
        const std::string message = message_of(ErrorKind::file, [&] { decoded_image(bad.bytes, bad.name); });
        EXPECT_NE(message.find(bad.name), std::string::npos) << message;
        EXPECT_NE(message.find(bad.says), std::string::npos) << bad.name << ": " << message;
    }
    const TextureImage missing{"", "", "", "no/such/picture.png"};
    EXPECT_NE(message_of(ErrorKind::file, [&] { read_image(missing); }).find("picture.png"), std::string::npos);
}

} // namespace
