// What every format must keep, and what each has of its own.
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include "support/scratch.h"
#include "support/shapes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace meshtween {
namespace {

class Formats : public testing::Test {
protected:
    Mesh read(std::string_view name, std::string_view contents) const {
        return read_mesh(scratch.file(name, contents));
    }
    Mesh again(const Mesh& mesh, std::string_view name) const {
        write_mesh(mesh, scratch.path(name));
        return read_mesh(scratch.path(name));
    }
    Scratch scratch;
};

// Coordinates that need all their digits.
Mesh awkward_sheet() {
    Mesh mesh = wavy_sheet(9, 14);
    mesh.positions = (mesh.positions.array() * 1e5 / 3).matrix();
    mesh.positions(0, 0) = 1e-300;
    mesh.positions(1, 0) = -123456789.12345678;
    return mesh;
}

Colors byte_colors(Eigen::Index rows) {
    Colors colors(rows, 4);
    for (Eigen::Index i = 0; i < colors.size(); ++i) colors.data()[i] = static_cast<float>(i * 37 % 256) / 255;
    for (Eigen::Index i = 0; i < rows; ++i) colors(i, 3) = 1;
    return colors;
}

void add_texcoords(Mesh& mesh, bool seam) {
    mesh.texcoords.resize(mesh.positions.rows() + (seam ? 1 : 0), 2);
    for (Eigen::Index i = 0; i < mesh.texcoords.rows(); ++i) mesh.texcoords.row(i) << float(i) / 7, float(i % 5) / 3;
    mesh.texcoord_triangles = mesh.triangles;
    if (seam) mesh.texcoord_triangles(1, 0) = static_cast<int>(mesh.positions.rows());
}

// Each corner's texture coordinate, whatever the order in which they are kept.
Eigen::MatrixXf corner_texcoords(const Mesh& mesh) {
    Eigen::MatrixXf result(mesh.texcoord_triangles.rows(), 6);
    for (Eigen::Index t = 0; t < result.rows(); ++t)
        for (int k = 0; k < 3; ++k) result.block<1, 2>(t, 2 * k) = mesh.texcoords.row(mesh.texcoord_triangles(t, k));
    return result;
}

TEST_F(Formats, WhatIsWrittenIsReadToTheLastBit) {
    for (const char* name : {"a.obj", "a.ply", "a.off"}) {
        for (const bool colored : {false, true}) {
            Mesh mesh = awkward_sheet();
            if (colored) mesh.colors = byte_colors(mesh.positions.rows());
            const Mesh back = again(mesh, name);
            EXPECT_EQ(back.positions, mesh.positions) << name;
            EXPECT_EQ(back.triangles, mesh.triangles) << name;
            EXPECT_EQ(back.colors, mesh.colors) << name;
            EXPECT_EQ(back.texcoords.rows(), 0) << name;
        }
    }
}

TEST_F(Formats, TextureCoordinatesAreKeptWithAndWithoutSeams) {
    for (const char* name : {"a.obj", "a.ply"})
        for (const bool seam : {false, true}) {
            Mesh mesh = awkward_sheet();
            add_texcoords(mesh, seam);
            const Mesh back = again(mesh, name);
            EXPECT_EQ(back.positions, mesh.positions) << name;
            EXPECT_EQ(back.texcoords.rows(), mesh.texcoords.rows()) << name;
            EXPECT_EQ(corner_texcoords(back), corner_texcoords(mesh)) << name << (seam ? " with a seam" : "");
        }
}

// Other programs know colours by their bytes, and tell fractions from bytes by their point.
TEST_F(Formats, ColoursAreWrittenAsOtherProgramsReadThem) {
    Mesh mesh = unit_cube();
    mesh.colors = Colors::Constant(8, 4, 0.3F);
    mesh.colors.row(0) << 1, 0, 1e-5F, 2;
    const Colors colors = again(mesh, "a.ply").colors;
    EXPECT_NEAR(colors(1, 0), 0.3, 0.51 / 255);
    EXPECT_EQ(colors.row(0), Eigen::RowVector4f(1, 0, 0, 1));
    EXPECT_NE(read_whole(scratch.path("a.ply")).find("property uchar red"), std::string::npos);
    again(mesh, "a.off");
    EXPECT_NE(read_whole(scratch.path("a.off")).find("0 0 0 1.0 0.0 0.000010000 2.0\n1 0 0 0.3 0.3 0.3 0.3\n"),
              std::string::npos);
    mesh.colors.setConstant(0.2F);
    again(mesh, "a.off");
    EXPECT_NE(read_whole(scratch.path("a.off")).find("1 0 0 51 51 51 51\n"), std::string::npos);
}

TEST_F(Formats, StlIsWeldedInOrderOfFirstAppearance) {
    Mesh mesh = wavy_sheet(5, 6);
    mesh.positions = mesh.positions.cast<float>().cast<double>();
    const Mesh back = again(mesh, "a.stl");
    ASSERT_EQ(back.positions.rows(), mesh.positions.rows());
    std::vector<int> seen;
    for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i)
        if (std::find(seen.begin(), seen.end(), mesh.triangles.data()[i]) == seen.end())
            seen.push_back(mesh.triangles.data()[i]);
    for (std::size_t i = 0; i < seen.size(); ++i)
        EXPECT_EQ(back.positions.row(static_cast<Eigen::Index>(i)), mesh.positions.row(seen[i])) << i;
    for (Eigen::Index i = 0; i < mesh.triangles.size(); ++i)
        EXPECT_EQ(back.positions.row(back.triangles.data()[i]), mesh.positions.row(mesh.triangles.data()[i]));
}

