// Landmark files as people have them: headers in any order, formats of morphometrics, systems of coordinates.
#include "meshtween/io/marker_write.h"
#include "meshtween/io/markers.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/output.h"

#include "support/errors.h"
#include "support/scratch.h"
#include "support/shapes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace meshtween {
namespace {

class LandmarkFiles : public testing::Test {
protected:
    LandmarkFiles() : mesh(unit_cube()) {}

    LandmarkList read(std::string_view name, std::string_view contents) const {
        return read_landmarks(scratch.file(name, contents), mesh);
    }
    // "a 1 0 0.5; b -" of a list.
    std::string shown(std::string_view name, std::string_view contents) const {
        std::string text;
        for (const Landmark& point : read(name, contents).points) {
            text += (text.empty() ? "" : "; ") + point.name;
            text += point.position
                        ? fmt::format(" {} {} {}", (*point.position)[0], (*point.position)[1], (*point.position)[2])
                        : " -";
        }
        return text;
    }
    Scratch scratch;
    Mesh mesh;
};

std::string utf16(std::string_view text, bool big_endian) {
    std::string bytes = big_endian ? "\xFE\xFF" : "\xFF\xFE";
    for (const char c : text) {
        if (big_endian) bytes += '\0';
        bytes += c;
        if (!big_endian) bytes += '\0';
    }
    return bytes;
}

TEST_F(LandmarkFiles, ColumnsGoByTheirNames) {
    const std::string right = "a 1 0 0.5; b 0 1 0.25";
    const std::string plain = "name,x,y,z\na,1,0,0.5\nb,0,1,0.25\n";
    const std::string rows[] = {
        plain,
        "name,z,y,x\na,0.5,0,1\nb,0.25,1,0\n",
        "\"\",\"x\",\"y\",\"z\"\n\"a\",1,0,0.5\n\"b\",0,1,0.25\n",           // R's write.csv
        "x y z\n\"a\" 1 0 0.5\n\"b\" 0 1 0.25\n",                            // R's write.table
        "\"\";\"x\";\"y\";\"z\"\n\"a\";1;0;0,5\n\"b\";0;1;0,25\n",           // R's write.csv2
        "sep=;\r\nName;X [mm];Y [mm];Z [mm]\r\na;1;0;0,5\r\nb;0;1;0,25\r\n", // Excel in German
        "Name\tX\tY\tZ\na\t1\t0\t0,5\nb\t0\t1\t0,25\n",
        ",0,1,2\na,1,0,0.5\nb,0,1,0.25\n", // pandas
        "name,x,y,z,comment\na,1,0,0.5,\"left, side\"\nb,0,1,0.25,\n",
        "comment,z,label,x,y\n,0.5,a,1,0\nleft,0.25,b,0,1\n",
        "label,l,p,s,defined,selected,visible,locked,description\na,1,0,0.5,1,1,1,0,\nb,0,1,0.25,1,1,1,0,a; "
        "b\n",                                   // Slicer
        "# name,x,y,z\na,1,0,0.5\nb,0,1,0.25\n", // numpy's savetxt
        "landmark,x,y,z,nx,ny,nz\na,1,0,0.5,0,0,1\nb,0,1,0.25,0,0,1\n",
        "\xEF\xBB\xBF" + plain,
        utf16(plain, false),
        utf16(plain, true),
        "name,x,y,z\ra,1,0,0.5\rb,0,1,0.25\r",
    };
    for (const std::string& row : rows) EXPECT_EQ(shown("a.csv", row), right) << row;
    EXPECT_EQ(shown("a.csv", "0,1,2\n1,0,0.5\n0,1,0.25\n"), "1 1 0 0.5; 2 0 1 0.25"); // pandas, without names
    EXPECT_EQ(shown("a.csv", "0,1,2\n1,0,0\n"), "1 0 1 2; 2 1 0 0");                  // a point like any other
    EXPECT_EQ(shown("a.csv", "name,x,y,z\n#a,1,0,0.5\n# a comment\n#1,0,1,0.25\n"), "#a 1 0 0.5; #1 0 1 0.25");
    EXPECT_EQ(shown("a.csv", "x,y,z\n#a,1,0\n1,0,0.5\n"), "1 1 0 0.5");
    for (const char* said : {"Sep=;", "\"sep=;\""}) // Excel
        EXPECT_EQ(shown("a.csv", fmt::format("{}\nname;x;y;z\na;1;0;0,5\n", said)), "a 1 0 0.5");
    EXPECT_EQ(shown("a.csv", "NA,NA,NA\n1,0,0.5\n"), "1 -; 2 1 0 0.5");
    EXPECT_EQ(shown("a.csv", "na\xEFve,x,y,z\n\xE9,1,0,0.5\n"), "é 1 0 0.5"); // Latin-1
    for (const char* missing : {"NA,NA,NA", "NaN,nan,NaN", ",,", "#N/A,#N/A,#N/A", "null,null,null"})
        EXPECT_EQ(shown("a.csv", fmt::format("name,x,y,z\na,1,0,0.5\nb,{}\n", missing)), "a 1 0 0.5; b -");
    EXPECT_EQ(shown("a.csv", "label,r,a,s,defined\na,1,0,0.5,1\nb,0,0,0,0\n"), "a 1 0 0.5; b -");
    EXPECT_EQ(read("a.csv", "name,x,y,z,comment\na,1,0,0.5,c\n").notes.size(), 1u);
}

TEST_F(LandmarkFiles, PairsGoByTheirNamesToo) {
    Mesh target = mesh;
    target.positions.rowwise() += Point(10, 0, 0);
    for (const char* table :
         {"name,sx,sy,sz,tx,ty,tz\na,1,0,0.5,11,0,0.5\n", "tz,ty,tx,name,sz,sy,sx\n0.5,0,11,a,0.5,0,1\n",
          "name,source_x,source_y,source_z,target_x,target_y,target_z\na,1,0,0.5,11,0,0.5\n",
          "\"\",\"x_target\",\"y_target\",\"z_target\",\"x_source\",\"y_source\",\"z_source\"\n\"a\",11,0,0.5,1,0,0."
          "5\n",
          "name,x1,y1,z1,x2,y2,z2,note\na,1,0,0.5,11,0,0.5,\n", "name,x,y,z,x.1,y.1,z.1\na,1,0,0.5,11,0,0.5\n"}) {
        const MarkerPairs pairs = read_marker_pairs(scratch.file("p.csv", table), mesh, target);
        ASSERT_EQ(pairs.pairs.size(), 1u) << table;
        EXPECT_EQ(pairs.pairs[0].name, "a") << table;
        EXPECT_EQ(pairs.pairs[0].source, Point(1, 0, 0.5)) << table;
        EXPECT_EQ(pairs.pairs[0].target, Point(11, 0, 0.5)) << table;
    }
}

TEST_F(LandmarkFiles, FcsvIsCutAtCommas) {
    const std::string header = "# Markups fiducial file version = 5.6\n# CoordinateSystem = LPS\n# columns = "
                               "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n";
    EXPECT_EQ(shown("a.fcsv", header + "1,1,0,0.5,0,0,0,1,1,1,0,a,upper; left,,2,0\n2,0,0,0,0,0,0,1,1,1,0,b,,,0,0\n"
                                       "3,0,0,0,0,0,0,1,1,1,0,\"c, d\",,,3,0\n"),
              "a 1 0 0.5; b -; c, d -");
    EXPECT_EQ(shown("a.fcsv", header + "1,1,0,0.5,0,0,0,1,1,1,0,a,,\n"), "a 1 0 0.5"); // Slicer 4
    EXPECT_EQ(shown("a.fcsv", "# columns = label,x,y,z,sel,vis\n#1,1,0,0.5,1,1\n# 2, or so\n"), "#1 1 0 0.5"); // 3
}

const char* morphologika = "[individuals]\n2\n[landmarks]\n2\n[Dimensions]\n3\n[names]\none\ntwo\n[labels]\nsex\n"
                           "[labelvalues]\nF\nM\n[rawpoints]\n\n'#1\n1 0 0.5\n0 1 0.25\n\n'#2\n1 1 1\n9999 9999 9999\n";
const char* tps = "LM3=2\n1 0 0.5\n0 1 0.25\nID=one\nLM3=2\n0.5 0.5 0.5\nNA NA NA\nIMAGE=two.jpg\nSCALE=2\n";
const char* dta = "'Exported from Landmark\n'a comment\n1 2L 6 1 9999 Dim=3\n\none\ntwo\n\n1 0 0.5\n0 1 0.25\n\n1 1 1\n"
                  "9999 9999 9999\n";
const char* wide = "ID,LM1_x,LM1_y,LM1_z,2.X,2.Y,2.Z,nose z,nose y,nose x\none,1,0,0.5,0,1,0.25,0,0,1\n"
                   "two,1,1,1,NA,NA,NA,1,0,0\n";

TEST_F(LandmarkFiles, OneOfSeveralSpecimens) {
    for (const auto& [name, contents] : {std::pair("a.txt", morphologika), {"a.tps", tps}, {"a.dta", dta}}) {
        auto file = std::make_shared<MeshFile>();
        file->path = "/somewhere/Two.ply";
        mesh.file = file;
        EXPECT_EQ(shown(name, contents), "1 1 1 1; 2 -") << name;
        EXPECT_EQ(read(name, contents).notes.size(), name == std::string("a.tps") ? 2u : 1u) << name;
        mesh.file = nullptr;
        EXPECT_EQ(shown(name, contents), "1 1 0 0.5; 2 0 1 0.25") << name;
        const std::string notes = fmt::format("{}", fmt::join(read(name, contents).notes, " "));
        EXPECT_NE(notes.find("number 1, 'one', is taken"), std::string::npos) << notes;
        const MarkerPairs pairs = read_marker_pairs(scratch.file(name, contents), mesh, mesh); // the two sides
        ASSERT_EQ(pairs.pairs.size(), 1u) << name;
        EXPECT_EQ(pairs.pairs[0].target, Point(1, 1, 1)) << name;
    }
    EXPECT_EQ(shown("a.csv", wide), "lm1 1 0 0.5; 2 0 1 0.25; nose 1 0 0");
}

TEST_F(LandmarkFiles, OtherFormats) {
    EXPECT_EQ(shown("a.nts", "1 1 6 0 DIM=3\n1 0 0.5 0\n1 0.25\n"), "1 1 0 0.5; 2 0 1 0.25");
    EXPECT_EQ(shown("a.nts", "1 1B 6L 0 DIM=3\na b c d e f\none 1 0 0.5 0 1 0.25\n"), "1 1 0 0.5; 2 0 1 0.25");
    EXPECT_EQ(shown("a.nts", "1 1E 6 0 DIM=3\n1 0 0.5 0 1 0.25 one\n"), "1 1 0 0.5; 2 0 1 0.25");
    EXPECT_EQ(shown("a.tps", "LM=1\n1 0 0.5\nCURVES=1\nPOINTS=2\n1 1 1\n1 0 1\nID=a\n"), "1 1 0 0.5");
    const std::string amira = "# AmiraMesh 3D ASCII 2.0\n\n\ndefine Markers 2\n\nParameters {\n    NumSets 1,\n"
                              "    ContentType \"LandmarkSet\"\n}\n\nMarkers { float[3] Coordinates } @1\n\n"
                              "# Data section follows\n@1\n1.0e+00 0 0.5 \n0 1 0.25 \n\n";
    EXPECT_EQ(shown("a.landmarkAscii", amira), "1 1 0 0.5; 2 0 1 0.25");
    EXPECT_EQ(shown("a.obj", "# points\nv 1 0 0.5\nv 0 1 0.25\n"), "1 1 0 0.5; 2 0 1 0.25");
    EXPECT_EQ(shown("a.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                             "property float z\nend_header\n1 0 0.5\n0 1 0.25\n"),
              "1 1 0 0.5; 2 0 1 0.25");
}

TEST_F(LandmarkFiles, WhatIsWrittenIsRead) {
    auto file = std::make_shared<MeshFile>();
    file->path = "cube.obj";
    mesh.file = file;
    const std::vector<PartialPair> pairs{{"nose tip", Point(1, 0, 0.5), Point(0, 0, 1.0 / 3)},
                                         {"ear", std::nullopt, Point(0, 1, 0)},
                                         {"chin", Point(0.25, 1, 0), std::nullopt},
                                         {"brow", Point(1, 1, 0), Point(1, 0.25, 1)}};
    for (const char* end : {".csv", ".tsv", ".dta", ".tps", ".txt", ".landmarkAscii"}) {
        const auto path = scratch.path(std::string("both") + end);
        write_markers(pairs, path, &mesh, &mesh);
        const MarkerPairs back = read_marker_pairs(path, mesh, mesh);
        ASSERT_EQ(back.pairs.size(), 2u) << end;
        EXPECT_EQ(back.pairs[1].source, Point(1, 1, 0)) << end;
        EXPECT_EQ(back.pairs[0].target, Point(0, 0, 1.0 / 3)) << end;
    }
    for (const char* end :
         {".csv", ".tsv", ".pp", ".fcsv", ".mrk.json", ".pts", ".dta", ".tps", ".txt", ".landmarkAscii"}) {
        const auto a = scratch.path(std::string("a") + end), b = scratch.path(std::string("b") + end);
        write_markers(pairs, a, b, &mesh, &mesh);
        const MarkerPairs back = read_marker_pairs(a, b, mesh, mesh);
        ASSERT_EQ(back.pairs.size(), 2u) << end;
        EXPECT_EQ(back.pairs[1].source, Point(1, 1, 0)) << end;
        EXPECT_EQ(back.pairs[0].target, Point(0, 0, 1.0 / 3)) << end;
        const LandmarkList list = read_landmarks(a, mesh);
        ASSERT_EQ(list.points.size(), 4u) << end;
        EXPECT_FALSE(list.points[1].position) << end;
    }
}

TEST_F(LandmarkFiles, NamesThatDifferInABeginning) {
    const auto paired = [&](const char* a, const char* b) {
        const MarkerPairs pairs = read_marker_pairs(scratch.file("a.csv", a), scratch.file("b.csv", b), mesh, mesh);
        std::string text;
        for (const MarkerPair& pair : pairs.pairs) text += fmt::format("{}:{} ", pair.name, pair.target[2]);
        EXPECT_NE(fmt::format("{}", fmt::join(pairs.notes, " ")).find("paired by the rest"), std::string::npos);
        return text;
    };
    EXPECT_EQ(paired("F-1,0,0,0\nF-2,1,0,0\nF-11,1,1,0\n", "L-11,0,0,0.11\nL-2,0,0,0.2\nL-1,0,0,0.1\n"),
              "F-1:0.1 F-2:0.2 F-11:0.11 ");
    EXPECT_EQ(paired("source_nose,0,0,0\nsource_ear,1,0,0\n", "target_ear,0,0,0.2\ntarget_nose,0,0,0.1\n"),
              "source_nose:0.1 source_ear:0.2 ");
    EXPECT_EQ(paired("Skull1_nasion,0,0,0\nSkull1_bregma,1,0,0\n", "Bregma,0,0,0.2\nNasion,0,0,0.1\n"),
              "Skull1_nasion:0.1 Skull1_bregma:0.2 ");
    EXPECT_EQ(paired("nose_s,0,0,0\near_s,1,0,0\n", "ear_t,0,0,0.2\nnose_t,0,0,0.1\n"), "nose_s:0.1 ear_s:0.2 ");
}

// A sheet away from the axes, whose points tell the signs.
class Systems : public testing::Test {
protected:
    Systems() : mesh(wavy_sheet(12, 30)) {
        mesh.positions.rowwise() += Point(3, 7, 1);
        far = mesh;
        far.positions *= 1.5;
    }
    void name(Mesh& of, const char* path, const char* space) const {
        auto file = std::make_shared<MeshFile>();
        file->path = path;
        file->format = ".ply";
        file->bytes = std::string("ply\nformat ascii 1.0\ncomment 3D Slicer output. SPACE=") + space + "\nend_header\n";
        of.file = file;
    }
    std::string rows(const Mesh& of, bool negated, const char* format) const {
        std::string text;
        for (int i = 0; i < 9; ++i) {
            const Point p = of.positions.row(37 * i);
            const double sign = negated ? -1 : 1;
            text += fmt::format(fmt::runtime(format), i, sign * p[0], sign * p[1], p[2]);
        }
        return text;
    }
    std::filesystem::path fcsv(const char* name, const Mesh& of, const char* space, bool negated) const {
        return scratch.file(name, fmt::format("# CoordinateSystem = {}\n", space) +
                                      rows(of, negated, "{0},{1},{2},{3},0,0,0,1,1,1,0,m{0},,\n"));
    }
    std::filesystem::path csv(const char* name, const Mesh& of, bool negated) const {
        return scratch.file(name, rows(of, negated, "m{},{},{},{}\n"));
    }
    // That all is where it should be; the notes in one.
    std::string expect_right(const MarkerPairs& pairs) const {
        EXPECT_EQ(pairs.pairs.size(), 9u);
        for (std::size_t i = 0; i < pairs.pairs.size(); ++i) {
            EXPECT_EQ(pairs.pairs[i].source, Point(mesh.positions.row(37 * static_cast<Eigen::Index>(i))));
            EXPECT_EQ(pairs.pairs[i].target, Point(far.positions.row(37 * static_cast<Eigen::Index>(i))));
        }
        return fmt::format("{}", fmt::join(pairs.notes, "\n"));
    }
    Scratch scratch;
    Mesh mesh, far;
};

TEST_F(Systems, WhatIsNamedIsObeyed) {
    name(mesh, "mesh.ply", "LPS");
    name(far, "far.ply", "LPS");
    const auto right = fcsv("b.fcsv", far, "LPS", false);
    EXPECT_EQ(expect_right(read_marker_pairs(fcsv("a.fcsv", mesh, "1", false), right, mesh, far)), "");
    for (const char* ras : {"0", "RAS"}) {
        const std::string notes = expect_right(read_marker_pairs(fcsv("a.fcsv", mesh, ras, true), right, mesh, far));
        EXPECT_NE(notes.find("a.fcsv: its points are in RAS and mesh.ply is in LPS: x and y are negated"),
                  std::string::npos)
            << notes;
    }
    name(mesh, "mesh.ply", "RAS"); // a mesh of the other system
    expect_right(read_marker_pairs(fcsv("a.fcsv", mesh, "LPS", true), right, mesh, far));
    const auto json = scratch.file(
        "a.mrk.json", "{\"markups\": [{\"controlPoints\": [" +
                          rows(mesh, true, "{{\"label\": \"m{}\", \"position\": [{}, {}, {}]}},") +
                          "{\"label\": \"last\", \"positionStatus\": \"undefined\"}]}]}"); // LPS where it says nothing
    expect_right(read_marker_pairs(json, right, mesh, far));
}

TEST_F(Systems, TwoFilesThatDifferOnSilentMeshes) {
    const std::string notes = expect_right(
        read_marker_pairs(fcsv("good.fcsv", mesh, "LPS", false), fcsv("ras.fcsv", far, "RAS", true), mesh, far));
    EXPECT_NE(notes.find("ras.fcsv: its points are in RAS"), std::string::npos) << notes;
    EXPECT_EQ(notes.find("good.fcsv: "), std::string::npos) << notes;
    // The distances decide where the meshes are in RAS.
    expect_right(read_marker_pairs(fcsv("a.fcsv", mesh, "RAS", false), fcsv("b.fcsv", far, "LPS", true), mesh, far));
    // Meshes of two systems: nothing to do.
    EXPECT_EQ(expect_right(
                  read_marker_pairs(fcsv("a.fcsv", mesh, "RAS", false), fcsv("b.fcsv", far, "LPS", false), mesh, far)),
              "");
}

TEST_F(Systems, SilentOnesAreToldAndCanBeSaid) {
    const auto good = csv("good.csv", mesh, false), wrong = csv("wrong.csv", far, true);
    const std::string said = message_of(ErrorKind::file, [&] { read_marker_pairs(good, wrong, mesh, far); });
    EXPECT_NE(said.find("wrong.csv: 9 of 9 markers lie further from the target"), std::string::npos) << said;
    EXPECT_EQ(said.find("good.csv"), std::string::npos) << said;
    EXPECT_NE(said.find("give --markers-system LPS,RAS"), std::string::npos) << said;
    expect_right(read_marker_pairs(good, wrong, mesh, far, {{Space::lps, Space::ras}}));
    expect_right(read_marker_pairs(csv("a.csv", mesh, true), wrong, mesh, far, {{Space::ras, Space::ras}}));
    name(far, "far.ply", "RAS");
    EXPECT_NE(
        message_of(ErrorKind::file, [&] { read_marker_pairs(good, wrong, mesh, far); }).find("--markers-system LPS"),
        std::string::npos);
    expect_right(read_marker_pairs(good, wrong, mesh, far, {{Space::unknown, Space::lps}}));
}

TEST_F(Systems, FilesInTheWrongOrderAreExchanged) {
    const std::string notes =
        expect_right(read_marker_pairs(csv("t.csv", far, false), csv("s.csv", mesh, false), mesh, far));
    EXPECT_NE(notes.find("the other way round"), std::string::npos) << notes;
}

TEST_F(LandmarkFiles, BadOnesAreTold) {
    const std::string half_amira =
        "# AmiraMesh 3D ASCII 2.0\ndefine Markers 3\nMarkers { float[3] Coordinates } @1\n@1\n1 0 0\n";
    const struct {
        const char* name;
        std::string contents;
        const char* words;
    } rows[] = {
        {"a.tps", "LM3=3\n1 0 0\n", "promises 3 landmarks but holds 1"},
        {"a.tps", "LM3=1\n1 0 0\n0 0 0\n", "holds more"},
        {"a.tps", "LM3=99999999999\n", "LM3"},
        {"a.tps", "LM=1\n1 0\nID=a\n", "line 2: a point of two coordinates"},
        {"a.tps", "\x11\x12garbage", "begins with LM"},
        {"a.tps", "LM3=1\n1 0 x\n", "line 2: z should be a number"},
        {"a.tps", "LM3=1\n1 0 0\nSCALE=0\n", "SCALE is 0"},
        {"a.dta", "1 2L 6 1 9999 DIM=3\na\n", "2 names are promised"},
        {"a.dta", "1 1L 6 1 9999 DIM=3\na\n1 0 0\n", "which are 6, but holds 3"},
        {"a.dta", "1 1L 6 1 9999 DIM=2\na\n1 0 0 0 0 0\n", "not three coordinates"},
        {"a.dta", "garbage here\n", "line 1: should be the matrix's line"},
        {"a.dta", "'comments alone\n", "holds no matrix"},
        {"a.txt", "[individuals]\n1\n[landmarks]\n2\n[rawpoints]\n1 0 0\n", "which are 2, but holds 1"},
        {"a.txt", "[individuals]\n1\n", "lacks [individuals] or [landmarks]"},
        {"a.txt", "[individuals]\n1\n[dimensions]\n2\n", "2 coordinates"},
        {"a.txt", "[individuals]\nmany\n", "line 2: the number of individuals"},
        {"a.landmarkAscii", half_amira, "promises 3 landmarks but holds 1"},
        {"a.landmarkAscii", "# AmiraMesh BINARY-LITTLE-ENDIAN 2.1\n", "binary"},
        {"a.landmarkAscii", "garbage\n", "no landmark set"},
        {"a.landmarkAscii", half_amira.substr(0, half_amira.find("@1\n1")), "lacks the data of a set"},
        {"a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "a mesh of 1 faces"},
        {"a.csv", "name,x,y,z\na,1,0\n", "line 2: this row has 3 cells"},
        {"a.csv", "name,x,y,z\na,1,NA,0\n", "line 2: y should be a number"},
        {"a.csv", "p,q,r,s,t\n1,2,3,4,5\n", "a header that names the columns x, y and z would do"},
        {"a.csv", "name,sx,sy,sz,tx,ty,tz\na,0,0,0,1,1,1\n", "both sides"},
        {"a.mrk.json", "{\"markups\": [7]}", "no object"},
        {"a.mrk.json", "{\"markups\": [{\"controlPoints\": 7}]}", "no list"},
    };
    for (const auto& row : rows) {
        const std::string message = message_of(ErrorKind::file, [&] { read(row.name, row.contents); });
        EXPECT_NE(message.find(row.words), std::string::npos) << row.contents << ": " << message;
        EXPECT_NE(message.find(row.name), std::string::npos) << message;
    }
}

} // namespace
} // namespace meshtween
