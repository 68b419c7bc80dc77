#include "meshtween/app/preview.h"

#include "meshtween/geometry/subdivide.h"

#include "meshtween/app/raster.h"
#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/io/output.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

namespace meshtween {
namespace {

// A sphere of latitude rings, poles at +-y.
Mesh sphere(double radius, int rings = 24) {
    const int around = 2 * rings;
    Mesh mesh;
    mesh.positions.resize((rings + 1) * around, 3);
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j < around; ++j) {
            const double latitude = std::numbers::pi * i / rings, longitude = 2 * std::numbers::pi * j / around;
            mesh.positions.row(i * around + j) << radius * std::sin(latitude) * std::sin(longitude),
                radius * std::cos(latitude), radius * std::sin(latitude) * std::cos(longitude);
        }
    mesh.triangles.resize(2 * rings * around, 3);
    for (int i = 0, t = 0; i < rings; ++i)
        for (int j = 0; j < around; ++j) {
            const int a = i * around + j, b = i * around + (j + 1) % around;
            mesh.triangles.row(t++) << a, a + around, b;
            mesh.triangles.row(t++) << b, a + around, b + around;
        }
    return mesh;
}

// Mean colour of the square of pixels around x, y.
Eigen::Vector3d color_at(const Image& image, int x, int y, int reach = 2) {
    Eigen::Vector3d sum(0, 0, 0);
    for (int py = y - reach; py <= y + reach; ++py)
        for (int px = x - reach; px <= x + reach; ++px)
            for (int c = 0; c < 3; ++c) sum[c] += image.rgb[static_cast<std::size_t>(3 * (py * image.width + px) + c)];
    return sum / ((2 * reach + 1) * (2 * reach + 1));
}

TEST(Raster, ASpheresOutlineHasACirclesArea) {
    const double radius = 150;
    Mesh ball = sphere(radius, 64);
    ball.positions.rowwise() += Point(200, 200, 1000);
    const Samples samples = rasterise(ball.positions, ball.triangles, 400, 400);
    const auto covered = samples.triangle.size() -
                         static_cast<std::size_t>(std::count(samples.triangle.begin(), samples.triangle.end(), -1));
    EXPECT_NEAR(static_cast<double>(covered), std::numbers::pi * radius * radius, 0.003 * 400 * 400);
}

TEST(Raster, TheNearerTriangleIsSeenAndSharesBelongToItsCorners) {
    Points screen(6, 3);
    screen << 0, 0, 2, 20, 0, 2, 0, 20, 2, 0, 0, 1, 20, 0, 1, 0, 20, 3;
    Triangles triangles(2, 3);
    triangles << 0, 1, 2, 3, 4, 5;
    const Samples samples = rasterise(screen, triangles, 20, 20);
    EXPECT_EQ(samples.triangle[20 * 1 + 3], 1);  // near its edge at distance 1
    EXPECT_EQ(samples.triangle[20 * 17 + 0], 0); // near its corner at distance 3
    EXPECT_EQ(samples.triangle[20 * 19 + 19], -1);
    const std::size_t at = 20 * 1 + 3;
    const Eigen::Vector2f bc = samples.barycentric[at];
    const double distance = (1 - bc[0] - bc[1]) * 1 + bc[0] * 1 + bc[1] * 3;
    EXPECT_NEAR(distance, 1 / samples.nearness[at], 1e-5);
}

TEST(Raster, NeighbouringTrianglesLeaveNoGap) {
    Mesh ball = sphere(90, 40);
    ball.positions.rowwise() += Point(100, 100, 500);
    const Samples samples = rasterise(ball.positions, ball.triangles, 200, 200);
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 200; ++x)
            if (std::hypot(x + 0.5 - 100, y + 0.5 - 100) < 88) {
                ASSERT_GE(samples.triangle[static_cast<std::size_t>(200 * y + x)], 0) << x << ' ' << y;
            }
}

TEST(Preview, TheSameBitsForAnyNumberOfThreads) {
    const std::vector<Tile> tiles{{"one", sphere(1), {}}, {"two", sphere(0.6), Points::Zero(1, 3)}};
    set_threads(1);
    const Image one = contact_sheet(tiles, {.tile = 120});
    set_threads(2);
    const Image two = contact_sheet(tiles, {.tile = 120});
    set_threads(0);
    EXPECT_EQ(one.rgb, two.rgb);
}

