#include "meshtween/fit/bake.h"

#include "meshtween/core/color.h"
#include "meshtween/core/parallel.h"
#include "meshtween/fit/appearance.h"
#include "meshtween/fit/carried_look.h"
#include "meshtween/geometry/shapes.h"

#include "support/errors.h"
#include "support/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace meshtween;

namespace {

// A sphere of two charts, its northern and southern half seen from above and from below, side by side; each vertex of
// the equator has two texture coordinates.
Mesh charted_sphere(int subdivisions) {
    Mesh mesh = sphere(subdivisions);
    const Eigen::Index n = mesh.positions.rows();
    mesh.texcoords.resize(2 * n, 2);
    for (Eigen::Index i = 0; i < n; ++i) {
        const Point p = mesh.positions.row(i);
        for (int half = 0; half < 2; ++half) { // stereographic, from the other pole
            const double z = half == 0 ? p[2] : -p[2], scale = 0.16 / std::max(0.4, 1 + z);
            mesh.texcoords.row(half * n + i) << static_cast<float>(0.25 + 0.5 * half + scale * p[0]),
                static_cast<float>(0.5 + scale * p[1]);
        }
    }
    mesh.texcoord_triangles = mesh.triangles;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
        double height = 0;
        for (int k = 0; k < 3; ++k) height += mesh.positions(mesh.triangles(t, k), 2);
        if (height < 0) mesh.texcoord_triangles.row(t).array() += static_cast<int>(n);
    }
    return mesh;
}

Eigen::Vector3f color_of(const Point& p) { // smooth, linear RGB, within 0.1 .. 0.9
    return (0.5 + 0.4 * p.normalized().transpose().array()).cast<float>();
}

// The mesh with a picture of its own positions on its texture coordinates.
Mesh pictured(const Mesh& mesh, int size) {
    const PictureLayout layout = picture_layout(mesh);
    EXPECT_EQ(layout.problem, "");
    const auto paint = [&](std::span<const SurfacePoint> places, std::span<Eigen::Vector3f> colors) {
        for (std::size_t i = 0; i < places.size(); ++i)
            colors[i] = color_of(position(mesh.positions, mesh.triangles, places[i]));
    };
    const Baked baked = bake(mesh, layout, {.size = size}, paint);
    EXPECT_EQ(baked.pictures.size(), 1U);
    MeshFile file;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) file.corners.push_back(mesh.triangles(t, k));
    file.cut.resizeLike(mesh.triangles);
    for (int i = 0; i < file.cut.size(); ++i) file.cut.data()[i] = i;
    for (int t = 0; t < mesh.triangles.rows(); ++t) file.ends.push_back(3 * t + 3);
    file.polygon_materials.assign(file.ends.size(), 0);
    file.materials.push_back({.name = "skin", .base_color_image = 0});
    file.images.push_back({"skin.png", "image/png", png_bytes(baked.pictures[0]), {}});
    Mesh result = mesh;
    result.file = std::make_shared<MeshFile>(file);
    return result;
}

// The greatest difference from color_of over points of all triangles, their corners and edges too.
double worst_error(const Mesh& mesh, const Points& where) {
    const Appearance look(mesh);
    EXPECT_TRUE(look.has_pictures());
    double worst = 0;
    for (int t = 0; t < mesh.triangles.rows(); ++t)
        for (int i = 0; i <= 4; ++i)
            for (int j = 0; i + j <= 4; ++j) {
                const Eigen::Vector3f shares(1 - (i + j) / 4.0F, i / 4.0F, j / 4.0F);
                const Point at = position(where, mesh.triangles, {t, shares.transpose().cast<double>()});
                worst = std::max(worst, double((look.at(t, shares) - color_of(at)).cwiseAbs().maxCoeff()));
            }
    return worst;
}

TEST(Bake, APictureShowsWhatWasPaintedRightUpToItsSeams) {
    const Mesh mesh = pictured(charted_sphere(4), 512);
    EXPECT_LT(worst_error(mesh, mesh.positions), 0.012); // a pixel's width, and eight bits
}

TEST(Bake, AnotherSpheresPictureOntoItsOwnCharts) {
    const Mesh giver = pictured(charted_sphere(5), 512);
    Mesh receiver = charted_sphere(4);
    receiver.positions = turn(receiver.positions, {1, 2, 3}, 0.7); // other seams, other triangles
    const CarriedLook got = carried_look(receiver, giver, "giver", {.texture_size = 512});
    EXPECT_FALSE(got.cancelled);
    EXPECT_EQ(got.no_picture, "");
    EXPECT_LT(got.unseen, 1e-9);
    EXPECT_LT(got.twice, 1e-3);
    EXPECT_EQ(got.mesh.texcoords, receiver.texcoords);
    EXPECT_LT(worst_error(got.mesh, receiver.positions), 0.025);
}

