#include "meshtween/geometry/shapes.h"
#include "meshtween/io/markers.h"
#include "meshtween/io/output.h"

#include "support/errors.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace meshtween {
namespace {

class Markers : public testing::Test {
protected:
    Markers() : source(unit_cube()), target(unit_cube()) { target.positions.rowwise() += Point(10, 0, 0); }

    MarkerPairs read(std::string_view name, std::string_view contents) const {
        return read_marker_pairs(scratch.file(name, contents), source, target);
    }
    MarkerPairs read(std::string_view a_name, std::string_view a, std::string_view b_name, std::string_view b) const {
        const auto a_path = scratch.file(a_name, a), b_path = scratch.file(b_name, b);
        return read_marker_pairs(a_path, b_path, source, target);
    }
    Scratch scratch;
    Mesh source, target; // a cube, and the same at x + 10
};

TEST_F(Markers, Csv) {
    const MarkerPairs markers = read("a.csv", "\xEF\xBB\xBFname,sx,sy,sz,tx,ty,tz\r\n# a comment\r\n\r\n"
                                              "\"nose, tip \"\"x\"\"\",0,0.1,0,10,0,1e-1\r\n ear ; 1;0;0; 11;0;0\r\n");
    ASSERT_EQ(markers.pairs.size(), 2u);
    EXPECT_EQ(markers.pairs[0].name, "nose, tip \"x\"");
    EXPECT_EQ(markers.pairs[0].source, Point(0, 0.1, 0));
    EXPECT_EQ(markers.pairs[0].target, Point(10, 0, 0.1));
    EXPECT_EQ(markers.pairs[1].name, "ear");
    EXPECT_TRUE(markers.notes.empty()) << markers.notes[0];
}

TEST_F(Markers, AHeaderAloneIsNoMarkers) {
    const MarkerPairs markers = read("a.csv", "name,sx,sy,sz,tx,ty,tz\n");
    EXPECT_TRUE(markers.pairs.empty());
    EXPECT_TRUE(markers.notes.empty());
}

TEST_F(Markers, WhatIsWrittenIsRead) {
    const std::vector<MarkerPair> pairs{{"plain", {0.1, 0, 1.0 / 3}, {10, 0, 1e-17}},
                                        {"with, comma and \"quotes\"", {0, 0, 0}, {10, 1, 1}},
                                        {"# no comment", {0, 1, 0}, {11, 1, 1}}};
    write_marker_pairs(pairs, scratch.path("a.csv"));
    const MarkerPairs back = read_marker_pairs(scratch.path("a.csv"), source, target);
    ASSERT_EQ(back.pairs.size(), pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        EXPECT_EQ(back.pairs[i].name, pairs[i].name);
        EXPECT_EQ(back.pairs[i].source, pairs[i].source);
        EXPECT_EQ(back.pairs[i].target, pairs[i].target);
    }
}

TEST_F(Markers, ListsOfIndices) {
    for (const char* list : {"0 1\n3 7\n", "0,1\n3,7\n", "a,0,1\nb,3,7\n"}) {
        const MarkerPairs markers = read("a.txt", list);
        ASSERT_EQ(markers.pairs.size(), 2u) << list;
        EXPECT_EQ(markers.pairs[1].source, Point(1, 1, 0));
        EXPECT_EQ(markers.pairs[1].target, Point(11, 1, 1));
        EXPECT_EQ(markers.pairs[0].name, list[0] == 'a' ? "a" : "1");
    }
    EXPECT_EQ(read("a.txt", "0\n3\n", "b.txt", "1\n7\n").pairs[1].target, Point(11, 1, 1));
}

TEST_F(Markers, MeshLabPickedPoints) {
    const char* a =
        "<!DOCTYPE PickedPoints>\n<PickedPoints>\n <DocumentData><DataFileName name=\"a.ply\"/></DocumentData>\n"
        " <point x=\"0\" active=\"1\" y=\"0\" z=\"1\" name=\"nose &amp; tip\"/>\n"
        " <point active=\"0\" name=\"ear\" x=\"0\" y=\"0\" z=\"0\"/>\n"
        " <point z=\"0\" name=\"chin\" x=\"1\" y=\"1\"/>\n</PickedPoints>\n";
    const char* b = "<PickedPoints><point name='chin' x='11' y='1' z='0'/><point name='ear' x='10' y='0' z='0'/>"
                    "<point name='nose &amp; tip' x='10' y='0' z='1' active='1'/></PickedPoints>";
    const MarkerPairs markers = read("a.pp", a, "b.pp", b);
    ASSERT_EQ(markers.pairs.size(), 2u);
    EXPECT_EQ(markers.pairs[0].name, "nose & tip");
    EXPECT_EQ(markers.pairs[0].target, Point(10, 0, 1));
    EXPECT_EQ(markers.pairs[1].source, Point(1, 1, 0));
    ASSERT_EQ(markers.notes.size(), 1u);
    EXPECT_NE(markers.notes[0].find("ear"), std::string::npos);
}

TEST_F(Markers, SlicerAndItsFormats) {
    const char* fcsv = "# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n# columns = "
                       "id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n"
                       "vtkMRMLMarkupsFiducialNode_0,1,0,1,0,0,0,1,1,1,0,nose,,\n"
                       "vtkMRMLMarkupsFiducialNode_1,0,1,0,0,0,0,1,1,1,0,\"ear, left\",,\n";
    const char* json = R"({"@schema": "markups", "markups": [{"type": "Fiducial", "coordinateSystem": "LPS",
        "controlPoints": [{"id": "1", "label": "ear, left", "position": [10, 1, 0], "positionStatus": "defined"},
                          {"id": "2", "label": "nose", "position": [11, 0, 1]},
                          {"id": "3", "label": "chin", "position": [10, 0, 0], "positionStatus": "undefined"},
                          {"id": "4", "label": "brow", "position": null},
                          {"id": "5", "label": "lobe", "position": [null, null, null]}]}]})";
    const MarkerPairs markers = read("a.fcsv", fcsv, "b.mrk.json", json);
    ASSERT_EQ(markers.pairs.size(), 2u);
    EXPECT_EQ(markers.pairs[0].name, "nose");
    EXPECT_EQ(markers.pairs[0].target, Point(11, 0, 1));
    EXPECT_EQ(markers.pairs[1].name, "ear, left");
    ASSERT_EQ(markers.notes.size(), 1u);
    EXPECT_NE(markers.notes[0].find("chin, brow, lobe"), std::string::npos) << markers.notes[0];
}