TEST_F(Formats, ThousandsOfPlacesAreWeldedOnce) {
    Mesh mesh = wavy_sheet(90, 90);
    mesh.positions = mesh.positions.cast<float>().cast<double>();
    EXPECT_EQ(again(mesh, "a.stl").positions.rows(), 8100);
}

TEST_F(Formats, TextStl) {
    const Mesh mesh =
        read("a.stl", "solid two words\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n"
                      "   vertex 0 1 0\n  endloop\n endfacet\n facet normal 0 0 1\n  outer loop\n"
                      "   vertex 1 0 -0\n   vertex 1 1 0.1\n   vertex 0 1 0\n  endloop\n endfacet\n"
                      "endsolid two words\n");
    EXPECT_EQ(mesh.positions.rows(), 4);
    EXPECT_EQ(mesh.positions(3, 2), 0.1);
    EXPECT_EQ(mesh.triangles.row(1), Eigen::RowVector3i(1, 3, 2));
}

TEST_F(Formats, BinaryStlThatBeginsWithSolid) {
    write_mesh(unit_cube(), scratch.path("a.stl"));
    std::string bytes = read_whole(scratch.path("a.stl"));
    bytes.replace(0, 6, "solid ");
    EXPECT_EQ(read("b.stl", bytes).triangles.rows(), 12);
}

// A PLY file in any of its encodings: numbers are put one by one.
class PlyMaker {
public:
    PlyMaker(std::string_view encoding, std::string_view header) : encoding_(encoding) {
        bytes = "ply\nformat " + encoding_ + " 1.0\n" + std::string(header) + "end_header\n";
    }
    template <typename Number>
    PlyMaker& put(std::initializer_list<Number> values) {
        for (const Number value : values)
            if (encoding_ == "ascii") {
                bytes += std::to_string(value) + (++words_ % 5 == 0 ? "\r\n" : " ");
            } else {
                std::array<char, sizeof(Number)> raw;
                std::memcpy(raw.data(), &value, sizeof value);
                if (encoding_ == "binary_big_endian") std::reverse(raw.begin(), raw.end());
                bytes.append(raw.data(), raw.size());
            }
        return *this;
    }
    std::string bytes;

private:
    std::string encoding_;
    int words_ = 0;
};