TEST(Bake, SmallerCopiesOfThePictureDoNotBleed) {
    const Mesh mesh = pictured(charted_sphere(4), 512);
    Image image = read_image(mesh.file->images[0]);
    for (int level = 0; level < 3; ++level) { // what a viewer shows from afar: margins of 16 pixels become 2
        Image half{image.width / 2, image.height / 2, {}};
        for (int y = 0; y < half.height; ++y)
            for (int x = 0; x < half.width; ++x)
                for (int c = 0; c < 3; ++c) {
                    const auto at = [&](int dx, int dy) {
                        return int(
                            image.rgb[static_cast<std::size_t>(((2 * y + dy) * image.width + 2 * x + dx) * 3 + c)]);
                    };
                    half.rgb.push_back(static_cast<std::uint8_t>((at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1) + 2) / 4));
                }
        image = half;
    }
    MeshFile file = *mesh.file;
    file.images[0].bytes = png_bytes(image);
    Mesh coarse = mesh;
    coarse.file = std::make_shared<MeshFile>(file);
    EXPECT_LT(worst_error(coarse, coarse.positions),
              0.08); // eight times a pixel's width; a foreign colour is off by 0.3
}

TEST(Bake, NothingIsLeftEmpty) {
    const Mesh mesh = pictured(charted_sphere(3), 128);
    const Image image = read_image(mesh.file->images[0]);
    const auto least = static_cast<int>(255 * srgb_from_linear(0.1F)) - 2;
    EXPECT_GE(*std::min_element(image.rgb.begin(), image.rgb.end()), least);
}

TEST(Bake, TheSameBitsForAnyNumberOfThreads) {
    const Mesh giver = pictured(charted_sphere(4), 256);
    Mesh receiver = charted_sphere(3);
    receiver.positions = turn(receiver.positions, {1, 2, 3}, 0.7);
    std::vector<std::string> bytes;
    for (const int count : {1, 2, 5}) {
        set_threads(count);
        bytes.push_back(carried_look(receiver, giver, "giver", {.texture_size = 256}).mesh.file->images.at(0).bytes);
    }
    set_threads(0);
    EXPECT_EQ(bytes[0], bytes[1]);
    EXPECT_EQ(bytes[0], bytes[2]);
}

TEST(Bake, ChartsThatShareAPlaceAreTold) {
    Mesh mesh = charted_sphere(3);
    const auto n = static_cast<int>(mesh.positions.rows());
    mesh.texcoord_triangles =
        mesh.texcoord_triangles.unaryExpr([n](int i) { return i % n; }); // the south at the north's
    for (Eigen::Index i = 0; i < n; ++i)
        mesh.texcoords.row(i) << static_cast<float>(0.5 + 0.3 * mesh.positions(i, 0)),
            static_cast<float>(0.5 + 0.3 * mesh.positions(i, 1));
    const PictureLayout layout = picture_layout(mesh);
    EXPECT_EQ(layout.count, 1);
    const auto grey = [](std::span<const SurfacePoint>, std::span<Eigen::Vector3f> colors) {
        for (auto& c : colors) c.setConstant(0.5F);
    };
    EXPECT_NEAR(bake(mesh, layout, {.size = 128}, grey).twice, 0.5, 0.03);
}

TEST(Bake, TilesTakeAPictureEach) {
    Mesh mesh = charted_sphere(3);
    const Eigen::Index n = mesh.positions.rows();
    for (Eigen::Index i = 0; i < n; ++i) { // each half fills its own tile
        mesh.texcoords.row(i) = (mesh.texcoords.row(i).array() - Eigen::Array2f(0.25F, 0.5F).transpose()) * 2 + 0.5F;
        mesh.texcoords.row(n + i) =
            (mesh.texcoords.row(n + i).array() - Eigen::Array2f(0.75F, 0.5F).transpose()) * 2 + 0.5F;
        mesh.texcoords(n + i, 0) += 1;
    }
    const PictureLayout layout = picture_layout(mesh);
    EXPECT_EQ(layout.problem, "");
    EXPECT_EQ(layout.count, 2);
    const Mesh giver = pictured(charted_sphere(4), 256);
    const CarriedLook got = carried_look(mesh, giver, "giver", {.texture_size = 256});
    EXPECT_EQ(got.mesh.file->images.size(), 2U);
    EXPECT_EQ(got.mesh.file->materials.size(), 2U);
    EXPECT_LT(worst_error(got.mesh, mesh.positions), 0.03);
}