TEST_F(Markers, WrapPointsOnTriangles) {
    // triangle 4 of the cube: (0 0 0) (1 0 0) (0 0 1)
    const MarkerPairs lists = read("a.json", "[[4, 0.25, 0.5], [0, 1, 0]]", "b.json", "[[4, 0, 0], [4, 0, 1]]");
    ASSERT_EQ(lists.pairs.size(), 2u);
    EXPECT_EQ(lists.pairs[0].source, Point(0.5, 0, 0.25));
    EXPECT_EQ(lists.pairs[0].target, Point(10, 0, 1));
    const MarkerPairs named =
        read("a.json", R"({"z": [4, 1, 0], "a": [4, 0, 1]})", "b.json", R"({"a": [4, 0, 1], "z": [4, 1, 0]})");
    EXPECT_EQ(named.pairs[0].name, "z"); // in the file's order
    EXPECT_EQ(named.pairs[1].target, Point(11, 0, 0));
}

TEST_F(Markers, IdavLandmarks) {
    const MarkerPairs markers = read("a.pts", "Version 1.0\n3\nS000 0 0 0\nS001 1 1 1\nS002 1 0 0\n", "b.pts",
                                     "Version 1.0\n3\nS000 10 0 0\nS001 9999 9999 9999\nS002 11 0 0\n");
    ASSERT_EQ(markers.pairs.size(), 2u);
    EXPECT_EQ(markers.pairs[1].name, "S002");
    EXPECT_EQ(markers.notes.size(), 1u);
}

