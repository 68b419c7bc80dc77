// Files that cannot be meshes: each gets a message with its name and the place of the fault, none a crash.
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include "support/errors.h"
#include "support/scratch.h"
#include "support/shapes.h"

#include <cstdint>
#include <cstring>
#include <random>

namespace meshtween {
namespace {

using namespace std::string_literals;

constexpr const char* ply_ascii =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";

std::string with(std::string text, const std::string& what, const std::string& by) {
    return text.replace(text.find(what), what.size(), by);
}

std::string ply_binary(std::initializer_list<float> positions, std::initializer_list<std::int32_t> face) {
    std::string bytes = with(ply_ascii, "ascii", "binary_little_endian");
    for (const float value : positions) bytes.append(reinterpret_cast<const char*>(&value), 4);
    bytes += static_cast<char>(face.size());
    for (const std::int32_t value : face) bytes.append(reinterpret_cast<const char*>(&value), 4);
    return bytes;
}

constexpr const char* vtk_ascii = "# vtk DataFile Version 4.2\nx\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n"
                                  "0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n";
constexpr const char* vtp_ascii =
    "<VTKFile type=\"PolyData\" version=\"0.1\">\n<PolyData><Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points>"
    "<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 "
    "0</DataArray></Points><Polys>"
    "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>"
    "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys></Piece></PolyData></VTKFile>";

std::string vtk_binary() {
    std::string bytes = "# vtk DataFile Version 4.2\nx\nBINARY\nDATASET POLYDATA\nPOINTS 3 float\n";
    bytes += "\0\0\0\0\0\0\0\0\0\0\0\0"s + "\x3f\x80\0\0\0\0\0\0\0\0\0\0"s + "\0\0\0\0\x3f\x80\0\0\0\0\0\0"s;
    return bytes + "\nPOLYGONS 1 4\n" + "\0\0\0\3\0\0\0\0\0\0\0\1\0\0\0\2"s;
}

// The points in base64 with this header and compression.
std::string vtp_encoded(const std::string& letters, const char* attributes = "") {
    return with(
        with(with(vtp_ascii, "format=\"ascii\">0 0 0", "format=\"binary\">0 0 0"), "0 0 0 1 0 0 0 1 0", letters),
        "version=\"0.1\"", "version=\"0.1\" "s + attributes);
}

// Pieces whose points are the same bytes behind the XML.
std::string vtp_of_one_place(int pieces) {
    const std::string whole = vtp_ascii, text = "format=\"ascii\">0 0 0 1 0 0 0 1 0<";
    const std::size_t begin = whole.find("<Piece"), end = whole.find("</PolyData>");
    std::string bytes = whole.substr(0, begin);
    for (int i = 0; i < pieces; ++i)
        bytes += with(whole.substr(begin, end - begin), text, "format=\"appended\" offset=\"0\"><");
    bytes += "</PolyData><AppendedData encoding=\"raw\">_$\0\0\0"s;
    for (const float value : {0, 0, 0, 1, 0, 0, 0, 1, 0}) bytes.append(reinterpret_cast<const char*>(&value), 4);
    return bytes + "</AppendedData></VTKFile>";
}

std::string stl_binary(std::uint32_t count, std::initializer_list<float> values) {
    std::string bytes(80, ' ');
    bytes.append(reinterpret_cast<const char*>(&count), 4);
    for (const float value : values) bytes.append(reinterpret_cast<const char*>(&value), 4);
    return bytes + "\0\0"s;
}

class BadFiles : public testing::Test {
protected:
    Scratch scratch;
};

TEST_F(BadFiles, EachIsToldWithItsPlace) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::string garbage = "\x8f\x02\x13\xff\xfe\x00\x11\x90\x7f\x45\x4c\x46\x0a\x02\x00\x00\x99"s;
    const struct {
        const char* name;
        std::string contents;
        const char* words;
    } rows[] = {
        // empty, garbage, another format
        {"a.obj", "", "the file is empty"},
        {"a.ply", "", "the file is empty"},
        {"a.stl", "", "the file is empty"},
        {"a.off", "", "the file is empty"},
        {"a.glb", "", "the file is empty"},
        {"a.obj", garbage, "line 1"},
        {"a.ply", garbage, "line 1: a PLY file begins with 'ply'"},
        {"a.stl", garbage, "too short for an STL file"},
        {"a.stl", garbage + std::string(200, '\x7f'), "promises 2139062143 facets"},
        {"a.off", garbage, "line 1: an OFF file begins with 'OFF'"},
        {"a.glb", garbage, "JSON"},
        {"a.obj", ply_ascii, "holds no vertices"},
        {"a.ply", "v 0 0 0\n", "begins with 'ply'"},
        {"a.obj", "just some words\n", "holds no vertices"},
        {"a.off", "4OFF\n1 1 1\n", "three dimensions"},
        {"a.off", "OFF BINARY\n\1\2\3", "binary OFF is not read"},
        // no faces, no vertices
        {"a.obj", "v 0 0 0\nv 1 0 0\n", "holds 2 vertices but no faces"},
        {"a.off", "OFF\n1 0 0\n0 0 0\n", "holds 1 vertices but no faces"},
        {"a.off", "OFF\n0 0 0\n", "holds no vertices"},
        {"a.ply", with(with(ply_ascii, "face 1", "face 0"), "vertex 3", "vertex 1") + "0 0 0\n", "no faces"},
        {"a.stl", "solid x\nendsolid x\n", "holds no vertices"},
        {"a.stl", std::string(84, '\0'), "holds no vertices"},
        {"a.ply",
         with(ply_ascii, "element face 1\nproperty list uchar int vertex_indices", "element face 0") +
             "0 0 0 1 0 0 0 1 0",
         "no list 'vertex_indices'"},
        {"a.ply", with(ply_ascii, "element face", "element tristrips") + "0 0 0 1 0 0 0 1 0\n3 0 1 7",
         "names vertex 7"},
        {"a.ply", with(ply_ascii, "element face", "element tristrips") + "0 0 0 1 0 0 0 1 0\n3 0 1 -2",
         "-2 is no vertex's number"},
        // truncated
        {"a.obj", "v 0 0 0\nv 1 0", "line 2: z is missing"},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2", "holds 3 vertices but no faces"},
        {"a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "the header has no end"},
        {"a.ply", ply_ascii + "0 0 0 1 0 0 0 1 0 3 0"s, "the file ends too early"},
        {"a.ply", ply_binary({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}).substr(0, 200), "bytes, but only"},
        {"a.ply", ply_ascii + "0 0 0 1 0 0 0 1"s, "bytes, but only"},
        {"a.ply", with(ply_binary({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}), "face 1", "face 2"),
         "the file ends too early"},
        {"a.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0", "line 5: z is missing"},
        {"a.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n", "'endsolid' is missing"},
        {"a.stl", "solid x\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\nendfacet\nendsolid",
         "has 2 corners"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", "ends before vertex 2 of 3"},
        {"a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "ends before face 1 of 2"},
        {"a.off", "OFF\n", "the file ends too early"},
        // counts that cannot be
        {"a.ply", with(ply_ascii, "vertex 3", "vertex 1000000000") + "0 0 0\n",
         "promises 1000000000 elements 'vertex'"},
        {"a.ply", with(ply_binary({0, 0, 0}, {}), "vertex 3", "vertex 2000000000"), "2000000000"},
        {"a.ply", with(ply_ascii, "vertex 3", "vertex 99999999999999999999") + "0", "should be a number"},
        {"a.ply", with(ply_ascii, "vertex 3", "vertex 9999999999") + "0", "more than can be held"},
        {"a.ply", with(ply_ascii, "face 1", "face -1") + "0", "line 7: -1 elements 'face'"},
        {"a.off", "OFF\n1000000000 1 0\n0 0 0\n", "1000000000 vertices do not fit"},
        {"a.off", "OFF\n3 1000000000 0\n0 0 0\n", "1000000000 faces do not fit"},
        {"a.off", "OFF\n-3 1 0\n0 0 0\n", "-3 vertices"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n1000000000 0 1 2\n", "line 6: a vertex's number is missing"},
        {"a.stl", stl_binary(3, {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) + std::string(60, '\1'), "promises 3 facets"},
        {"a.stl", stl_binary(1, {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) + std::string(60, '\1'), "promises 1 facets"},
        {"a.stl", std::string(80, ' ') + "\4\0\0\0"s + std::string(216, '\1'), "promises 4 facets"},
        {"a.stl", stl_binary(0, {0, 0, 1}), "promises 0 facets"},
        {"a.stl", stl_binary(0xffffffff, {0, 0, 1}), "promises 4294967295 facets"},
        {"a.ply", with(ply_ascii, "list uchar", "list uint") + "0 0 0 1 0 0 0 1 0\n4294967295 0 1 2\n",
         "a list cannot have 4294967295 entries"},
        {"a.ply", with(ply_ascii, "list uchar", "list char") + "0 0 0 1 0 0 0 1 0\n-1 0 1 2\n",
         "line 11: a list cannot have -1 entries"},
        // numbers that are none
        {"a.obj", "v 0 0 0\nv 1 nan 0\n", "line 2: y is nan"},
        {"a.obj", "v 0 0 0\nv 1 0 -inf\n", "line 2: z is -inf"},
        {"a.obj", "v 0 0 0\nv 1e999 0 0\n", "line 2: x is 1e999"},
        {"a.obj", "v 0 0 0\nv 1,5 0 0\n", "line 2: x should be a number, not '1,5'"},
        {"a.ply", ply_ascii + "0 0 0 1 nan 0 0 1 0\n3 0 1 2"s, "line 10: y is nan"},
        {"a.ply", ply_ascii + "0 0 0 1 zero 0 0 1 0\n3 0 1 2"s, "line 10: 'zero' should be a number"},
        {"a.ply", ply_binary({0, 0, 0, 1, 0, nan, 0, 1, 0}, {0, 1, 2}),
         "element 'vertex' 1 (counted from 0): z is nan"},
        {"a.stl", stl_binary(1, {0, 0, 1, 0, 0, 0, 1, nan, 0, 0, 1, 0}),
         "facet 0 (counted from 0): a coordinate is nan"},
        {"a.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 inf\n", "line 4: z is inf"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", "line 4: y is nan"},
        // indices
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", "line 4: vertex 4 is out of range: the file holds 3"},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 0\n", "line 4: vertex 0 does not exist: OBJ counts from 1"},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n", "line 4: vertex -4 is out of range"},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99999999999\n", "line 4: vertex 99999999999 is out of range"},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3.5\n", "line 4: vertex should be a number, not '3.5'"},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\n2 4\n", "line 5: vertex 4 is out of range"},
        {"a.ply", ply_ascii + "0 0 0 1 0 0 0 1 0\n3 0 1 3"s, "face 0 (counted from 0) names vertex 3, but there are 3"},
        {"a.ply", ply_ascii + "0 0 0 1 0 0 0 1 0\n3 0 1 -1"s, "-1 is no vertex's number"},
        {"a.ply", ply_ascii + "0 0 0\n1 0 0\n0 1 0\n2 0 1"s, "holds 3 vertices but no faces"},
        {"a.ply", ply_ascii + "0 0 0 1 0 0 0 1 0\n3 0 1 2 2"s, "more words follow"},
        {"a.ply", ply_binary({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 7}), "names vertex 7"},
        {"a.ply", ply_binary({0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, -7}), "-7 is no vertex's number"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "line 6: vertex 3 is out of range"},
        {"a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -3\n", "line 6: vertex -3 is out of range"},
        // headers
        {"a.ply", with(ply_ascii, "ascii", "text"), "line 2: 'text' is no PLY format"},
        {"a.ply", with(ply_ascii, "float x", "real x"), "line 4: 'real' is no PLY type"},
        {"a.ply", with(ply_ascii, "list uchar", "list float"), "whole-number type"},
        {"a.ply", with(ply_ascii, "format ascii 1.0\n", ""), "names no format"},
        {"a.ply", with(ply_ascii, "element face", "element vertex"), "comes twice"},
        {"a.ply", with(ply_ascii, "element vertex 3\n", ""), "before any element"},
        {"a.ply", with(ply_ascii, "float z", "float w") + "0 0 0 1 0 0 0 1 0\n3 0 1 2", "have no x, y and z"},
        {"a.ply", with(ply_ascii, "element face", "elephant face"), "'elephant' is no PLY header line"},
        // VTK, the older format
        {"a.vtk", "", "the file is empty"},
        {"a.vtk", garbage, "begins with '# vtk DataFile Version'"},
        {"a.vtk", "# vtk DataFile Version 3.0\nx\n", "should be ASCII or BINARY"},
        {"a.vtk", "# vtk DataFile Version 3.0\nx\nASCII\n", "holds no vertices"},
        {"a.vtk", with(vtk_ascii, "POLYDATA", "STRUCTURED_GRID"), "kind STRUCTURED_GRID, which is not a surface"},
        {"a.vtk", with(vtk_ascii, "POLYGONS", "ELEPHANTS"), "line 7: 'ELEPHANTS' is no section"},
        {"a.vtk", with(vtk_ascii, "POINTS 3 float", "POINTS 3 real"), "'real' is no type of numbers"},
        {"a.vtk", with(vtk_ascii, "POINTS 3", "POINTS three"), "line 5: the number of points should be a count"},
        {"a.vtk", with(vtk_ascii, "POINTS 3", "POINTS 1000000000"), "3 times 1000000000 numbers"},
        {"a.vtk", with(vtk_ascii, "1 0 0", "1 nan 0"), "point 1 (counted from 0): y is no finite number"},
        {"a.vtk", with(vtk_ascii, "1 0 0", "1 zero 0"), "line 6: 'zero' should be one of the 9 numbers"},
        {"a.vtk", with(vtk_ascii, "POLYGONS 1 4\n3 0 1 2\n", ""), "no faces"},
        {"a.vtk", with(vtk_ascii, "3 0 1 2\n", "3 0 1      "), "the file ends after 3 of the 4 numbers"},
        {"a.vtk", with(vtk_ascii, "3 0 1 2", "3 0 1 3"), "names vertex 3, but there are 3"},
        {"a.vtk", with(vtk_ascii, "3 0 1 2", "3 0 1 -2"), "-2 is no vertex's number"},
        {"a.vtk", with(vtk_ascii, "3 0 1 2", "9 0 1 2"), "cell 0 (counted from 0) does not fit"},
        {"a.vtk", with(vtk_ascii, "POLYGONS 1 4\n3", "POLYGONS 1 5\n3 0"), "1 cells in 5 numbers, but they take 4"},
        {"a.vtk", with(vtk_ascii, "POLYGONS 1", "POLYGONS 2"), "promises 2 cells in 4 numbers"},
        {"a.vtk", with(vtk_ascii, "POLYGONS 1 4", "POLYGONS 1 9999999999"), "promises 9999999999 numbers"},
        {"a.vtk",
         with(vtk_ascii, "POLYGONS 1 4\n3 0 1 2",
              "POLYGONS 2 3\nOFFSETS vtktypeint64\n0 4\nCONNECTIVITY "
              "vtktypeint64\n0 1 2"),
         "the offsets of POLYGONS do not rise from 0 to 3"},
        {"a.vtk", with(vtk_ascii, "POLYGONS 1 4\n3 0 1 2", "POLYGONS 2 3\nOFFSETS vtktypeint64\n0 3\n0 1 2"),
         "CONNECTIVITY is missing"},
        {"a.vtk", with(with(vtk_ascii, "POLYDATA", "UNSTRUCTURED_GRID"), "POLYGONS", "CELLS"),
         "1 cells, but 0 cell types"},
        {"a.vtk", with(with(vtk_ascii, "POLYDATA", "UNSTRUCTURED_GRID"), "POLYGONS", "CELLS") + "CELL_TYPES 1\n12\n",
         "holds hexahedra, not a surface"},
        {"a.vtk", vtk_binary().substr(0, 100), "the header promises 9 numbers"},
        {"a.vtk", vtk_binary().substr(0, vtk_binary().size() - 1), "the header promises 4 numbers"},
        {"a.vtk", with(vtk_binary(), "POINTS 3", "POINTS 2000000000"), "2000000000"},
        // VTK, the newer format
        {"a.vtp", "", "the file is empty"},
        {"a.vtp", garbage, "holds no <VTKFile>"},
        {"a.vtp", ply_ascii, "holds no <VTKFile>"},
        {"a.vtp", std::string(vtp_ascii).substr(0, 150), "line 2: "},
        {"a.vtp", with(vtp_ascii, "PolyData", "UnstructuredGrid"), "the kind UnstructuredGrid, not PolyData"},
        {"a.vtp", "<VTKFile type=\"PolyData\"><PolyData/></VTKFile>", "holds no vertices"},
        {"a.vtp", with(vtp_ascii, "NumberOfPoints=\"3\"", "NumberOfPoints=\"1000000000\""),
         "holds 9 numbers, but 3000000000 are promised"},
        {"a.vtp", with(vtp_ascii, "NumberOfPolys=\"1\"", "NumberOfPolys=\"2\""), "holds 1 numbers, but 2 are promised"},
        {"a.vtp", with(vtp_ascii, "NumberOfPolys=\"1\"", ""), "no faces"},
        {"a.vtp", with(vtp_ascii, "\"connectivity\"", "\"corners\""), "have no connectivity and offsets"},
        {"a.vtp", with(vtp_ascii, ">0 1 2<", ">0 1 3<"), "names vertex 3, but there are 3"},
        {"a.vtp", with(vtp_ascii, ">0 1 2<", ">0 1 x<"), "'x' should be a number"},
        {"a.vtp", with(vtp_ascii, ">3<", ">4<"), "offset 0 (counted from 0) of the polygons is 4"},
        {"a.vtp", with(vtp_ascii, ">3<", ">2<"), "take 2 corners, but there are 3"},
        {"a.vtp", with(vtp_ascii, "1 0 0", "1 nan 0"), "coordinate y of vertex 1"},
        {"a.vtp", with(vtp_ascii, "\"ascii\"", "\"hieroglyphs\""), "'hieroglyphs' should be ascii, binary or appended"},
        {"a.vtp", with(vtp_ascii, "\"ascii\"", "\"appended\" offset=\"7\""), "begins at byte 7 of the appended data"},
        {"a.vtp", vtp_encoded("JAAAAAAA"), "its header promises 36 bytes"},
        {"a.vtp", vtp_encoded("!!!!AAAA"), "letters that are not base64"},
        {"a.vtp", vtp_encoded("AAAAAA=="), "holds 0 numbers, but 9 are promised"},
        {"a.vtp", vtp_encoded("AQAAAACAAAAkAAAACQAAAA==AAAAAAAAAAAA", "compressor=\"vtkZLibDataCompressor\""),
         "compressed block 0 of 1 is damaged"},
        {"a.vtp", vtp_encoded("AQAAAP///38AAAAACQAAAA==AAAAAAAAAAAA", "compressor=\"vtkZLibDataCompressor\""),
         "promise more than they can hold"},
        {"a.vtp",
         vtp_encoded("AQAAAACAAAAAAAAAKAAAAA==AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA==", // which is not
                                                                                                         // inflated
                     "compressor=\"vtkZLibDataCompressor\""),
         "the points: holds 8192 numbers, but 9 are promised"},
        {"a.vtp",
         with(with(with(vtp_ascii, "ascii\">0 1 2", "binary\">0 1 2"), "0 1 2<",
                   "AQAAAACAAAAAAAAAKAAAAA==AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA==<"),
              "version=\"0.1\"", "compressor=\"vtkZLibDataCompressor\""),
         "the corners of the polygons: holds 8192 numbers, but 3 are promised"},
        {"a.vtp", vtp_of_one_place(3), "the arrays of the appended data lie over one another"},
        {"a.vtp", vtp_encoded("////fwCAAAAkAAAACQAAAA==", "compressor=\"vtkZLibDataCompressor\""),
         "promises 2147483647 compressed blocks"},
        {"a.vtp", vtp_encoded("AAAA", "compressor=\"vtkLZ4DataCompressor\""), "compressed with vtkLZ4DataCompressor"},
    };
    for (const auto& row : rows) {
        const auto path = scratch.file(row.name, row.contents);
        const std::string message = message_of(ErrorKind::file, [&] { read_mesh(path); });
        EXPECT_NE(message.find(row.words), std::string::npos)
            << row.name << " should say: " << row.words << "\nsays: " << message;
        EXPECT_NE(message.find(path.string()), std::string::npos) << message;
    }
}

TEST_F(BadFiles, NoFileAFolderAnUnknownFormat) {
    EXPECT_NE(message_of(ErrorKind::file, [&] { read_mesh(scratch.path("none.obj")); }).find("no such file"),
              std::string::npos);
    std::filesystem::create_directory(scratch.path("folder.obj"));
    EXPECT_NE(message_of(ErrorKind::file, [&] { read_mesh(scratch.path("folder.obj")); }).find("is a folder"),
              std::string::npos);
    EXPECT_NE(message_of(ErrorKind::file, [&] { read_mesh(scratch.folder()); }).find("is a folder"), std::string::npos);
    for (const char* name : {"a.xyz", "a", ".obj"}) {
        const std::string message = message_of(ErrorKind::argument, [&] { read_mesh(scratch.file(name, "x")); });
        EXPECT_NE(message.find(".obj .ply .stl .off .glb .gltf .vtk .vtp .fbx"), std::string::npos) << message;
        message_of(ErrorKind::argument, [&] { write_mesh(unit_cube(), scratch.path(name)); });
    }
    EXPECT_NE(message_of(ErrorKind::argument, [&] { write_mesh(unit_cube(), scratch.path("a.fbx")); }).find(".glb"),
              std::string::npos);
    EXPECT_NE(
        message_of(ErrorKind::file, [&] { write_mesh(unit_cube(), scratch.path("none/a.obj")); }).find("no folder"),
        std::string::npos);
}

// Flips, cuts and repeats bytes of sound files. A reader may take what is left for a mesh or refuse it; what it takes
// must be sound. Run under the address sanitizer this says more.
TEST_F(BadFiles, DamagedFilesNeverCrash) {
    Mesh mesh = wavy_sheet(4, 5);
    mesh.colors = Colors::Constant(mesh.positions.rows(), 4, 1);
    mesh.texcoords = Texcoords::Constant(mesh.positions.rows() + 1, 2, 0.5F);
    mesh.texcoord_triangles = mesh.triangles;
    mesh.texcoords.row(mesh.positions.rows()) << 0, 1;
    mesh.texcoord_triangles(1, 0) = static_cast<int>(mesh.positions.rows());
    std::mt19937 random(7);
    const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
    int taken = 0, refused = 0;
    for (const char* name : {"a.obj", "a.ply", "a.stl", "a.off", "a.glb", "a.vtk", "a.vtp"}) {
        write_mesh(mesh, scratch.path(name));
        const std::string whole = read_whole(scratch.path(name));
        for (int round = 0; round < 400; ++round) {
            std::string bytes = whole;
            const std::size_t head = round % 2 == 0 ? std::min<std::size_t>(bytes.size(), 600) : bytes.size();
            for (std::size_t k = 1 + below(4); k > 0; --k) {
                const std::size_t at = below(head);
                switch (below(5)) {
                case 0:
                    bytes[at % bytes.size()] = static_cast<char>(random());
                    break;
                case 1:
                    bytes[at % bytes.size()] = "0123456789-/ \n"[below(14)];
                    break;
                case 2:
                    bytes.erase(std::min(at, bytes.size()), below(9));
                    break;
                case 3:
                    bytes.insert(std::min(at, bytes.size()), bytes.substr(below(bytes.size()), below(30)));
                    break;
                default:
                    bytes.resize(bytes.size() - below(std::min<std::size_t>(40, bytes.size())));
                    break;
                }
                if (bytes.empty()) bytes = " ";
            }
            try {
                const Mesh back = read_mesh(scratch.file(name, bytes));
                ++taken;
                ASSERT_TRUE(back.positions.allFinite());
                ASSERT_GT(back.triangles.rows(), 0);
                ASSERT_GE(back.triangles.minCoeff(), 0);
                ASSERT_LT(back.triangles.maxCoeff(), back.positions.rows());
                if (back.texcoord_triangles.rows() > 0) {
                    ASSERT_EQ(back.texcoord_triangles.rows(), back.triangles.rows());
                    ASSERT_GE(back.texcoord_triangles.minCoeff(), 0);
                    ASSERT_LT(back.texcoord_triangles.maxCoeff(), back.texcoords.rows());
                    ASSERT_TRUE(back.texcoords.allFinite());
                }
                ASSERT_TRUE(back.colors.rows() == 0 || back.colors.rows() == back.positions.rows());
                ASSERT_TRUE(back.colors.allFinite());
            } catch (const Error& error) {
                ++refused;
                ASSERT_EQ(static_cast<int>(error.kind()), static_cast<int>(ErrorKind::file)) << error.what();
            }
        }
    }
    EXPECT_GT(taken, 100);
    EXPECT_GT(refused, 100);
}

} // namespace
} // namespace meshtween
