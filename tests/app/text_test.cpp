#include "meshtween/app/text.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace meshtween {
namespace {

Image white(int width, int height) {
    return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width * height * 3), 255)};
}

long ink(const Image& image) {
    return std::accumulate(image.rgb.begin(), image.rgb.end(), 0L, [](long sum, int v) { return sum + 255 - v; });
}

TEST(Text, ReadsUtf8) {
    EXPECT_EQ(code_points("aé→😀"), (std::vector<char32_t>{U'a', U'é', U'→', U'😀'}));
    EXPECT_EQ(code_points("one\ntwo").size(), 3U);
}

TEST(Text, BytesThatAreNoUtf8AreReplaced) {
    EXPECT_EQ(code_points("a\xff"
                          "b"),
              (std::vector<char32_t>{U'a', U'\uFFFD', U'b'}));
    EXPECT_EQ(code_points("\xe2\x86"), (std::vector<char32_t>{U'\uFFFD'}));
    EXPECT_EQ(code_points("\xf7\xbf\xbf\xbf"), (std::vector<char32_t>{U'\uFFFD'}));
}

TEST(Text, LargerTextIsWiderAndLeavesMoreInk) {
    EXPECT_NEAR(text_width("source", 40), 2 * text_width("source", 20), 1e-3);
    Image small = white(200, 60), large = white(200, 60);
    draw_text(small, 10, 40, "Hm", 16, {0, 0, 0});
    draw_text(large, 10, 40, "Hm", 32, {0, 0, 0});
    EXPECT_GT(ink(small), 0);
    EXPECT_NEAR(static_cast<double>(ink(large)) / static_cast<double>(ink(small)), 4, 0.4); // an area
}

TEST(Text, IsCutAtThePicturesEdges) {
    Image image = white(20, 20);
    for (const double x : {-1000.0, -5.0, 15.0, 1000.0})
        for (const double y : {-1000.0, 2.0, 18.0, 1000.0}) draw_text(image, x, y, "Wide → text", 24, {0, 0, 0});
    EXPECT_GT(ink(image), 0);
    EXPECT_EQ(image.rgb.size(), 1200U);
}

TEST(Text, LongTextIsShortenedToFit) {
    const std::string text = "eine sehr lange Überschrift für einen schmalen Rahmen";
    EXPECT_EQ(fitted_text(text, 14, 1000), text);
    for (double width = 0; width < 300; width += 7) {
        const std::string fitted = fitted_text(text, 14, width);
        EXPECT_TRUE(fitted.ends_with("…"));
        EXPECT_TRUE(fitted == "…" || text_width(fitted, 14) <= width) << fitted;
        const auto codes = code_points(fitted);
        EXPECT_EQ(std::count(codes.begin(), codes.end(), U'\uFFFD'), 0) << fitted;
    }
}

TEST(Text, AnyBytesCanBeDrawn) {
    std::mt19937 random(7);
    for (int repeat = 0; repeat < 200; ++repeat) {
        std::string bytes(random() % 24, ' ');
        for (char& byte : bytes) byte = static_cast<char>(random());
        Image image = white(80, 30);
        draw_text(image, 4, 20, fitted_text(bytes, 12, 60), 12, {0, 0, 0});
    }
}

} // namespace
} // namespace meshtween