TEST_F(Markers, SidesWithoutNamesGoByOrder) {
    const MarkerPairs markers = read("a.csv", "0,0,0\n1,1,1\n", "b.csv", "first,10,0,0\nsecond,11,1,1\n");
    ASSERT_EQ(markers.pairs.size(), 2u);
    EXPECT_EQ(markers.pairs[1].name, "second");
    EXPECT_EQ(markers.pairs[1].source, Point(1, 1, 1));
}

TEST_F(Markers, MissingOnesAreToldAndLeftOut) {
    const MarkerPairs markers = read("a.csv", "a,0,0,0,10,0,0\nb,,,,11,0,0\nc,1,1,1,nan,nan,nan\nd,1,1,0,11,1,0\n");
    ASSERT_EQ(markers.pairs.size(), 2u);
    EXPECT_EQ(markers.pairs[1].name, "d");
    ASSERT_EQ(markers.notes.size(), 1u);
    EXPECT_NE(markers.notes[0].find("a.csv: 2 markers have no place on one side and are left out: b, c"),
              std::string::npos);
    const MarkerPairs two = read("a.csv", "a,0,0,0\nb,1,0,0\n", "b.csv", "c,10,0,0\nb,11,0,0\n");
    EXPECT_EQ(two.pairs.size(), 1u);
    EXPECT_NE(two.notes[0].find("a.csv: 2 markers have no place on one side and are left out: a, c"),
              std::string::npos);
}

TEST_F(Markers, PairsAtOnePlace) {
    const MarkerPairs same = read("a.csv", "a,0,0,0,10,0,0\nb,1,0,0,11,0,0\nc,0,0,0,10,0,0\n");
    EXPECT_EQ(same.pairs.size(), 2u);
    ASSERT_EQ(same.notes.size(), 1u);
    EXPECT_NE(same.notes[0].find("a.csv: marker 'c' says the same as 'a' and is left out"), std::string::npos);
    const MarkerPairs pressed = read("a.csv", "lip,0,0,0,10,0,0\nother,0,0,0.1,10,0,0\n");
    EXPECT_EQ(pressed.pairs.size(), 2u);
    ASSERT_EQ(pressed.notes.size(), 1u);
    EXPECT_NE(pressed.notes[0].find("one place of the target"), std::string::npos);
}

// The causes are found on a shape without symmetry.
class OffMesh : public Markers {
protected:
    OffMesh() {
        source = wavy_sheet(12, 30);
        source.positions.rowwise() += Point(3, 7, 1);
        target = source;
        target.positions *= 1.5;
    }
    std::string note(const Eigen::Matrix3d& change, bool exchange = false) const {
        std::vector<MarkerPair> pairs;
        for (int i = 0; i < 9; ++i) {
            const Point s = source.positions.row(37 * i), t = target.positions.row(37 * i);
            pairs.push_back({"m" + std::to_string(i), exchange ? t : Point(s * change.transpose()), exchange ? s : t});
        }
        write_marker_pairs(pairs, scratch.path("a.csv"));
        try {
            const MarkerPairs markers = read_marker_pairs(scratch.path("a.csv"), source, target);
            EXPECT_EQ(markers.pairs.size(), 9u);
            return markers.notes.empty() ? "" : markers.notes[0];
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::file);
            return std::string("stopped: ") + error.what();
        }
    }
};

TEST_F(OffMesh, TheCauseIsFound) {
    Eigen::Matrix3d identity = Eigen::Matrix3d::Identity(), z_up, change = identity;
    z_up << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    EXPECT_EQ(note(identity), "");
    change.diagonal() << -1, -1, 1;
    EXPECT_NE(note(change).find("negate x and y (the markers are in LPS"), std::string::npos) << note(change);
    EXPECT_NE(note(identity * 1000).find("multiply all by 0.001"), std::string::npos) << note(identity * 1000);
    EXPECT_NE(note(identity * 0.01).find("multiply all by 100 "), std::string::npos) << note(identity * 0.01);
    EXPECT_NE(note(z_up).find("z upwards, the model y"), std::string::npos) << note(z_up);
    EXPECT_NE(note(z_up.transpose()).find("y upwards, the model z"), std::string::npos) << note(z_up.transpose());
    const std::string both = note(change * 1000);
    EXPECT_NE(both.find("negate x and y"), std::string::npos) << both;
    EXPECT_NE(both.find("multiply all by 0.001"), std::string::npos) << both;
    EXPECT_NE(note(identity, true).find("exchanged"), std::string::npos) << note(identity, true);
    EXPECT_NE(note(identity * 7).find("see whether they belong to this model"), std::string::npos);
    EXPECT_EQ(note(identity * 7).find("stopped: "), 0u) << "markers of another model are no markers";
    EXPECT_NE(note(identity * 1.1).find("markers lie further"), std::string::npos);
    EXPECT_EQ(note(identity * 1.1).find("stopped: "), std::string::npos) << note(identity * 1.1);
    EXPECT_NE(note(identity * 7).find("9 of 9 markers lie further from the source"), std::string::npos);
}

