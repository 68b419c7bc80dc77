// What a mesh's file has, the written file has: line for line or byte for byte in its own format, else all that the
// other can hold and a word about the rest.
#include "meshtween/core/error.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include "support/scratch.h"
#include "support/shapes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <sstream>

namespace meshtween {
namespace {

class Kept : public testing::Test {
protected:
    // The file read and written under another name, its vertices moved up by one.
    std::string moved(const std::string& name, const std::string& contents) {
        Mesh mesh = read_mesh(scratch.file(name, contents));
        mesh.positions.col(2).array() += 1;
        notes_ = write_mesh(mesh, scratch.path("moved_" + name));
        return read_whole(scratch.path("moved_" + name));
    }
    std::string all_notes() const {
        std::string all;
        for (const std::string& note : notes_) all += note + "\n";
        return all;
    }
    Scratch scratch;
    std::vector<std::string> notes_;
};

const std::string box =
    "# a box\r\nmtllib box.mtl\r\no box\r\nv 0 0 0\r\nv  1 0   0 0.5 0.5 1\r\nv 1 1 0\r\nv 0 1 0 # last\r\n"
    "v 9 9 9\r\nvt 0 0\r\nvt 1 0\r\nvt 1 1\r\nvn 0 0 1\r\nvn 0 0 2 \r\ng side\r\nusemtl C:\\red\\\r\ns 1\r\n"
    "f 1/1/1 2/2/1 3/3/1 \\\r\n 4/1/1\r\nl 1 2\r\ng rest\r\nusemtl blue\r\ns off\r\nf 3/3/2 2/2/2 1/1/2\r\n"
    "cstype bezier\r\n# end";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

TEST_F(Kept, AnObjComesBackButForItsCoordinates) {
    std::string expected = box;
    const std::vector<std::pair<std::string, std::string>> changes{
        {"v 0 0 0", "v 0 0 1"},  {"v  1 0   0 0.5", "v  1 0   1 0.5"},
        {"v 1 1 0", "v 1 1 1"},  {"v 0 1 0 #", "v 0 1 1 #"},
        {"v 9 9 9", "v 9 9 10"}, {"vn 0 0 2 ", "vn 0 0 -1 "}};
    for (const auto& [what, by] : changes) expected = replaced(expected, what, by);
    EXPECT_EQ(moved("a.obj", box), expected);
    EXPECT_EQ(all_notes(), "");
    EXPECT_EQ(moved("b.obj", replaced(box, "\r\n", "\r")), replaced(expected, "\r\n", "\r"));
}

TEST_F(Kept, AnObjThatDidNotMoveIsTheSameFile) {
    const Mesh mesh = read_mesh(scratch.file("a.obj", box));
    write_mesh(mesh, scratch.path("b.obj"));
    EXPECT_EQ(read_whole(scratch.path("b.obj")), box);
}

TEST_F(Kept, AnObjIsReadWithItsNamesAndMaterials) {
    scratch.file("box.mtl", "newmtl blue\nKd 0 0.25 1\nd 0.5\nmap_Kd -s 1 1 1 -clamp on my skin.png\nnewmtl C:\\red\\\n"
                            "Kd 1 0 0\nPr 0.25\nmap_Kd absent.png\n");
    scratch.file("my skin.png", "picture");
    const Mesh mesh = read_mesh(scratch.file("a.obj", box));
    const MeshFile& file = *mesh.file;
    EXPECT_EQ(file.ends, (std::vector{4, 7}));
    EXPECT_EQ(file.groups.names, (std::vector<std::string>{"side", "rest"}));
    EXPECT_EQ(file.groups.of, (std::vector{0, 1}));
    EXPECT_EQ(file.objects.of, (std::vector{0, 0}));
    EXPECT_EQ(file.smoothing.names, (std::vector<std::string>{"1", "off"}));
    ASSERT_EQ(file.materials.size(), 2U);
    EXPECT_EQ(file.materials[0].name, "C:\\red\\");
    EXPECT_EQ(file.materials[0].base_color, (std::array{1.0F, 0.0F, 0.0F, 1.0F}));
    EXPECT_EQ(file.materials[0].base_color_image, -1);
    EXPECT_EQ(file.materials[1].base_color, (std::array{0.0F, 0.25F, 1.0F, 0.5F}));
    ASSERT_EQ(file.materials[1].base_color_image, 0);
    EXPECT_EQ(file.images[0].path, scratch.path("my skin.png"));
    EXPECT_EQ(file.polygon_materials, (std::vector{0, 1}));
    EXPECT_EQ(file.normals.rows(), 2);
    EXPECT_EQ(polygon_of_triangles(file), (std::vector{0, 0, 1}));
    ASSERT_EQ(file.notes.size(), 1U);
    EXPECT_NE(file.notes[0].find("no picture absent.png"), std::string::npos);
    ASSERT_EQ(file.only_here.size(), 1U);
}

// A roof of two quads: its normals are bent into the new shape, split along the ridge where the file splits them.
TEST_F(Kept, NormalsAreThoseOfTheNewShapeSplitWhereTheFileSplitsThem) {
    const std::string flat = "v 0 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv 2 0 0\nv 2 1 0\n";
    const auto normals = [&](const std::string& rest) {
        Mesh mesh = read_mesh(scratch.file("roof.obj", flat + rest));
        mesh.positions(2, 2) = mesh.positions(3, 2) = 1;
        write_mesh(mesh, scratch.path("bent.obj"));
        return read_mesh(scratch.path("bent.obj")).file->normals;
    };
    const double s = std::sqrt(0.5);
    const Points hard = normals("vn 1 0 0\nvn 0 0 1\nf 1//1 3//1 4//1 2//1\nf 3//2 5//2 6//2 4//2\n");
    EXPECT_NEAR((hard.row(0) - Point(-s, 0, s)).norm(), 0, 1e-6);
    EXPECT_NEAR((hard.row(1) - Point(s, 0, s)).norm(), 0, 1e-6);
    const Points soft =
        normals("vn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nf 1//1 3//2 4//2 2//1\nf 3//3 5//4 6//4 4//3\n");
    EXPECT_NEAR((soft.row(1) - Point(0, 0, 1)).norm(), 0, 1e-6) << "alike in one place stay alike";
    EXPECT_EQ(soft.row(1), soft.row(2));
    EXPECT_NEAR((soft.row(0) - Point(-s, 0, s)).norm(), 0, 1e-6);
}

TEST_F(Kept, LibrariesAndPicturesAreFoundFromWhereTheResultLies) {
    const auto make = [&](const char* folder) { std::filesystem::create_directories(scratch.path(folder)); };
    make("in/maps"), make("in/else"), make("shared"), make("out"), make("referring"), make("taken");
    scratch.file("in/box.mtl",
                 "newmtl a\r\nmap_Kd maps\\skin.png\r\nbump ../shared/bump.png # odd\nmap_Kd ../shared/b.png\n");
    scratch.file("in/maps/skin.png", "skin");
    scratch.file("shared/b.png", "b");
    const Mesh mesh =
        read_mesh(scratch.file("in/a.obj", "mtllib box.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    EXPECT_TRUE(write_mesh(mesh, scratch.path("out/a.obj")).empty());
    EXPECT_EQ(read_whole(scratch.path("out/a.obj")), read_whole(scratch.path("in/a.obj")));
    EXPECT_EQ(read_whole(scratch.path("out/maps/skin.png")), "skin");
    EXPECT_EQ(read_whole(scratch.path("out/b.png")), "b") << "what lay outside of the folder";
    EXPECT_EQ(read_whole(scratch.path("out/box.mtl")),
              "newmtl a\r\nmap_Kd maps\\skin.png\r\nbump ../shared/bump.png # odd\nmap_Kd b.png\n");
    EXPECT_TRUE(write_mesh(mesh, scratch.path("out/a.obj")).empty()) << "they lie there already";

    write_mesh(mesh, scratch.path("referring/a.obj"), {Textures::refer});
    EXPECT_EQ(read_whole(scratch.path("referring/a.obj")).substr(0, 22), "mtllib ../in/box.mtl\nu");
    EXPECT_EQ(read_mesh(scratch.path("referring/a.obj")).file->images.size(), 2U);
    EXPECT_FALSE(std::filesystem::exists(scratch.path("referring/box.mtl")));

    scratch.file("taken/box.mtl", "newmtl other\n");
    const auto notes = write_mesh(mesh, scratch.path("taken/a.obj"));
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find("a different file of this name is there"), std::string::npos) << notes[0];
    EXPECT_EQ(read_whole(scratch.path("taken/box.mtl")), "newmtl other\n");
}

TEST_F(Kept, ALibraryThatIsNamedAgainAndAgainIsReadOnce) {
    std::string library = "newmtl a\nKd 1 0 0\n", statements;
    for (int i = 0; i < 400'000; ++i) library += "# no more\n";
    for (int i = 0; i < 4'000; ++i) statements += i % 2 == 0 ? "mtllib box.mtl\n" : "mtllib ./box.mtl\n";
    scratch.file("box.mtl", library);
    std::filesystem::create_directory(scratch.path("out"));
    const std::string contents = statements + "usemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const Mesh mesh = read_mesh(scratch.file("a.obj", contents));
    ASSERT_EQ(mesh.file->materials.size(), 1U);
    EXPECT_EQ(mesh.file->materials[0].base_color[1], 0);
    EXPECT_TRUE(write_mesh(mesh, scratch.path("out/a.obj")).empty());
    EXPECT_EQ(read_whole(scratch.path("out/a.obj")), contents);
    EXPECT_EQ(read_whole(scratch.path("out/box.mtl")), library);
}

TEST_F(Kept, NothingButPicturesAndLibrariesIsCopied) {
    std::filesystem::create_directories(scratch.path("out"));
    scratch.file("secret", "words");
    scratch.file("a.mtl", "newmtl a\nmap_Kd secret\n");
    const Mesh mesh = read_mesh(scratch.file("a.obj", "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    const auto notes = write_mesh(mesh, scratch.path("out/a.obj"));
    EXPECT_FALSE(std::filesystem::exists(scratch.path("out/secret")));
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find("no picture by its name"), std::string::npos);
}

const std::string rich_ply =
    "ply\nformat ascii 1.0\ncomment made by hand\nobj_info none\ncomment TextureFile skin.png\n"
    "element vertex 4\nproperty float quality\nproperty float x\nproperty double y\nproperty float z\n"
    "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\n"
    "property uchar green\nproperty uchar blue\nelement face 2\nproperty uchar flags\n"
    "property list uchar int vertex_indices\nelement edge 1\nproperty int vertex1\n"
    "property int vertex2\nend_header\n";

TEST_F(Kept, APlyComesBackButForItsCoordinates) {
    const std::string body = "0.5 0 0 0 0 0 1 255 0 0\n1.#INF  1 0 0 0 0 1 0 255 0\n7 1 1 0 0 0 1 0 0 9 surplus\n"
                             "7 0 1 0 0 0 1 0 0 0\n3 4 0 1 2 3\n3 3 2 1 0\n0 1\n";
    std::string expected = rich_ply + "0.5 0 0 1 0 0 1 255 0 0\n1.#INF  1 0 1 0 0 1 0 255 0\n"
                                      "7 1 1 1 0 0 1 0 0 9 surplus\n7 0 1 1 0 0 1 0 0 0\n3 4 0 1 2 3\n3 3 2 1 0\n0 1\n";
    EXPECT_EQ(moved("a.ply", rich_ply + body), expected);
    EXPECT_EQ(all_notes(), "");
    EXPECT_EQ(moved("b.ply", replaced(rich_ply + body, "\n", "\r")), replaced(expected, "\n", "\r"));
}

TEST_F(Kept, ABinaryPlyComesBackByteForByte) {
    for (const bool big : {false, true}) {
        const auto file = [&](double z) {
            std::string bytes = replaced(rich_ply, "ascii", big ? "binary_big_endian" : "binary_little_endian");
            const auto put = [&](auto value) {
                auto raw = std::bit_cast<std::array<char, sizeof value>>(value);
                if (big) std::reverse(raw.begin(), raw.end());
                bytes.append(raw.data(), raw.size());
            };
            for (int i = 0; i < 4; ++i) {
                put(7.5F), put(float(i % 2)), put(double(i / 2) / 3), put(float(z));
                for (const float n : {0.0F, 0.0F, 1.0F}) put(n);
                for (const std::uint8_t c : {std::uint8_t(i), std::uint8_t(200), std::uint8_t(255)}) put(c);
            }
            put(std::uint8_t{9}), put(std::uint8_t{4});
            for (const std::int32_t v : {0, 1, 3, 2}) put(v);
            put(std::uint8_t{8}), put(std::uint8_t{2}); // an edge among the faces
            for (const std::int32_t v : {0, 1}) put(v);
            for (const std::int32_t v : {0, 3}) put(v);
            return bytes;
        };
        EXPECT_EQ(moved("a.ply", file(0)), file(1)) << big;
    }
}

TEST_F(Kept, AnOffAndAnStlComeBack) {
    const std::string off =
        "COFF # said\n4 2 0\n0 0 0 255 0 0 255\n1 0 0 0 0 0 255\n\n1  1 0 0 0 0 255\n0 1 0 0 0 0 255 # last\n"
        "4 0 1 2 3 200 0 0\n3 2 1 0 0 0 200\n";
    std::string expected = replaced(off, "0 0 0 255 0 0 255", "0 0 1 255 0 0 255");
    expected = replaced(replaced(expected, "1 0 0 0 0 0", "1 0 1 0 0 0"), "1  1 0 0 0", "1  1 1 0 0");
    expected = replaced(expected, "\n0 1 0 0 0 0 255 #", "\n0 1 1 0 0 0 255 #");
    EXPECT_EQ(moved("a.off", off), expected);

    const std::string stl = "Solid my  part\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n"
                            "   vertex 0 1 0\n  endloop\n endfacet\nendsolid my  part\n";
    expected = replaced(replaced(stl, "vertex 0 0 0", "vertex 0 0 1"), "vertex 1 0 0", "vertex 1 0 1");
    EXPECT_EQ(moved("a.stl", stl), replaced(expected, "vertex 0 1 0", "vertex 0 1 1"));

    std::string binary(80, 'h');
    const auto facet = [&](float z) {
        std::string bytes = binary;
        const std::uint32_t count = 1;
        const float values[12] = {0, 0, 1, 0, 0, z, 1, 0, z, 0, 1, z};
        bytes.append(reinterpret_cast<const char*>(&count), 4);
        bytes.append(reinterpret_cast<const char*>(values), sizeof values);
        return bytes + "\3" + std::string(1, '\0') + "abc";
    };
    EXPECT_EQ(moved("b.stl", facet(0)), facet(1));
}

TEST_F(Kept, AnotherFormatGetsWhatItCanHoldAndTheRestIsTold) {
    scratch.file("box.mtl", "newmtl blue\nKd 0 0 1\n");
    const Mesh mesh = read_mesh(scratch.file("a.obj", box));
    const auto note = [&](const char* name) {
        const auto notes = write_mesh(mesh, scratch.path(name));
        return notes.empty() ? std::string() : notes.back();
    };
    EXPECT_NE(
        note("a.stl").find("left behind texture coordinates, vertex colours, 1 polygon of more than three corners, "
                           "1 object, 2 groups, 2 smoothing groups, 2 materials and"),
        std::string::npos)
        << note("a.stl");
    EXPECT_NE(note("a.stl").find("write .obj to keep them"), std::string::npos);
    EXPECT_EQ(note("a.ply").find("polygon of more"), std::string::npos) << note("a.ply");
    EXPECT_EQ(read_mesh(scratch.path("a.ply")).file->ends, mesh.file->ends);
    EXPECT_EQ(read_mesh(scratch.path("a.ply")).positions, mesh.positions);
    note("a.off");
    EXPECT_EQ(read_mesh(scratch.path("a.off")).file->corners, mesh.file->corners);
    EXPECT_TRUE(write_mesh(unit_cube(), scratch.path("c.stl")).empty()) << "nobody had anything";
}

TEST_F(Kept, ARecolouredObjKeepsItsDescription) {
    Mesh mesh = read_mesh(scratch.file("a.obj", box));
    mesh.colors = Colors::Constant(mesh.positions.rows(), 4, 1);
    write_mesh(mesh, scratch.path("b.obj"));
    const Mesh again = read_mesh(scratch.path("b.obj"));
    EXPECT_EQ(again.colors, mesh.colors);
    EXPECT_EQ(again.file->corners, mesh.file->corners);
    EXPECT_EQ(again.file->groups.names, mesh.file->groups.names);
    EXPECT_EQ(again.file->groups.of, mesh.file->groups.of);
    EXPECT_EQ(again.file->polygon_materials, mesh.file->polygon_materials);
    EXPECT_EQ(again.file->normal_corners, mesh.file->normal_corners);
    EXPECT_EQ(again.texcoord_triangles, mesh.texcoord_triangles);
}

TEST_F(Kept, MaterialsOfAnotherFormatGetALibraryBesideTheObj) {
    const std::string ply = replaced(replaced(rich_ply, "property float quality\n", ""), "property uchar flags\n", "");
    const std::string body = "0 0 0 0 0 1 255 0 0\n1 0 0 0 0 1 255 0 0\n1 1 0 0 0 1 255 0 0\n0 1 0 0 0 1 255 0 0\n"
                             "4 0 1 2 3\n3 2 1 0\n0 1\n";
    scratch.file("skin.png", "picture");
    std::filesystem::create_directories(scratch.path("out"));
    const Mesh mesh = read_mesh(scratch.file("a.ply", ply + body));
    write_mesh(mesh, scratch.path("out/a.obj"));
    EXPECT_EQ(read_whole(scratch.path("out/skin.png")), "picture");
    const Mesh again = read_mesh(scratch.path("out/a.obj"));
    ASSERT_EQ(again.file->images.size(), 1U);
    EXPECT_EQ(again.file->images[0].path, scratch.path("out/skin.png"));
    EXPECT_EQ(again.file->polygon_materials, mesh.file->polygon_materials);
    EXPECT_EQ(again.file->normals, mesh.file->normals);
    scratch.file("out/a.mtl", "by hand");
    write_mesh(mesh, scratch.path("out/a.obj"));
    EXPECT_EQ(read_whole(scratch.path("out/a.mtl")), "by hand");
    EXPECT_EQ(read_mesh(scratch.path("out/a.obj")).file->material_libraries.front(), "a_2.mtl");
}

TEST_F(Kept, PolygonsAreCutAlikeBesideTheirOwnTriangles) {
    const std::string arrow = "v 0 0 0\nv 1 .5 0\nv 2 0 0\nv 1 2 0\nv 1 3 1\n";
    const auto quads = scratch.file("quads.obj", arrow + "f 1 2 3 4\nf 3 5 4\n");
    const Mesh mesh = read_mesh(quads);
    Mesh triangles = mesh;
    triangles.file = nullptr;
    triangles.positions.row(0) << 0, 5, 0; // in this pose the quad would be cut otherwise
    write_mesh(triangles, scratch.path("triangles.ply"));
    for (const bool first : {false, true}) {
        const auto a = first ? quads : scratch.path("triangles.ply"), b = first ? scratch.path("triangles.ply") : quads;
        const auto both = read_meshes({a, b});
        EXPECT_EQ(both[0].triangles, both[1].triangles) << first;
        EXPECT_EQ(both[1].triangles, mesh.triangles) << first;
    }
    const auto other = scratch.file("other.obj", arrow + "f 1 2 3 5\nf 3 5 4\n");
    EXPECT_NE(read_meshes({quads, other})[1].triangles, mesh.triangles);
}

} // namespace
} // namespace meshtween
