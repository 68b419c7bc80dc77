// Every landmark format that is written is read back by a reader that is not ours, landmark_reader.py, and by ours.
#include "meshtween/io/marker_write.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include "support/errors.h"
#include "support/scratch.h"
#include "support/shapes.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdlib>

namespace meshtween {
namespace {

using Json = nlohmann::json;

Json read_by_others(const std::filesystem::path& path, const std::filesystem::path& mesh) {
    const std::filesystem::path answer = path.string() + ".answer";
    const std::string command = fmt::format("python3 '{}/tests/io/landmark_reader.py' '{}' '{}' > '{}'",
                                            MESHTWEEN_SOURCE_DIR, path.string(), mesh.string(), answer.string());
    EXPECT_EQ(std::system(command.c_str()), 0) << command << '\n' << read_whole(path);
    const std::string text = read_whole(answer);
    return Json::parse(text, nullptr, false);
}

class MarkerWriting : public testing::Test {
protected:
    MarkerWriting() : mesh(unit_cube()) {
        write_mesh(mesh, mesh_path = scratch.path("cube.obj"));
        mesh = read_mesh(mesh_path);
    }

    // That a side holds the points (and names, where the format has them) of these pairs.
    void expect_side(const Json& side, std::optional<Point> PartialPair::*which, bool names, bool missing,
                     const std::string& what) const {
        std::size_t at = 0;
        for (const PartialPair& pair : pairs) {
            const std::optional<Point>& place = pair.*which;
            if (!place && !missing) continue;
            ASSERT_LT(at, side.size()) << what;
            const Json& entry = side[at++];
            if (names) {
                EXPECT_EQ(entry[0], pair.name) << what;
            }
            ASSERT_EQ(entry[1].is_null(), !place) << what;
            for (int k = 0; place && k < 3; ++k)
                EXPECT_NEAR(entry[1][static_cast<std::size_t>(k)].get<double>(), (*place)[k], missing ? 0 : 1e-15)
                    << what;
        }
        EXPECT_EQ(at, side.size()) << what;
    }

    Scratch scratch;
    std::filesystem::path mesh_path;
    Mesh mesh;
    std::vector<PartialPair> pairs{{"nose, \"tip\" <&>", Point(0.1, 0, 1.0 / 3), Point(1, 0.25, 0.5)},
                                   {"#2", std::nullopt, Point(0, 0, 1e-17)},
                                   {"ухо", Point(1, 1, 1), std::nullopt},
                                   {"plain", Point(0, 1, 0.75), Point(0.5, 0.5, 1)}};
};

TEST_F(MarkerWriting, OneSideIsReadByOthers) {
    std::vector<Landmark> landmarks;
    for (const PartialPair& pair : pairs) landmarks.push_back({pair.name, pair.source});
    for (const char* name :
         {"a.csv", "a.tsv", "a.pp", "a.fcsv", "a.mrk.json", "A.JSON", "a.dta", "a.tps", "a.txt", "a.landmarkAscii"}) {
        const auto notes = write_landmarks(landmarks, scratch.path(name), &mesh);
        const Json sides = read_by_others(scratch.path(name), mesh_path);
        ASSERT_EQ(sides.size(), 1u) << name;
        const bool wrap = name == std::string("A.JSON"),
                   names =
                       std::string("csv tsv .pp son").find(std::string(name).substr(std::string(name).size() - 3)) !=
                       std::string::npos;
        expect_side(sides[0], &PartialPair::source, names, !wrap, name);
        EXPECT_EQ(notes.size(), names ? 0u : wrap ? 2u : 1u) << name;
    }
}

TEST_F(MarkerWriting, NamesOfPtsAreWords) {
    pairs[0].name = "nose tip";
    std::vector<Landmark> landmarks;
    for (const PartialPair& pair : pairs) landmarks.push_back({pair.name, pair.source});
    write_landmarks(landmarks, scratch.path("a.pts"), &mesh);
    pairs[0].name = "nose_tip";
    expect_side(read_by_others(scratch.path("a.pts"), mesh_path)[0], &PartialPair::source, true, true, "a.pts");
}

TEST_F(MarkerWriting, BothSidesInOneFile) {
    for (const char* name : {"a.csv", "a.tsv", "a.dta", "a.tps", "a.txt", "a.landmarkAscii"}) {
        write_markers(pairs, scratch.path(name), &mesh, &mesh);
        const Json sides = read_by_others(scratch.path(name), mesh_path);
        ASSERT_EQ(sides.size(), 2u) << name;
        const bool names = std::string(name).find("sv") != std::string::npos;
        expect_side(sides[0], &PartialPair::source, names, true, name);
        expect_side(sides[1], &PartialPair::target, names, true, name);
    }
}

TEST_F(MarkerWriting, AFileASide) {
    for (const char* end : {".csv", ".pp", ".fcsv", ".mrk.json", ".landmarkAscii"}) {
        const auto a = scratch.path(std::string("a") + end), b = scratch.path(std::string("b") + end);
        write_markers(pairs, a, b, &mesh, &mesh);
        const bool names = end != std::string(".landmarkAscii");
        expect_side(read_by_others(a, mesh_path)[0], &PartialPair::source, names, true, end);
        expect_side(read_by_others(b, mesh_path)[0], &PartialPair::target, names, true, end);
    }
    // Wrap pairs by order alone: a pair that lacks a side is left out of both.
    const auto notes = write_markers(pairs, scratch.path("a.json"), scratch.path("b.json"), &mesh, &mesh);
    ASSERT_FALSE(notes.empty());
    EXPECT_NE(notes[0].find("2 pairs that lack a side are left out"), std::string::npos) << notes[0];
    std::erase_if(pairs, [](const PartialPair& p) { return !p.source || !p.target; });
    expect_side(read_by_others(scratch.path("a.json"), mesh_path)[0], &PartialPair::source, false, false, "Wrap");
    expect_side(read_by_others(scratch.path("b.json"), mesh_path)[0], &PartialPair::target, false, false, "Wrap");
}

TEST_F(MarkerWriting, WhatCannotBeWrittenIsSaidBeforeAnythingIs) {
    const std::vector<Landmark> landmarks{{"a", Point(0, 0, 0)}};
    const auto said = [&](const char* name, const Mesh* on) {
        return message_of(ErrorKind::argument, [&] { write_landmarks(landmarks, scratch.path(name), on); });
    };
    const auto before = scratch.entries();
    EXPECT_NE(said("a.xyz", &mesh).find(".landmarkAscii"), std::string::npos);
    EXPECT_NE(said(".csv", &mesh).find("no landmark format"), std::string::npos);
    EXPECT_NE(said("a.json", nullptr).find("needs the mesh"), std::string::npos);
    for (const char* name : {"a.pp", "a.fcsv", "a.mrk.json", "a.json", "a.pts"}) {
        EXPECT_FALSE(holds_both_sides(name));
        EXPECT_NE(message_of(ErrorKind::argument, [&] { write_markers(pairs, scratch.path(name), &mesh, &mesh); })
                      .find("a file a side"),
                  std::string::npos);
    }
    EXPECT_EQ(scratch.entries(), before);
    EXPECT_TRUE(is_marker_format("x.MRK.JSON"));
    EXPECT_FALSE(is_marker_format("x.obj"));
}

} // namespace
} // namespace meshtween
