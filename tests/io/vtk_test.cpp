// VTK's two formats: files that VTK wrote, files that come back as they were, and what is neither.
#include "meshtween/geometry/measure.h"
#include "meshtween/io/base64.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"
#include "meshtween/io/space.h"

#include "io/vtk_samples.h"
#include "support/errors.h"
#include "support/scratch.h"
#include "support/shapes.h"

#include <algorithm>

namespace meshtween {
namespace {

struct Sample {
    const char* name;
    std::string bytes;
};

std::vector<Sample> samples() {
    return {{"text.vtk", vtk_text_5},
            {"binary4.vtk", *from_base64(vtk_binary_4_base64)},
            {"binary5.vtk", *from_base64(vtk_binary_5_base64)},
            {"appended.vtp", vtp_appended_base64},
            {"raw.vtp", *from_base64(vtp_appended_raw_base64)},
            {"inline.vtp", vtp_inline_big_endian},
            {"text.vtp", vtp_text}};
}

class Vtk : public testing::Test {
protected:
    Mesh read(std::string_view name, std::string_view contents) const {
        return read_mesh(scratch.file(name, contents));
    }
    std::string written(const Mesh& mesh, std::string_view name) const {
        write_mesh(mesh, scratch.path(name));
        return read_whole(scratch.path(name));
    }
    bool notes(const Mesh& mesh, std::string_view words) const {
        return std::any_of(mesh.file->notes.begin(), mesh.file->notes.end(),
                           [&](const std::string& note) { return note.find(words) != std::string::npos; });
    }
    Scratch scratch;
};

TEST_F(Vtk, WhatVtkWritesIsReadInEveryEncoding) {
    for (const Sample& sample : samples()) {
        SCOPED_TRACE(sample.name);
        const Mesh mesh = read(sample.name, sample.bytes);
        ASSERT_EQ(mesh.positions.rows(), 5);
        EXPECT_EQ(mesh.positions.row(2), Point(2, 2, 0));
        EXPECT_NEAR(mesh.positions(4, 2), 1.1, 1e-7);
        EXPECT_EQ(mesh.triangles.rows(), 6);
        EXPECT_EQ(mesh.file->ends, (std::vector{4, 7, 10, 13, 16}));
        EXPECT_EQ(mesh.file->corners, (std::vector{0, 3, 2, 1, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4}));
        ASSERT_EQ(mesh.colors.rows(), 5);
        EXPECT_EQ(mesh.colors.row(1), Eigen::RowVector4f(0, 1, 0, 1));
        EXPECT_EQ(mesh.colors(3, 1), 4.0F / 255);
        EXPECT_EQ(mesh.texcoords.row(mesh.texcoord_triangles(5, 2)), Eigen::RowVector2f(0.5F, 0.5F));
        ASSERT_EQ(mesh.file->normals.rows(), 5);
        EXPECT_NEAR(mesh.file->normals(0, 1), -0.863433, 1e-6);
        EXPECT_TRUE(notes(mesh, "1 vertices and lines beside the surface"));
        EXPECT_EQ(mesh.file->notes.size(), 1U);
        const std::vector<std::string>& only = mesh.file->only_here;
        EXPECT_EQ(std::count(only.begin(), only.end(), "the point data 'my curvature'"), 1);
        EXPECT_EQ(std::count(only.begin(), only.end(), "the cell data 'label'"), 1);
    }
}

TEST_F(Vtk, SameFormatIsTheSameFileWithOtherPoints) {
    for (const Sample& sample : samples()) {
        SCOPED_TRACE(sample.name);
        Mesh mesh = read(sample.name, sample.bytes);
        const Mesh same = read("same_" + std::string(sample.name), written(mesh, sample.name));
        EXPECT_EQ(same.positions, mesh.positions);
        mesh.positions = (mesh.positions.array() * 2 + 1).matrix(); // the normals stay
        const Mesh back = read("b_" + std::string(sample.name), written(mesh, sample.name));
        EXPECT_LT((back.positions - mesh.positions).norm(), 1e-6);
        EXPECT_EQ(back.triangles, mesh.triangles);
        EXPECT_EQ(back.file->ends, mesh.file->ends);
        EXPECT_EQ(back.colors, mesh.colors);
        EXPECT_EQ(back.texcoords, mesh.texcoords);
        EXPECT_EQ(back.file->only_here, mesh.file->only_here);
        EXPECT_EQ(back.file->notes, mesh.file->notes);
        const Points normals = vertex_normals(mesh.positions, mesh.triangles);
        EXPECT_LT((back.file->normals - normals).norm(), 1e-6);
    }
}

TEST_F(Vtk, AllButTheNumbersOfPointsAndNormalsStays) {
    const auto without = [](std::string bytes, std::string_view from, std::string_view to) {
        const std::size_t begin = bytes.find(from), end = bytes.find(to, begin);
        return bytes.erase(begin, end - begin);
    };
    for (const Sample& sample : samples()) {
        if (std::string_view(sample.name).find(".vtk") == std::string_view::npos) continue;
        SCOPED_TRACE(sample.name);
        Mesh mesh = read(sample.name, sample.bytes);
        mesh.positions(4, 2) = 3;
        const std::string now = written(mesh, sample.name);
        EXPECT_NE(now, sample.bytes);
        const auto rest = [&](const std::string& bytes) {
            return without(without(bytes, " float\n", "LINES"), "Normals float\n", "TEXTURE_COORDINATES");
        };
        EXPECT_EQ(rest(now), rest(sample.bytes));
        if (std::string_view(sample.name) != "text.vtk") {
            EXPECT_EQ(now.size(), sample.bytes.size());
        }
    }
}

TEST_F(Vtk, WhatIsWrittenAnewIsReadToTheLastBit) {
    for (const char* name : {"a.vtk", "a.vtp"}) {
        Mesh mesh = wavy_sheet(9, 14);
        mesh.positions = (mesh.positions.array() * 1e5 / 3).matrix();
        mesh.positions(0, 0) = 1e-300;
        mesh.colors.resize(mesh.positions.rows(), 4);
        for (Eigen::Index i = 0; i < mesh.colors.size(); ++i) mesh.colors.data()[i] = float(i * 37 % 256) / 255;
        mesh.texcoords = mesh.positions.leftCols(2).cast<float>();
        mesh.texcoord_triangles = mesh.triangles;
        EXPECT_TRUE(write_mesh(mesh, scratch.path(name)).empty());
        const Mesh back = read_mesh(scratch.path(name));
        EXPECT_EQ(back.positions, mesh.positions) << name;
        EXPECT_EQ(back.triangles, mesh.triangles) << name;
        EXPECT_EQ(back.colors, mesh.colors) << name;
        EXPECT_EQ(back.texcoords, mesh.texcoords) << name;
    }
}

TEST_F(Vtk, SlicersMarkOfTheCoordinateSystemIsReadAndCarriedAlong) {
    for (const Sample& sample : samples()) {
        const Mesh mesh = read(sample.name, sample.bytes);
        EXPECT_EQ(space_of(mesh), Space::lps) << sample.name;
        for (const char* other : {"other.vtk", "other.vtp"}) {
            Mesh moved = mesh;
            moved.colors(0, 0) = 0.5F; // not the file's: it is written anew
            write_mesh(moved, scratch.path(other));
            EXPECT_EQ(space_of(read_mesh(scratch.path(other))), Space::lps) << sample.name << " to " << other;
        }
    }
    std::string silent = vtk_text_5;
    silent.replace(silent.find(" SPACE=LPS"), 10, "");
    EXPECT_EQ(space_of(read("a.vtk", silent)), Space::lps); // by the field data
    silent.replace(silent.find("\nLPS\n"), 5, "\nRAS\n");
    EXPECT_EQ(space_of(read("a.vtk", silent)), Space::ras);
}

TEST_F(Vtk, PolygonsOfOtherFormatsAreKeptAndSeamsAreTold) {
    for (const char* name : {"a.vtk", "a.vtp"}) {
        const Mesh quads = read("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nf 1 2 3 4\nf 2 5 3\n");
        EXPECT_TRUE(write_mesh(quads, scratch.path(name)).empty());
        EXPECT_EQ(read_mesh(scratch.path(name)).file->ends, (std::vector{4, 7})) << name;
        const Mesh seam = read("b.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 2 0 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                                        "f 1/1 2/2 3/3\nf 2/1 4/2 3/3\n");
        const std::vector<std::string> told = write_mesh(seam, scratch.path(name));
        ASSERT_EQ(told.size(), 1U) << name;
        EXPECT_NE(told[0].find("seams need two"), std::string::npos) << told[0];
    }
}

TEST_F(Vtk, TriangleStripsTurnAlike) {
    const Mesh mesh = read("a.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n"
                                    "0 0 0 0 1 0 1 0 0 1 1 0 2 0 0\nTRIANGLE_STRIPS 1 6\n5 0 2 1 3 4\n");
    ASSERT_EQ(mesh.triangles.rows(), 3);
    EXPECT_EQ(mesh.triangles.row(1), Eigen::RowVector3i(1, 2, 3));
    EXPECT_TRUE(notes(mesh, "1 triangle strips"));
    // Repeated corners hang strips together and are no faces.
    const Mesh hung = read("b.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 5 float\n"
                                    "0 0 0 0 1 0 1 0 0 1 1 0 2 0 0\nTRIANGLE_STRIPS 1 8\n7 0 2 1 1 2 4 3\n");
    EXPECT_EQ(hung.triangles.rows(), 3);
}

TEST_F(Vtk, SurfaceCellsOfAnUnstructuredGrid) {
    const Mesh mesh = read("a.vtk", "# vtk DataFile Version 4.2\nwritten by meshio\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                                    "POINTS 4 double\n0 0 0 1 0 0 0 1 0 1 1 0\nCELLS 3 12\n4 0 1 2 3\n3 0 1 2\n2 0 1\n"
                                    "CELL_TYPES 3\n8 5 3\n");
    EXPECT_EQ(mesh.file->corners, (std::vector{0, 1, 3, 2, 0, 1, 2}));
    EXPECT_TRUE(notes(mesh, "1 vertices and lines"));
}

TEST_F(Vtk, PiecesBecomeOneMeshAndStayPieces) {
    const std::string piece =
        "<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points><DataArray type=\"Float64\" "
        "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points><Polys>"
        "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>"
        "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys></Piece>";
    Mesh mesh = read("a.vtp",
                     "<VTKFile type=\"PolyData\" version=\"0.1\"><PolyData>" + piece + piece + "</PolyData></VTKFile>");
    EXPECT_EQ(mesh.file->corners, (std::vector{0, 1, 2, 3, 4, 5}));
    mesh.positions(5, 0) = 7;
    const std::string now = written(mesh, "a.vtp");
    EXPECT_EQ(read("b.vtp", now).positions, mesh.positions);
    EXPECT_NE(now.rfind("<Piece"), now.find("<Piece"));
}

TEST_F(Vtk, WhatIsNoPartOfTheShapeRefusesNothing) {
    const std::string head =
        "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
        "POLYGONS 2 7\n3 0 1 2\n2 0 1\n";
    EXPECT_TRUE(notes(read("a.vtk", head), "1 faces of fewer than three corners"));
    const char* tails[] = {"POINT_DATA 3\nSCALARS s float 1\nLOOKUP_TABLE default\n1 2\n", "POINT_DATA three\n",
                           "POINT_DATA 3\nELEPHANTS e float\n1 2 3\n", "POINT_DATA 3\nVECTORS v quaternion\n"};
    for (const char* tail : tails) {
        const Mesh mesh = read("a.vtk", head + tail);
        EXPECT_EQ(mesh.triangles.rows(), 1) << tail;
        EXPECT_TRUE(notes(mesh, "what comes after the faces was passed over")) << tail;
    }
    const Mesh four = read("a.vtk", head + "POINT_DATA 4\nNORMALS n float\n0 0 1 0 0 1 0 0 1 0 0 1\n");
    EXPECT_TRUE(notes(four, "data of 4 points are passed over, because there are 3 points"));
    EXPECT_EQ(four.file->normals.rows(), 0);
}

TEST_F(Vtk, NormalsThatPointInwardsDoSoAgain) {
    Mesh mesh =
        read("a.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
                      "POLYGONS 1 4\n3 0 1 2\nPOINT_DATA 3\nNORMALS n float\n0 0 -1 0 0 -1 0 0 -1\n");
    mesh.positions.col(2).swap(mesh.positions.col(0)); // now in the plane of y and z, turned to -x
    EXPECT_EQ(read("b.vtk", written(mesh, "b.vtk")).file->normals.row(1), Point(1, 0, 0));
}

} // namespace
} // namespace meshtween
