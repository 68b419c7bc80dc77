// Files as programs write them, beside what their formats allow: what does not touch the shape is passed over and told.
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/mesh_io.h"

#include "support/scratch.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace meshtween {
namespace {

using namespace std::string_literals;

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
        text.replace(at, what.size(), by);
    return text;
}

std::string before(std::string text, const std::string& what, const std::string& put) {
    return text.insert(text.find(what), put);
}

const std::string obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 3 2 1\n";
const std::string ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
                        "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
                        "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 2 1 0\n";
const std::string off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 2 1 0\n";
const std::string stl_facets = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\n"
                               "endfacet\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\nvertex 0 1 0\n"
                               "endloop\nendfacet\nfacet normal 0 0 1\nouter loop\nvertex 1 1 0\nvertex 1 0 0\n"
                               "vertex 0 0 0\nendloop\nendfacet\n";
const std::string stl = "solid x\n" + stl_facets + "endsolid x\n";

// 80 bytes, `count`, three facets with `payload` bytes behind each.
std::string binary_stl(std::uint32_t count, std::uint16_t payload = 0) {
    std::string bytes(80, ' ');
    bytes.append(std::bit_cast<std::array<char, 4>>(count).data(), 4);
    const float facets[3][12] = {{0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0},
                                 {0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1, 0},
                                 {0, 0, 1, 1, 1, 0, 1, 0, 0, 0, 0, 0}};
    for (const auto& facet : facets) {
        bytes.append(reinterpret_cast<const char*>(facet), sizeof facet);
        bytes.append(std::bit_cast<std::array<char, 2>>(payload).data(), 2);
        bytes.append(payload, '\7');
    }
    return bytes;
}

