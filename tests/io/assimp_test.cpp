// FBX, Collada and 3MF: what comes through assimp, and what is said where it is missing.
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include "support/errors.h"
#include "support/scratch.h"
#include "support/shapes.h"

#include <algorithm>

namespace meshtween {
namespace {

class Assimp : public testing::Test {
protected:
    Mesh read(std::string_view name, std::string_view contents) const {
        return read_mesh(scratch.file(name, contents));
    }
    Scratch scratch;
};

#ifdef MESHTWEEN_ASSIMP

bool notes(const Mesh& mesh, std::string_view words) {
    return std::any_of(mesh.file->notes.begin(), mesh.file->notes.end(),
                       [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

constexpr const char* fbx = R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {
    FBXHeaderVersion: 1003
    FBXVersion: 7400
}
Objects:  {
    Geometry: 1, "Geometry::roof", "Mesh" {
        Vertices: *18 {
            a: 0,0,0,1,0,0,1,1,0,0,1,0,1,0,1,1,1,1
        }
        PolygonVertexIndex: *8 {
            a: 0,1,2,-4,1,4,5,-3
        }
    }
    Model: 2, "Model::roof", "Mesh" {
        Properties70:  {
            P: "Lcl Translation", "Lcl Translation", "", "A",10,0,0
        }
    }
}
Connections:  {
    C: "OO",1,2
    C: "OO",2,0
}
)";

TEST_F(Assimp, FbxKeepsPolygonsAndJoinsWhatLiesInOnePlace) {
    const Mesh mesh = read("a.fbx", fbx);
    ASSERT_EQ(mesh.positions.rows(), 6);
    EXPECT_EQ(mesh.file->ends, (std::vector{4, 8}));
    EXPECT_EQ(mesh.file->corners, (std::vector{0, 1, 2, 3, 1, 4, 5, 2}));
    EXPECT_EQ(mesh.positions.row(5), Point(11, 1, 1));
    EXPECT_TRUE(notes(mesh, "in order of their first use"));
    EXPECT_EQ(mesh.file->objects.names, std::vector<std::string>{"roof"});
}

TEST_F(Assimp, WhatIsWrittenIsReadAgain) {
    const Mesh quads = read("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 0.5\n"
                                     "f 1/1 2/2 3/3 4/4\nf 2/1 5/2 3/3\n");
    const std::vector<std::string> told = write_mesh(quads, scratch.path("b.dae"));
    EXPECT_NE(told.front().find("may number its vertices anew"), std::string::npos);
    const Mesh back = read_mesh(scratch.path("b.dae"));
    EXPECT_EQ(back.positions, quads.positions);
    EXPECT_EQ(back.file->ends, quads.file->ends);
    EXPECT_EQ(back.triangles, quads.triangles);
    for (Eigen::Index t = 0; t < back.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            EXPECT_EQ(back.texcoords.row(back.texcoord_triangles(t, k)),
                      quads.texcoords.row(quads.texcoord_triangles(t, k)));
    write_mesh(quads, scratch.path("b.3mf"));
    const Mesh solid = read_mesh(scratch.path("b.3mf"));
    EXPECT_EQ(solid.positions, quads.positions);
    EXPECT_EQ(solid.triangles, quads.triangles);
    EXPECT_FALSE(notes(solid, "first use"));
}

TEST_F(Assimp, BadFilesAreTold) {
    const struct {
        const char* name;
        std::string contents;
        const char* words;
    } rows[] = {
        {"a.fbx", "", "the file is empty"},
        {"a.fbx", "garbage", "assimp, which reads this format, says"},
        {"a.fbx", std::string(fbx).substr(0, 300), ""},
        {"a.fbx", std::string("Kaydara FBX Binary  \0\x1a\0\xe8\x1c\0\0\xff\xff\xff\x7f", 31), "assimp"},
        {"a.dae", "<COLLADA version=\"1.4.1\"><library_geometries>", "assimp"},
        {"a.dae", "garbage", "assimp"},
        {"a.3mf", "PK\3\4garbage", ""},
        {"a.3mf", "garbage", ""},
    };
    for (const auto& row : rows) {
        const auto path = scratch.file(row.name, row.contents);
        const std::string message = message_of(ErrorKind::file, [&] { read_mesh(path); });
        EXPECT_NE(message.find(row.words), std::string::npos) << message;
        EXPECT_NE(message.find(path.string()), std::string::npos) << message;
    }
}

#else

TEST_F(Assimp, ItsNameIsToldWhereItIsMissing) {
    for (const char* name : {"a.fbx", "a.dae", "a.3mf"})
        EXPECT_NE(message_of(ErrorKind::file, [&] { read(name, "x"); }).find("library assimp"), std::string::npos);
    EXPECT_NE(message_of(ErrorKind::argument, [&] { write_mesh(unit_cube(), scratch.path("a.dae")); }).find("assimp"),
              std::string::npos);
}

#endif

TEST_F(Assimp, FbxIsNotWritten) {
    EXPECT_NE(
        message_of(ErrorKind::argument, [&] { write_mesh(unit_cube(), scratch.path("a.fbx")); }).find("not written"),
        std::string::npos);
    EXPECT_EQ(scratch.entries(), 0);
}

} // namespace
} // namespace meshtween
