#include "project.h"

#include "meshtween/io/json_limits.h"

#include "support/errors.h"
#include "support/scratch.h"

#include <gtest/gtest.h>

namespace meshtween::studio {
namespace {

Project example() {
    Project project;
    project.source = {"/models/a.ply", "00ff"};
    project.target = {"/project/models/b.ply", "11ee"};
    project.markers = {{"m1", "nose", Point(0.1, 1.0 / 3, -2e-300), Point(1, 2, 3), true, ""},
                       {"m2", "ear ☞", Point(4, 5, 6), std::nullopt, false, "m1"}};
    project.options = {{"fit", {{"rounds", 7}}}};
    return project;
}

TEST(Project, comes_back_from_its_json_to_the_last_bit) {
    const Project there = example();
    const Json json = Json::parse(to_json(there, "/project").dump(2));
    const Project back = project_from_json(json, "/project");
    EXPECT_EQ(back.source.path, there.source.path);
    EXPECT_EQ(back.target.path, there.target.path);
    EXPECT_EQ(back.source.hash, "00ff");
    ASSERT_EQ(back.markers.size(), 2U);
    EXPECT_EQ(*back.markers[0].source, *there.markers[0].source);
    EXPECT_FALSE(back.markers[1].target);
    EXPECT_TRUE(back.markers[0].locked);
    EXPECT_EQ(back.markers[1].twin, "m1");
    EXPECT_EQ(back.markers[1].name, "ear ☞");
    EXPECT_EQ(back.options, there.options);
}

TEST(Project, moves_with_its_folder) {
    const Json json = to_json(example(), "/project");
    EXPECT_EQ(json["target"]["path"], "models/b.ply");
    EXPECT_EQ(project_from_json(json, "/elsewhere").target.path, "/elsewhere/models/b.ply");
    EXPECT_EQ(project_from_json(json, "/elsewhere").source.path, "/models/a.ply");
}

TEST(Project, tells_what_is_wrong_with_a_file) {
    const auto told = [](const char* text) {
        return message_of(ErrorKind::argument, [&] { project_from_json(Json::parse(text), "/p"); });
    };
    const auto unread = json_or_discarded<Json>(std::string(100'000, '[') + std::string(100'000, ']'));
    EXPECT_NE(message_of(ErrorKind::argument, [&] { project_from_json(unread, "/p"); }).find("no meshtween project"),
              std::string::npos);
    EXPECT_NE(told("null").find("no meshtween project"), std::string::npos);
    EXPECT_NE(told(R"({"meshtween_project": 99})").find("version 99"), std::string::npos);
    EXPECT_NE(told(R"({"meshtween_project": 1, "markers": {}})").find("list"), std::string::npos);
    EXPECT_NE(told(R"({"meshtween_project": 1, "markers": [{"id": "a"}, {"id": ""}]})").find("marker 2"),
              std::string::npos);
    EXPECT_NE(told(R"({"meshtween_project": 1, "markers": [{"id": "a"}, {"id": "a"}]})").find("two markers"),
              std::string::npos);
    EXPECT_NE(told(R"({"meshtween_project": 1, "markers": [{"id": "a", "source": [1, 2, "x"]}]})").find("marker 1"),
              std::string::npos);
}

TEST(Project, numbers_the_doubled_names_of_older_files) {
    const Json json =
        Json::parse(R"({"meshtween_project": 1, "markers": [{"id": "a", "name": "eye"}, {"id": "b", "name": "eye"},
        {"id": "c", "name": "eye 2"}, {"id": "d", "name": ""}, {"id": "e", "name": ""}]})");
    const Project project = project_from_json(json, "/p");
    std::vector<std::string> names;
    for (const PlacedMarker& marker : project.markers) names.push_back(marker.name);
    EXPECT_EQ(names, (std::vector<std::string>{"eye", "eye 3", "eye 2", "", ""}));
}

TEST(Project, hash_tells_a_changed_file) {
    const Scratch scratch;
    const auto a = scratch.file("a", "one"), b = scratch.file("b", "one"), c = scratch.file("c", "onE");
    EXPECT_EQ(hash_of(a), hash_of(b));
    EXPECT_NE(hash_of(a), hash_of(c));
    EXPECT_EQ(hash_of(scratch.file("empty", "")), "cbf29ce484222325"); // FNV-1a of nothing
}

} // namespace
} // namespace meshtween::studio