std::string big_endian_ply() {
    std::string bytes = replaced(ply.substr(0, ply.find("0 0 0")), "ascii", "binary_big_endian");
    const auto put = [&](auto value) {
        auto raw = std::bit_cast<std::array<char, sizeof value>>(value);
        bytes.append(raw.rbegin(), raw.rend());
    };
    for (const float value : {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) put(value);
    put(std::uint8_t{4});
    for (const std::int32_t index : {0, 1, 2, 3}) put(index);
    put(std::uint8_t{3});
    for (const std::int32_t index : {2, 1, 0}) put(index);
    return bytes;
}

// All are the square 0..1 with one triangle of it seen from behind: four vertices, three triangles.
TEST(OddFiles, AreReadAndTellWhatWasPassedOver) {
    const struct {
        const char* name;
        std::string contents;
        const char* note; // in the notes; empty: there is none
    } rows[] = {
        // a backslash joins lines of numbers only
        {"comment.obj", "# C:\\models\\\n" + obj, ""},
        {"usemtl.obj", before(obj, "f 3", "usemtl red\\\n"), ""},
        {"group.obj", before(obj, "f 1", "g a\\\n"), ""},
        {"object.obj", "o a\\\n" + obj, ""},
        {"library.obj", "mtllib c:\\none.mtl\\\n" + obj, "no material library c:\\none.mtl"},
        {"joined.obj", replaced(obj, "2 3 4", "2\\\n3 \\ \r\n 4"), ""},
        {"joined_v.obj", replaced(obj, "v 1 1 0", "v 1\\\n1 0"), ""},
        {"joined_to_none.obj", replaced(obj, "1 0\n", "1 0 \\\n"), ""},
        // ends of lines, comments
        {"cr.obj", replaced(obj, "\n", "\r"), ""},
        {"crlf.obj", replaced(obj, "\n", "\r\n"), ""},
        {"mixed.obj", replaced(obj, "0\n", "0\r"), ""},
        {"behind.obj", replaced(obj, "\n", " # said\n"), ""},
        {"glued_comment.obj", replaced(obj, "\n", "#\\\n"), ""},
        // what is named and not there
        {"vt.obj", replaced(obj, "f 1 2 3 4", "f 1/1 2/2 3/3 4/4"), "4 corners name texture coordinates"},
        {"vt_far.obj", "vt 0 0\n" + replaced(obj, "f 1 2 3 4", "f 1/1 2/1 3/9 4/-7"), "2 corners name texture"},
        {"vt_word.obj", "vt 0 0\n" + replaced(obj, "f 1 2 3 4", "f 1/a 2/1 3/1 4/1"), "1 corner names texture"},
        {"vn.obj", replaced(obj, "f 1 2 3 4", "f 1//1 2//2 3//3 4//4"), "4 corners name normals"},
        {"color.obj", replaced(obj, "v 1 0 0", "v 1 0 0 nan 0 1"), "1 colour holds no numbers, first in line 2"},
        {"color_word.obj", replaced(obj, "v 1 0 0", "v 1 0 0 -1.#IND x 1"), "1 colour holds no numbers"},
        {"weight.obj", replaced(obj, "v 1 0 0", "v 1 0 0 w"), ""},
        {"two.obj", obj + "f 1 2", "1 face has fewer than three corners, first in line 7"},
        {"none.obj", "f\nf 1\n" + obj, "2 faces have fewer than three corners, first in line 1"},
        // PLY
        {"cr.ply", replaced(ply, "\n", "\r"), ""},
        {"crlf.ply", replaced(ply, "\n", "\r\n"), ""},
        {"surplus.ply", replaced(ply, "4 0 1 2 3", "4 0 1 2 3 8 0 0 1 0 1 1 0 1"), ""},
        {"surplus_v.ply", replaced(replaced(ply, "0 0\n", "0 0 7\n"), "1 0\n", "1 0 7 8\n"), ""},
        {"stream.ply", replaced(ply, "1 0 0\n1 1 0\n", "1 0 0 1 1 0 "), ""},
        {"more.ply", ply + "3 0 1 2\n", "1 line behind what the header promises"},
        {"two.ply", replaced(replaced(ply, "face 2", "face 3"), "4 0", "2 0 1\n4 0"),
         "1 face has fewer than three corners, first face 0"},
        {"qnan.ply", replaced(replaced(ply, "float z\n", "float z\nproperty float quality\n"), " 0\n", " 0 1.#QNAN\n"),
         ""},
        {"odd_uv.ply",
         replaced(replaced(replaced(ply, "float z\n", "float z\nproperty float s\nproperty float t\n"), " 0\n",
                           " 0 -1.#IND nan(ind)\n"),
                  "2 1 0 -1.#IND nan(ind)", "2 1 0"),
         ""},
        {"big.ply", big_endian_ply(), ""},
        {"big_cr.ply",
         replaced(big_endian_ply().substr(0, ply.find("0 0 0") + 12), "\n", "\r") +
             big_endian_ply().substr(ply.find("0 0 0") + 12),
         ""},
        {"bytes.ply", big_endian_ply() + "more", "4 bytes behind"},
        // STL
        {"upper.stl", replaced(stl, "solid", "SOLID"), ""},
        {"title.stl", replaced(replaced(stl, "solid", "Solid"), "vertex", "Vertex"), ""},
        {"words.stl", replaced(replaced(replaced(stl, "endl", "end l"), "endf", "end f"), "ends", "end s"), ""},
        {"cr.stl", replaced(stl, "\n", "\r"), ""},
        {"right.stl", binary_stl(3), ""},
        {"small.stl", binary_stl(1), "the header promises 1 facet, but the file holds 3"},
        {"large.stl", binary_stl(5), "the header promises 5 facets, but the file holds 3"},
        {"zero.stl", binary_stl(0), "the header promises 0 facets, but the file holds 3"},
        {"unknown.stl", binary_stl(0xffffffff), "the header promises 4294967295 facets, but the file holds 3"},
        {"payload.stl", binary_stl(3, 4), ""},
        {"payload_long.stl", binary_stl(3, 300), ""},
        {"solid.stl", replaced(binary_stl(3), std::string(80, ' '), "solid" + std::string(75, ' ')), ""},
        {"rest.stl", binary_stl(3) + "\r\n", "2 bytes behind the last facet"},
        // OFF
        {"glued.off", replaced(off, "OFF\n4", "OFF4"), ""},
        {"lower.off", replaced(off, "OFF", "off"), ""},
        {"cr.off", replaced(off, "\n", "\r"), ""},
        {"wrapped.off", replaced(replaced(off, "0 0 0\n1", "0 0 0 1"), "0\n1 1 0\n0 1 0", "0 1 1 0 0 1 0"), ""},
        {"stream.off", replaced(off, "\n", " "), ""},
        {"words.off", replaced(off, " ", "\n"), ""},
        {"no_edges.off", replaced(off, "2 0\n0", "2\n0"), ""},
        {"two.off", replaced(replaced(off, "4 2 0", "4 3 0"), "4 0", "2 0 1\n4 0"), "1 face has fewer"},
        {"more.off", off + "3 0 1 2\n", "1 line behind what the header promises"},
        {"colored.off", replaced(off, "3 2 1 0", "3 2 1 0 255 0 0"), ""},
    };
    Scratch scratch;
    for (const auto& row : rows) {
        Mesh mesh;
        try {
            mesh = read_mesh(scratch.file(row.name, row.contents));
        } catch (const std::exception& error) {
            ADD_FAILURE() << row.name << ": " << error.what();
            continue;
        }
        EXPECT_EQ(mesh.positions.rows(), 4) << row.name;
        ASSERT_EQ(mesh.triangles.rows(), 3) << row.name;
        EXPECT_EQ(mesh.positions.colwise().sum(), Point(2, 2, 0)) << row.name;
        EXPECT_EQ(mesh.triangles.row(2), Eigen::RowVector3i(2, 1, 0)) << row.name;
        std::string notes;
        for (const std::string& note : mesh.file->notes) notes += note + "\n";
        if (*row.note == '\0')
            EXPECT_EQ(notes, "") << row.name;
        else
            EXPECT_NE(notes.find(row.note), std::string::npos) << row.name << " says " << notes;
    }
}

// A header of carriage returns, and data that begin with a newline's byte.
TEST(OddFiles, BinaryDataMayBeginWithANewline) {
    std::string bytes = replaced(big_endian_ply(), "big", "little");
    const std::size_t begin = ply.find("0 0 0") + 15; // behind "binary_little_endian" for "ascii"
    std::string data;
    const float positions[] = {std::bit_cast<float>(std::uint32_t{0x3f00000a}), 0, 0, 1, 0, 0, 0, 1, 0};
    data.append(reinterpret_cast<const char*>(positions), sizeof positions);
    const std::int32_t face[] = {0, 1, 2};
    data += '\3';
    data.append(reinterpret_cast<const char*>(face), sizeof face);
    const std::string header =
        replaced(replaced(replaced(bytes.substr(0, begin), "vertex 4", "vertex 3"), "face 2", "face 1"), "\n", "\r");
    const Mesh mesh = read_mesh(Scratch().file("a.ply", header + data));
    EXPECT_EQ(mesh.positions(0, 0), positions[0]);
    EXPECT_EQ(mesh.triangles.row(0), Eigen::RowVector3i(0, 1, 2));
}

TEST(OddFiles, WideColoursThatReach255AreBytes) {
    Scratch scratch;
    const auto color = [&](const std::string& first) {
        std::string text = replaced(ply, "float z\n",
                                    "float z\nproperty ushort red\nproperty ushort green\n"
                                    "property ushort blue\n");
        text = replaced(text, "0 0 0\n1 0 0\n1 1 0\n0 1 0\n",
                        "0 0 0 " + first + "\n1 0 0 0 0 0\n1 1 0 0 0 0\n0 1 0 0 0 0\n");
        return Eigen::RowVector4f(read_mesh(scratch.file("a.ply", text)).colors.row(0));
    };
    EXPECT_EQ(color("51 255 0"), Eigen::RowVector4f(0.2F, 1, 0, 1));
    EXPECT_EQ(color("13107 65535 0"), Eigen::RowVector4f(0.2F, 1, 0, 1));
}

TEST(OddFiles, StripsAreTrianglesThatFaceOneWay) {
    const std::string strips = "ply\nformat ascii 1.0\nelement vertex 5\nproperty float x\nproperty float y\n"
                               "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
                               "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n";
    Scratch scratch;
    const Mesh plain = read_mesh(scratch.file("a.ply", strips + "5 0 1 2 3 4\n"));
    ASSERT_EQ(plain.triangles.rows(), 3);
    EXPECT_EQ(plain.triangles.row(1), Eigen::RowVector3i(2, 1, 3));
    EXPECT_EQ(plain.triangles.row(2), Eigen::RowVector3i(2, 3, 4));
    const Mesh parts = read_mesh(scratch.file("b.ply", strips + "9 0 1 2 -1 1 3 2 2 4\n"));
    ASSERT_EQ(parts.triangles.rows(), 2) << "the corner named twice only leads on";
    EXPECT_EQ(parts.triangles.row(1), Eigen::RowVector3i(1, 3, 2));
}

} // namespace
} // namespace meshtween