TEST(Preview, TilesStandSideBySideAtOneScale) {
    const Image image = contact_sheet({{"", sphere(1), {}}, {"", sphere(0.5), {}}}, {.tile = 200, .columns = 2});
    // How many pixels of the column through the middle of a tile differ from the backdrop at its edge.
    const auto height_of = [&](int x) {
        int count = 0;
        for (int y = 5; y < image.height - 60; ++y)
            count += (color_at(image, x, y, 0) - color_at(image, 3, y, 0)).norm() > 12;
        return count;
    };
    EXPECT_NEAR(static_cast<double>(height_of(image.width / 4 + 3)) / height_of(image.width * 3 / 4 - 3), 2, 0.25);
}

TEST(Preview, OtherUnitsAreShownAsLarge) {
    const Image one = contact_sheet({{"", sphere(1), {}}, {"", sphere(1), {}}}, {.tile = 100});
    const Image thousand = contact_sheet({{"", sphere(1), {}}, {"", sphere(1024), {}}}, {.tile = 100});
    EXPECT_EQ(one.width, thousand.width);
    const Eigen::Vector3d a = color_at(one, one.width / 4, 50), b = color_at(thousand, thousand.width / 4, 50);
    EXPECT_LT((a - b).norm(), 3);
}

TEST(Preview, InsideOutIsRed) {
    Mesh inverted = sphere(1);
    inverted.triangles.col(0).swap(inverted.triangles.col(1));
    const Image right = contact_sheet({{"", sphere(1), {}}}, {.tile = 120});
    const Image wrong = contact_sheet({{"", inverted, {}}}, {.tile = 120});
    const Eigen::Vector3d clay = color_at(right, right.width / 2, 60), red = color_at(wrong, wrong.width / 2, 60);
    EXPECT_LT(clay[0], 1.35 * clay[2]);
    EXPECT_GT(red[0], 1.8 * red[2]);
}

// A square leaning away from the eye with a picture of four stripes along its y.
Mesh striped_square() {
    Mesh mesh;
    mesh.positions.resize(4, 3);
    mesh.positions << -1, 0, 0, 1, 0, 0, 1, 2, -6, -1, 2, -6;
    mesh.triangles.resize(2, 3);
    mesh.triangles << 0, 1, 2, 0, 2, 3;
    mesh.texcoords.resize(4, 2);
    mesh.texcoords << 0, 0, 1, 0, 1, 1, 0, 1;
    mesh.texcoord_triangles = mesh.triangles;
    return mesh;
}

Mesh with_picture(Mesh mesh, const Image& image) {
    MeshFile file;
    file.cut.resizeLike(mesh.triangles);
    for (int i = 0; i < file.cut.size(); ++i) {
        file.corners.push_back(mesh.triangles.data()[i]);
        file.cut.data()[i] = i;
        if (i % 3 == 2) file.ends.push_back(i + 1);
    }
    file.polygon_materials.assign(file.ends.size(), 0);
    file.materials.push_back({.name = "stripes", .base_color_image = 0});
    file.images.push_back({"stripes", "image/png", png_bytes(image), {}});
    mesh.file = std::make_shared<MeshFile>(file);
    return mesh;
}

TEST(Preview, PicturesLieOnTheSurfaceInPerspective) {
    Image stripes{4, 64, {}};
    for (int i = 0; i < 4 * 64; ++i)
        for (const int c : {i / 64 % 2 == 0 ? 230 : 20, 60, i / 64 % 2 == 0 ? 20 : 230})
            stripes.rgb.push_back(static_cast<std::uint8_t>(c));
    const Mesh coarse = striped_square(), fine = subdivide(coarse, 5);
    const Image one = contact_sheet({{"", with_picture(coarse, stripes), {}}}, {.tile = 160});
    const Image many = contact_sheet({{"", with_picture(fine, stripes), {}}}, {.tile = 160});
    ASSERT_EQ(one.rgb.size(), many.rgb.size());
    double difference = 0, colourful = 0;
    for (std::size_t i = 0; i < one.rgb.size(); i += 3) {
        difference += std::abs(one.rgb[i] - many.rgb[i]);
        colourful += std::abs(one.rgb[i] - one.rgb[i + 2]) > 60;
    }
    EXPECT_GT(colourful, 500);
    EXPECT_LT(difference / static_cast<double>(one.rgb.size()), 0.2);
}

