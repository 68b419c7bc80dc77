#include "meshtween/app/film.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/io/output.h"

#include "support/scratch.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace meshtween {
namespace {

// The columns in which the picture differs from the one without the shape.
std::pair<int, int> columns_of(const Image& image, const Image& empty) {
    std::pair<int, int> found{image.width, -1};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const auto at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + std::size_t(x));
            if (std::abs(image.rgb[at] - empty.rgb[at]) < 40) continue;
            found = {std::min(found.first, x), std::max(found.second, x)};
        }
    return found;
}

TEST(Film, ShowsMotionFromOneCamera) {
    const Mesh ball = sphere(2);
    Mesh there = ball;
    there.positions.col(0).array() += 3;
    const Film film(ball, {ball.positions, there.positions}, 200);
    Mesh away = ball;
    away.positions.col(0).array() += 1000;
    const Image first = film.frame(ball.positions), last = film.frame(there.positions),
                empty = film.frame(away.positions);
    EXPECT_EQ(first.width, last.width);
    EXPECT_EQ(first.height, last.height);
    const auto [from, to] = columns_of(first, empty);
    const auto [later_from, later_to] = columns_of(last, empty);
    EXPECT_GT(from, 0);
    EXPECT_LT(to, later_from); // further to the right, by more than its width
    EXPECT_LT(later_to, last.width - 1);
    EXPECT_NEAR(to - from, later_to - later_from, 20);
}

TEST(Film, NeedsShapesAndASizeInRange) {
    const Mesh ball = sphere(1);
    EXPECT_THROW(Film(ball, {}), Error);
    EXPECT_THROW(Film(ball, {ball.positions}, 3), Error);
}

TEST(AnimatedPng, HoldsEachFrameOnce) {
    const Scratch folder;
    const auto file = folder.path("a.apng");
    Image image{4, 3, std::vector<std::uint8_t>(36, 200)};
    write_animated_png({image, image, image}, 0.1, file);
    const std::string bytes = read_whole(file);
    const auto count = [&](const char* name) {
        int times = 0;
        for (std::size_t at = bytes.find(name); at != std::string::npos; at = bytes.find(name, at + 1)) ++times;
        return times;
    };
    EXPECT_EQ(count("acTL"), 1);
    EXPECT_EQ(count("fcTL"), 3);
    EXPECT_EQ(count("IDAT"), 1);
    EXPECT_EQ(count("fdAT"), 2);
    EXPECT_EQ(bytes.substr(bytes.size() - 8, 4), "IEND");
    EXPECT_THROW(write_animated_png({}, 0.1, file), Error);
}

} // namespace
} // namespace meshtween