TEST_F(Markers, WrongSignsShowOnAShapeThatIsNearlyTheSameFromBehind) {
    Mesh egg = sphere(3);
    for (auto p : egg.positions.rowwise()) p[1] *= p[1] > 0 ? 1.06 : 1;
    std::vector<MarkerPair> turned, right;
    for (Eigen::Index i = 0; i < egg.positions.rows() && turned.size() < 12; ++i) {
        const Point p = egg.positions.row(i);
        if (p[1] < 0.5) continue;
        right.push_back({"m" + std::to_string(i), p, p});
        turned.push_back({"m" + std::to_string(i), Point(-p[0], -p[1], p[2]), p});
    }
    const auto notes = [&](const std::vector<MarkerPair>& pairs) {
        write_marker_pairs(pairs, scratch.path("a.csv"));
        return read_marker_pairs(scratch.path("a.csv"), egg, egg).notes;
    };
    EXPECT_TRUE(notes(right).empty());
    ASSERT_EQ(notes(turned).size(), 1u);
    EXPECT_NE(notes(turned)[0].find("further from the source than they would with x and y negated"), std::string::npos)
        << notes(turned)[0];
}

TEST_F(Markers, OnOfManyOffTheMeshIsNamed) {
    std::string rows;
    for (int i = 0; i < 20; ++i)
        rows +=
            "m" + std::to_string(i) + "," + std::to_string(i / 20.0) + ",0,0,10,0," + std::to_string(i / 20.0) + "\n";
    const MarkerPairs markers = read("a.csv", rows + "stray,0.5,0.5,-0.5,10,0,1\n");
    ASSERT_EQ(markers.notes.size(), 1u);
    EXPECT_NE(markers.notes[0].find(
                  "1 of 21 markers lie further from the source than 5 % of its diagonal, up to 28.9 % (stray)"),
              std::string::npos)
        << markers.notes[0];
}

TEST_F(Markers, BadFilesAreTold) {
    const struct {
        const char *name, *contents, *words;
    } rows[] = {
        {"a.csv", "", "empty"},
        {"a.csv", "a,0,0,0,10,0,0\na,1,0,0,11,0,0\n", "marker 'a' comes twice, line 1 and line 2"},
        {"a.csv", "a,0,0,0,10,0,0\nb,0,0,0,11,0,0\n", "'a' and 'b' lie at one place of the source but at two"},
        {"a.csv", "a,0,0,0,10,0,0\nb,1,0,0,11\n", "line 2: this row has 5 cells"},
        {"a.csv", "a,0,0,0,10,0,x\n", "line 1: z should be a number, not 'x'"},
        {"a.csv", "a,0,0,0,10,0,inf\n", "line 1: z is inf"},
        {"a.csv", "a,0,0,,10,0,0\n", "line 1: z is missing"},
        {"a.csv", "1,2,3,4,5\n", "a row of 5 cells"},
        {"a.csv", "a,0,0,0\n", "one side only"},
        {"a.pp", "<PickedPoints><point x='0' y='0' z='0' name='a'/></PickedPoints>", "one side only"},
        {"a.txt", "0 8\n", "line 1: vertex 8 is out of range: the mesh has 8, 0 to 7"},
        {"a.txt", "0 1\n-1 2\n", "line 2: vertex -1 is out of range"},
        {"a.txt", "0 1\n99999999999999999999 2\n", "line 2: a vertex's index should be a number"},
    };
    for (const auto& row : rows) {
        const std::string message = message_of(ErrorKind::file, [&] { read(row.name, row.contents); });
        EXPECT_NE(message.find(row.words), std::string::npos) << row.contents << ": " << message;
        EXPECT_NE(message.find(row.name), std::string::npos) << message;
    }
    EXPECT_NE(message_of(ErrorKind::file, [&] { read("a.csv", std::string_view("a,0\0,0", 6)); }).find("no text"),
              std::string::npos);
    EXPECT_NE(message_of(ErrorKind::file, [&] { read_marker_pairs(scratch.path("none.csv"), source, target); })
                  .find("no such file"),
              std::string::npos);
}