TEST(Preview, ALookFadesToAnother) {
    Mesh red = sphere(1), blue = sphere(1);
    for (Mesh* mesh : {&red, &blue}) mesh->colors = Colors::Zero(mesh->positions.rows(), 4);
    red.colors.col(0).setOnes(), blue.colors.col(2).setOnes();
    const auto other = std::make_shared<const Mesh>(blue);
    const auto middle = [&](double faded) {
        const Image image = contact_sheet({{"", red, {}, other, faded}}, {.tile = 120});
        return color_at(image, image.width / 2, 60);
    };
    EXPECT_GT(middle(0)[0], 2 * middle(0)[2]);
    EXPECT_GT(middle(1)[2], 2 * middle(1)[0]);
    EXPECT_NEAR(middle(0.5)[0] / middle(0.5)[2], 1, 0.15);
}

TEST(Preview, VertexColoursAreShown) {
    Mesh ball = sphere(1);
    ball.colors = Colors::Zero(ball.positions.rows(), 4);
    ball.colors.col(2).setOnes();
    const Image image = contact_sheet({{"", ball, {}}}, {.tile = 120});
    const Eigen::Vector3d color = color_at(image, image.width / 2, 60);
    EXPECT_GT(color[2], 2 * color[0]);
}

TEST(Preview, HiddenMarksAreHollow) {
    Tile front{"", sphere(1), Points(1, 3)}, back = front;
    front.marks << 0, 0, 1.001;
    back.marks << 0, 0, -1.001;
    const SheetOptions options{.tile = 300, .azimuth = 0, .elevation = 0};
    const Image plain = contact_sheet({{"", sphere(1), {}}}, options);
    const Image seen = contact_sheet({front}, options), hidden = contact_sheet({back}, options);
    // The mark's middle: where the pictures differ most between plain and seen.
    int sx = 0, sy = 0, count = 0;
    for (int y = 0; y < plain.height; ++y)
        for (int x = 0; x < plain.width; ++x)
            if (color_at(plain, x, y, 0) != color_at(seen, x, y, 0)) sx += x, sy += y, ++count;
    ASSERT_GT(count, 9);
    const int x = sx / count, y = sy / count;
    EXPECT_GT(color_at(seen, x, y, 0)[0] - color_at(seen, x, y, 0)[2], 100);
    EXPECT_LT((color_at(hidden, x, y, 0) - color_at(plain, x, y, 0)).norm(), 6);
    EXPECT_NE(hidden.rgb, plain.rgb);
}

TEST(Preview, WhatIsNotFiniteOrEmptyIsLeftOut) {
    Mesh broken = sphere(1);
    broken.positions(30, 1) = std::numeric_limits<double>::quiet_NaN();
    broken.positions(50, 2) = std::numeric_limits<double>::infinity();
    Points marks = Points::Constant(1, 3, std::numeric_limits<double>::quiet_NaN());
    const Image image = contact_sheet({{"broken", broken, marks}, {"nothing", Mesh{}, {}}}, {.tile = 80});
    EXPECT_EQ(image.rgb.size(), static_cast<std::size_t>(image.width * image.height * 3));
    EXPECT_NO_THROW(contact_sheet({{"", Mesh{}, {}}}, {.tile = 40}));
}

TEST(Preview, CancelledTheOtherShapesAreLeftOut) {
    const std::vector<Tile> tiles{{"", sphere(1), {}}, {"", sphere(1), Points::Zero(1, 3)}};
    int calls = 0;
    const auto once = [&](double, std::string_view) { return ++calls == 1; };
    const Image whole = contact_sheet(tiles, {.tile = 80}), half = contact_sheet(tiles, {.tile = 80}, once);
    EXPECT_EQ(whole.width, half.width);
    EXPECT_EQ(color_at(whole, whole.width / 4, 40), color_at(half, half.width / 4, 40));
    EXPECT_NE(color_at(whole, whole.width * 3 / 4, 40), color_at(half, half.width * 3 / 4, 40));
}

TEST(Preview, RefusesWhatIsNoSheet) {
    EXPECT_THROW(contact_sheet({}), Error);
    EXPECT_THROW(contact_sheet({{"", sphere(1), {}}}, {.tile = 0}), Error);
    EXPECT_THROW(contact_sheet(std::vector<Tile>(50), {.tile = 8000}), Error);
}

TEST(Preview, PngHoldsThePicturesSize) {
    const auto path = std::filesystem::temp_directory_path() / "meshtween_preview_test.png";
    write_png({3, 2, std::vector<std::uint8_t>(18, 200)}, path);
    const std::string bytes = read_whole(path);
    std::filesystem::remove(path);
    EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(bytes.substr(16, 8), std::string("\0\0\0\3\0\0\0\2", 8));
}

} // namespace
} // namespace meshtween