TEST_F(Formats, PlyInEveryEncodingWithPropertiesOfNoConcern) {
    for (const char* encoding : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        PlyMaker ply(encoding, "comment made by hand\nobj_info none\nelement camera 1\nproperty list uchar float view\n"
                               "property short id\nelement vertex 4\nproperty float x\nproperty list uchar int marks\n"
                               "property double y\nproperty float z\nproperty float nx\nproperty uchar red\n"
                               "property uchar green\nproperty uchar blue\nproperty float s\nproperty float t\n"
                               "element face 2\nproperty uchar flags\nproperty list uchar uint vertex_indices\n"
                               "element edge 1\nproperty int vertex1\nproperty int vertex2\n");
        ply.put<std::uint8_t>({2}).put<float>({1, 2}).put<std::int16_t>({-7});
        for (int i = 0; i < 4; ++i)
            ply.put<float>({float(i % 2)})
                .put<std::uint8_t>({1})
                .put<std::int32_t>({-1})
                .put<double>({double(i / 2)})
                .put<float>({0.5F, 9})
                .put<std::uint8_t>({std::uint8_t(51 * i), 0, 255})
                .put<float>({float(i), 0.25F});
        ply.put<std::uint8_t>({1, 3}).put<std::uint32_t>({0, 1, 2});
        ply.put<std::uint8_t>({1, 4}).put<std::uint32_t>({0, 1, 3, 2}).put<std::int32_t>({0, 1});
        const Mesh mesh = read("a.ply", ply.bytes);
        EXPECT_EQ(mesh.positions.rows(), 4) << encoding;
        EXPECT_EQ(mesh.positions.row(3), Point(1, 1, 0.5)) << encoding;
        EXPECT_EQ(mesh.triangles.rows(), 3) << encoding;
        EXPECT_EQ(mesh.triangles.row(2), Eigen::RowVector3i(0, 3, 2)) << encoding;
        EXPECT_EQ(mesh.colors.row(3), Eigen::RowVector4f(0.6F, 0, 1, 1)) << encoding;
        EXPECT_EQ(mesh.texcoords.row(2), Eigen::RowVector2f(2, 0.25F)) << encoding;
        EXPECT_EQ(mesh.texcoord_triangles, mesh.triangles) << encoding;
    }
}

TEST_F(Formats, PlyTextureCoordinatesOfCornersAreShared) {
    PlyMaker ply("ascii", "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
                          "property list uchar float texcoord\nproperty list uchar int vertex_index\n");
    ply.put<int>({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
    ply.put<int>({6, 0, 0, 1, 0, 0, 1, 3, 0, 1, 2, 6, 1, 0, 5, 5, 0, 1, 3, 1, 3, 2});
    const Mesh mesh = read("a.ply", ply.bytes);
    EXPECT_EQ(mesh.texcoords.rows(), 4);
    EXPECT_EQ(mesh.texcoord_triangles.row(0), Eigen::RowVector3i(0, 1, 2));
    EXPECT_EQ(mesh.texcoord_triangles.row(1), Eigen::RowVector3i(1, 3, 2));
}

TEST_F(Formats, OffWithItsVariants) {
    const Mesh plain = read("a.off", "# made by hand\nOFF # yes\n4 2 5\n\n0 0 0\n1 0 0 # second\n0 1 0\n1 1 0\n"
                                     "3 0 1 2 255 0 0\n# last\n3 1 3 2\n");
    EXPECT_EQ(plain.positions.rows(), 4);
    EXPECT_EQ(plain.triangles.row(1), Eigen::RowVector3i(1, 3, 2));
    EXPECT_EQ(plain.colors.rows(), 0);
    const Mesh colored = read("b.off", "COFF 3 1\n0 0 0 255 0 51 255\n1 0 0 0 0 0 255\n0 1 0 0 0 0 255\n3 0 1 2");
    EXPECT_EQ(colored.colors.row(0), Eigen::RowVector4f(1, 0, 0.2F, 1));
    const Mesh full = read("c.off", "STCNOFF\n3 1 0\n0 0 0  0 0 1  1 0 0 1  .5 .25\n1 0 0  0 0 1  1 0 0 1  1 0\n"
                                    "0 1 0  0 0 1  1 0 0 1  0 1\n3 0 1 2\n");
    EXPECT_EQ(full.texcoords.row(0), Eigen::RowVector2f(0.5F, 0.25F));
    EXPECT_EQ(full.colors.row(0), Eigen::RowVector4f(1, 0, 0, 1));
}

TEST_F(Formats, ExtensionsInAnyCase) {
    EXPECT_EQ(again(unit_cube(), "a.OBJ").triangles, unit_cube().triangles);
    EXPECT_EQ(again(unit_cube(), "b.Ply").triangles, unit_cube().triangles);
}

} // namespace
} // namespace meshtween