TEST_F(Markers, BadSidesAreTold) {
    const char* good = "a,10,0,0\n";
    const std::string deep = std::string(100'000, '[') + std::string(100'000, ']');
    const std::string deep_markups = R"({"markups": [{"controlPoints": [{"position": )" + deep + "}]}]}";
    std::string many = "{";
    for (int i = 0; i < 30'000; ++i) many += "\"" + std::to_string(i) + "\": null, ";
    many += R"("last": null})";
    const struct {
        const char *name, *contents, *words;
    } rows[] = {
        {"a.csv", "0,0,0\n1,0,0\n", "holds 1 markers, but"},
        {"a.csv", "b,0,0,0\n", "none of its names"},
        {"a.csv", "a,0,0,0,10,0,0\n", "both sides already"},
        {"a.pp", "<PickedPoints><point x='0' y='0'", "truncated"},
        {"a.pp", "<html></html>", "no whole list"},
        {"a.pp", "<PickedPoints><point x='0' y='zero' z='0' name='a'/></PickedPoints>",
         "point 0: y should be a number"},
        {"a.pp", "<PickedPoints><point x='0' z='0' name='a'/></PickedPoints>", "point 0: y should be a number"},
        {"a.fcsv", "id,1,2\n", "line 1: z is missing"},
        {"a.mrk.json", "{\"markups\": [{\"controlPoints\": [{\"label\": \"a\", \"position\": [1, 2]}]}]}",
         "not [x, y, z]"},
        {"a.mrk.json", "{\"markups\": [{\"controlPoints\": [7]}]}", "control point 0"},
        {"a.json", "{\"markups\": [", "JSON"},
        {"a.json", deep.c_str(), "nested too deeply"},
        {"a.mrk.json", deep_markups.c_str(), "nested too deeply"},
        {"a.json", many.c_str(), "too many entries"},
        {"a.json", "7", "neither"},
        {"a.json", "[[0, 0.2]]", "entry 0: should be [triangle, u, v]"},
        {"a.json", "[[12, 0.2, 0.2]]", "entry 0: triangle 12 is out of range"},
        {"a.json", "{\"a\": [-1, 0.2, 0.2]}", "'a': -1 is no triangle"},
        {"a.json", "{\"a\": [0, 0.8, 0.4]}", "outside the triangle"},
        {"a.pts", "Version 1.0\n2\nS000 0 0 0\n", "promises 2 landmarks but holds 1"},
    };
    for (const auto& row : rows) {
        const std::string message = message_of(ErrorKind::file, [&] { read(row.name, row.contents, "b.csv", good); });
        EXPECT_NE(message.find(row.words), std::string::npos) << row.contents << ": " << message;
    }
}

TEST_F(Markers, ListsOfPoints) {
    Points points(3, 3);
    points << 0.1, 1.0 / 3, 1e-300, 1, 2, 3, -4, 5, 6;
    write_points(points, scratch.path("truth.csv"));
    EXPECT_EQ(read_points(scratch.path("truth.csv")), points);
    EXPECT_EQ(read_points(scratch.file("bare.txt", "1 2 3\n# no more\n")).row(0), Point(1, 2, 3));
    EXPECT_NE(message_of(ErrorKind::file, [&] { read_points(scratch.file("a.csv", "1,2,3\n1,2\n")); }).find("line 2"),
              std::string::npos);
}

} // namespace
} // namespace meshtween