TEST(Bake, CoordinatesThatCannotBePainted) {
    Mesh mesh = charted_sphere(2);
    Mesh tiled = mesh;
    tiled.texcoords *= 40;
    EXPECT_NE(picture_layout(tiled).problem.find("tiles"), std::string::npos);
    Mesh flat = mesh;
    flat.texcoords.setConstant(0.5F);
    EXPECT_NE(picture_layout(flat).problem.find("without area"), std::string::npos);
    Mesh none = mesh;
    none.texcoords.resize(0, 2), none.texcoord_triangles.resize(0, 3);
    EXPECT_NE(picture_layout(none).problem.find("no texture coordinates"), std::string::npos);
    constexpr int many = 4000; // materials that all want the same place of a picture
    Mesh stacked = mesh;
    stacked.triangles = mesh.triangles.row(0).replicate(many, 1);
    stacked.texcoord_triangles = mesh.texcoord_triangles.row(0).replicate(many, 1);
    auto file = std::make_shared<MeshFile>();
    file->cut.resize(many, 3);
    file->materials.resize(many);
    for (int t = 0; t < many; ++t) {
        file->cut.row(t) << 3 * t, 3 * t + 1, 3 * t + 2;
        file->ends.push_back(3 * t + 3);
        file->polygon_materials.push_back(t);
    }
    stacked.file = file;
    EXPECT_NE(picture_layout(stacked).problem.find("more than 16 pictures"), std::string::npos);
    const Mesh giver = pictured(mesh, 64);
    const CarriedLook got = carried_look(none, giver, "giver", {.texture_size = 64});
    EXPECT_EQ(got.mesh.colors.rows(), none.positions.rows());
    EXPECT_NE(got.no_picture, "");
    for (const int size : {15, 8193})
        EXPECT_NE(message_of(ErrorKind::argument, [&] { carried_look(mesh, giver, "giver", {.texture_size = size}); })
                      .find("16 to 8192"),
                  std::string::npos);
}

TEST(Bake, ALookIsNeeded) {
    const Mesh plain = sphere(2);
    EXPECT_NE(message_of(ErrorKind::file, [&] { carried_look(plain, plain, "scan.ply", {}); }).find("scan.ply"),
              std::string::npos);
    Mesh missing = pictured(charted_sphere(2), 64);
    MeshFile file = *missing.file;
    file.images[0].bytes.clear();
    file.images[0].path = "nowhere/skin.png";
    missing.file = std::make_shared<MeshFile>(file);
    EXPECT_NE(message_of(ErrorKind::file, [&] { carried_look(plain, missing, "scan.obj", {}); }).find("skin.png"),
              std::string::npos);
}

TEST(Bake, WhatIsNotShownTakesTheColoursAroundOrKeepsItsOwn) {
    Mesh giver = sphere(5);
    giver.colors = Colors::Ones(giver.positions.rows(), 4);
    giver.colors.col(1).setZero(), giver.colors.col(2).setZero(); // red
    giver = part_of_mesh(giver, [](const Point& p) { return p[2] < 0.5; });
    Mesh receiver = charted_sphere(4);
    CarriedLook got = carried_look(receiver, giver, "giver", {});
    EXPECT_NEAR(got.unseen, 0.25, 0.03); // the cap's part of the sphere
    EXPECT_LT((got.mesh.colors.leftCols<3>().rowwise() - Eigen::RowVector3f(1, 0, 0)).cwiseAbs().maxCoeff(), 1e-3F);
    receiver.colors = Colors::Ones(receiver.positions.rows(), 4);
    receiver.colors.col(0).setZero(), receiver.colors.col(1).setZero(); // blue
    got = carried_look(receiver, giver, "giver", {});
    for (Eigen::Index i = 0; i < receiver.positions.rows(); ++i)
        if (const double z = receiver.positions(i, 2); std::abs(z - 0.5) > 0.15) {
            EXPECT_LT((got.mesh.colors.row(i).head<3>() - Eigen::RowVector3f(z<0.5, 0, z> 0.5)).norm(), 1e-3F) << z;
        }
    got = carried_look(receiver, giver, "giver", {.texture_size = 256, .bake_colors = true});
    const Appearance look(got.mesh);
    for (int t = 0; t < receiver.triangles.rows(); ++t) {
        const Eigen::Vector3f third = Eigen::Vector3f::Constant(1 / 3.0F);
        const double z = position(receiver.positions, receiver.triangles, {t, Point::Constant(1 / 3.0)})[2];
        if (std::abs(z - 0.5) > 0.15) {
            EXPECT_LT((look.at(t, third) - Eigen::Vector3f(z<0.5, 0, z> 0.5)).norm(), 0.01F) << z;
        }
    }
}

TEST(Bake, CancellingIsAResult) {
    const Mesh giver = pictured(charted_sphere(3), 64);
    const CarriedLook got = carried_look(charted_sphere(3), giver, "giver", {.texture_size = 512},
                                         [](double done, std::string_view) { return done < 0.3; });
    EXPECT_TRUE(got.cancelled);
}

} // namespace
