#include "session.h"

#include "meshtween/fit/fit.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"
#include "support/errors.h"
#include "support/scratch.h"

#include <gtest/gtest.h>

#include <cstring>

namespace meshtween::studio {
namespace fs = std::filesystem;
namespace {

// A sphere and the same one stretched, as files, and six markers at the ends of the axes.
struct House {
    Scratch scratch;
    fs::path source = scratch.path("ball.ply"), target = scratch.path("egg.obj");
    fs::path project = scratch.path("project") / "project.json";
    Events events;

    House() {
        Mesh ball = sphere(3);
        write_mesh(ball, source);
        ball.positions = (2 * ball.positions).eval();
        ball.positions.col(1) *= 1.5;
        write_mesh(ball, target);
    }
    static Json document() {
        Json markers = Json::array();
        const double stretch[3] = {2, 3, 2};
        for (int axis = 0; axis < 3; ++axis)
            for (const double sign : {-1.0, 1.0}) {
                Json from{0, 0, 0}, to{0, 0, 0};
                from[std::size_t(axis)] = sign, to[std::size_t(axis)] = sign * stretch[axis];
                markers.push_back(
                    {{"id", "m" + std::to_string(markers.size())}, {"name", ""}, {"source", from}, {"target", to}});
            }
        return {{"markers", markers}, {"options", {{"fit", {{"rounds", 3}}}}}};
    }
    std::unique_ptr<Session> open(bool named = true) {
        return std::make_unique<Session>(project,
                                         named ? std::vector<fs::path>{source, target} : std::vector<fs::path>{},
                                         events, scratch.path("shelf"));
    }
};

std::vector<float> floats(const std::string& bytes) {
    std::vector<float> values(bytes.size() / sizeof(float));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

TEST(Session, fits_morphs_exports_and_remembers) {
    House house;
    auto session = house.open();
    session->set_document(House::document());
    session->start_fit(House::document()["options"]["fit"]);
    session->wait();
    Json state = session->state();
    ASSERT_EQ(state["job"]["state"], "done") << state["job"].dump();
    EXPECT_EQ(state["fit"]["marker_errors"].size(), 6U);
    for (const auto& [id, error] : state["fit"]["marker_errors"].items()) EXPECT_LT(error.get<double>(), 1) << id;
    const std::string fitted = session->fitted_buffer("positions");
    EXPECT_EQ(fitted.size(), state["meshes"]["source"]["vertices"].get<std::size_t>() * 12);

    session->start_path({{"options", {{"method", "linear"}}}});
    session->wait();
    state = session->state();
    ASSERT_EQ(state["paths"].size(), 1U) << state["job"].dump();
    const std::string key = state["paths"][0]["key"];
    const std::size_t last = state["paths"][0]["meshes"].get<std::size_t>() - 1;
    EXPECT_EQ(session->path_buffer(key, last, "positions"), fitted) << "the path ends at the fitted mesh";
    message_of(ErrorKind::argument, [&] { session->path_buffer(key, last + 1, "positions"); });

    // Painted all over, everything has come home by the middle.
    const Json all{{"at", {0, 0, 0}}, {"radius", 10}, {"start", 0}, {"end", 0.5}};
    session->start_path({{"options", {{"method", "linear"}}}, {"timing", {{"dabs", Json::array({all})}}}});
    session->wait();
    state = session->state();
    ASSERT_EQ(state["paths"].size(), 2U) << state["job"].dump();
    const Json& painted = state["paths"][state["paths"][0]["key"] == key ? 1 : 0];
    const SplineBasis basis{painted["degree"], painted["knots"]};
    const std::vector<double> weights = basis.weights(0.5);
    ASSERT_EQ(painted["meshes"], weights.size());
    std::vector<double> half(fitted.size() / sizeof(float), 0.0);
    for (std::size_t k = 0; k < weights.size(); ++k) {
        const std::vector<float> node = floats(session->path_buffer(painted["key"], k, "positions"));
        for (std::size_t i = 0; i < half.size(); ++i) half[i] += weights[k] * node[i];
    }
    const std::vector<float> wanted = floats(fitted);
    for (std::size_t i = 0; i < half.size(); ++i) ASSERT_NEAR(half[i], wanted[i], 1e-3) << i; // what a look takes
    Json late = all;
    late["start"] = 0.7;
    session->start_path({{"options", Json::object()}, {"timing", {{"dabs", Json::array({late})}}}});
    session->wait();
    EXPECT_NE(session->state()["job"]["error"].dump().find("dab 1 of the timing must start before it ends"),
              std::string::npos);

    session->start_export(
        {{"names", {"fitted.obj", "frame_##.ply"}}, {"frames", 3}, {"options", {{"method", "linear"}}}});
    session->wait();
    ASSERT_EQ(session->state()["job"]["state"], "done") << session->state()["job"].dump();
    EXPECT_EQ(session->state()["job"]["result"]["files"].size(), 4U);
    EXPECT_TRUE(fs::exists(session->exported("frame_02.ply")));

    session.reset();
    session = house.open(false); // the project remembers, but a foreign folder's meshes must be named again
    EXPECT_TRUE(session->state()["meshes"]["source"].is_null());
    EXPECT_NE(session->state()["notes"].dump().find("was not opened"), std::string::npos);
    EXPECT_EQ(session->state()["document"]["markers"].size(), 6U);
}

TEST(Session, keeps_the_fit_for_the_next_time) {
    House house;
    auto session = house.open();
    session->set_document(House::document());
    session->start_fit(nullptr);
    session->wait();
    const std::string fitted = session->fitted_buffer("positions");
    const Json before = session->state()["fit"];
    session.reset();
    session = house.open();
    EXPECT_EQ(session->state()["fit"], before);
    EXPECT_EQ(session->fitted_buffer("positions"), fitted);
    EXPECT_EQ(session->state()["document"]["options"]["fit"]["rounds"], 3);
}

TEST(Session, fits_without_markers_and_says_that_it_guesses) {
    House house;
    const auto session = house.open();
    session->set_document({{"markers", Json::array()}});
    session->start_fit(nullptr);
    session->wait();
    const Json state = session->state();
    ASSERT_EQ(state["job"]["state"], "done") << state["job"].dump();
    EXPECT_NE(state["fit"]["notes"].dump().find("guess"), std::string::npos);
    const Json next = session->suggestions();
    ASSERT_EQ(next.size(), 5U);
    EXPECT_EQ(next[0]["at"], state["fit"]["next_markers"][0]["source"]);
    EXPECT_EQ(next[0]["target"], state["fit"]["next_markers"][0]["target"]) << "the fit knows where it lies";
    const Json first{{"id", "a"}, {"name", "a"}, {"source", next[0]["at"]}, {"target", next[0]["target"]}};
    session->set_document({{"markers", Json::array({first})}});
    for (const Json& place : session->suggestions()) EXPECT_NE(place["at"], next[0]["at"]) << "it has its marker now";
}

TEST(Session, a_cancelled_fit_changes_nothing) {
    House house;
    const auto session = house.open();
    session->set_document(House::document());
    session->start_fit({{"rounds", 1000}, {"threshold", 1e-9}});
    session->cancel();
    session->wait();
    EXPECT_EQ(session->state()["job"]["state"], "cancelled");
    EXPECT_TRUE(session->state()["fit"].is_null());
}

TEST(Session, a_cancelled_export_leaves_nothing_half_written) {
    House house;
    const auto session = house.open();
    session->set_document(House::document());
    session->start_fit(nullptr);
    session->wait();
    session->start_export(
        {{"names", {"frame_####.png", "morph.apng"}}, {"frames", 5000}, {"options", {{"method", "linear"}}}});
    session->cancel();
    session->wait();
    EXPECT_EQ(session->state()["job"]["state"], "cancelled") << session->state()["job"].dump();
    EXPECT_FALSE(fs::exists(house.project.parent_path() / "exports" / "morph.apng"));
    for (const auto& entry : fs::recursive_directory_iterator(house.project.parent_path()))
        EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
}

TEST(Session, a_fit_says_what_it_does_before_it_moves_anything) {
    const Mesh ball = sphere(3);
    std::vector<std::string> stages;
    fit(ball, ball, {}, {}, [&](double, std::string_view stage) {
        if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
        return true;
    });
    ASSERT_GE(stages.size(), 4U);
    EXPECT_EQ(stages[0], "numbering the meshes");
    EXPECT_EQ(stages[1], "aligning");
    EXPECT_EQ(stages[2], "preparing coarse levels");
}

TEST(Session, tells_of_a_mesh_what_was_noted_while_it_was_read) {
    House house;
    const auto session = house.open();
    const Mesh ball = sphere(2);
    const fs::path file = house.scratch.path("noted.obj");
    write_mesh(ball, file);
    const std::string text = read_whole(file) + "f 1 2\n"; // a face of two corners does not affect the shape
    const Json found = session->add_model(Side::source, "noted.obj", text);
    const fs::path same = house.scratch.file("same.obj", text);
    const Mesh read = read_mesh(same);
    ASSERT_TRUE(read.file);
    EXPECT_EQ(found["notes"], Json(read.file->notes)) << "the library's own words";
    EXPECT_FALSE(found["notes"].empty());
}

TEST(Session, notices_a_mesh_that_changed) {
    House house;
    auto session = house.open();
    EXPECT_EQ(session->changes(), Json({{"source", false}, {"target", false}}));
    write_mesh(sphere(2), house.source);
    EXPECT_EQ(session->changes(), Json({{"source", true}, {"target", false}}));
    const Json again = session->examine_again(Side::source);
    session->set_document(
        {{"models", {{"source", again["model"]}, {"target", session->state()["document"]["models"]["target"]}}}});
    EXPECT_EQ(session->changes()["source"], false);
    EXPECT_EQ(session->state()["meshes"]["source"]["vertices"], sphere(2).positions.rows());
    session.reset();
    write_mesh(sphere(1), house.source);
    session = house.open();
    EXPECT_NE(session->state()["notes"].dump().find("changed since"), std::string::npos);
    fs::remove(house.target);
    session.reset();
    session = house.open();
    EXPECT_TRUE(session->state()["meshes"]["target"].is_null()) << "a mesh that is gone is told, not fatal";
    EXPECT_EQ(session->state()["notes"].size(), 1U);
}

TEST(Session, refuses_what_cannot_be_and_keeps_what_was) {
    House house;
    const auto session = house.open();
    session->set_document(House::document());
    const Json before = session->project_json();
    EXPECT_NE(message_of(ErrorKind::argument, [&] { session->start_path(Json::object()); }).find("no fit yet"),
              std::string::npos);
    message_of(ErrorKind::argument, [&] { session->start_fit({{"rounds", "many"}}); });
    message_of(ErrorKind::argument, [&] { session->start_fit({{"rounds", 1e9}}); });
    message_of(ErrorKind::argument, [&] { session->start_fit({{"nonsense", 1}}); });
    message_of(ErrorKind::argument, [&] { session->set_document({{"markers", 3}}); });
    EXPECT_EQ(message_of(ErrorKind::file, [&] { session->add_model(Side::target, "new.ply", "ply\ngarbage"); })
                  .find(house.project.parent_path().string()),
              std::string::npos)
        << "where the studio keeps it is nobody's business";
    message_of(ErrorKind::file,
               [&] { session->add_model(Side::target, "far.gltf", R"({"buffers":[{"uri":"/etc/passwd"}]})"); });
    Json reaching = House::document();
    reaching["models"] = {{"source", nullptr}, {"target", {{"path", "/etc/passwd"}, {"hash", ""}}}};
    message_of(ErrorKind::file, [&] { session->set_document(reaching); });
    message_of(ErrorKind::argument, [&] { session->set_document(House::document(), 7); });
    Json doubled = House::document();
    doubled["markers"][0]["name"] = doubled["markers"][1]["name"] = "nose";
    EXPECT_NE(message_of(ErrorKind::argument, [&] { session->set_document(doubled); }).find("nose"), std::string::npos);
    EXPECT_EQ(session->project_json(), before);
    session->set_document({{"markers", Json::array()}});
    EXPECT_NE(message_of(ErrorKind::argument,
                         [&] {
                             session->start_fit({{"method", "paper"}});
                         })
                  .find("needs 3"),
              std::string::npos);
}

TEST(Session, guesses_and_suggests) {
    House house;
    const auto session = house.open();
    session->set_document(House::document());
    const double s = 1 / std::sqrt(2.0);
    const Json there = session->guesses(Side::source, {{s, s, 0}});
    EXPECT_NEAR(there[0][0], 2 * s, 0.1);
    EXPECT_NEAR(there[0][1], 3 * s, 0.15);
    EXPECT_EQ(session->suggestions().size(), 5U);
    Json few = House::document();
    few["markers"] = Json::array({few["markers"][0]});
    session->set_document(few);
    EXPECT_NEAR(session->guesses(Side::target, {{0, 3, 0}})[0][1], 1, 0.05) << "without a warp: box on box";
}

TEST(Session, markers_go_out_and_come_in) {
    House house;
    const auto session = house.open();
    Json document = House::document();
    document["markers"][1]["source"] = nullptr;
    session->set_document(document);
    const Json written = session->export_markers("csv");
    ASSERT_EQ(written["files"].size(), 1U);
    const Json back = session->import_markers({{"m.csv", written["files"][0]["text"]}}, {});
    ASSERT_EQ(back["markers"].size(), 6U) << "those with one side too";
    for (const Json& one : back["markers"]) {
        const Json& there = document["markers"][std::stoul(one["name"].get<std::string>()) - 1];
        EXPECT_EQ(one["source"], there["source"]);
        EXPECT_EQ(one["target"], there["target"]);
    }
    EXPECT_EQ(session->export_markers("pp")["files"].size(), 2U);
    message_of(ErrorKind::argument, [&] { session->export_markers("docx"); });
    const std::string told = message_of(ErrorKind::file, [&] { session->import_markers({{"m.csv", "\xff\xfe"}}, {}); });
    EXPECT_EQ(told.find("/tmp"), std::string::npos) << "the temporary folder is nobody's business: " << told;
}

TEST(Session, warns_of_markers_off_the_surface) {
    House house;
    const auto session = house.open();
    session->set_document(House::document());
    EXPECT_TRUE(session->marker_warnings().empty());
    Json document = House::document();
    document["markers"][0]["name"] = "tip";
    document["markers"][0]["source"] = {-1.6, 0, 0};
    session->set_document(document);
    ASSERT_EQ(session->marker_warnings().size(), 1U);
    EXPECT_NE(session->marker_warnings()[0].get<std::string>().find("tip"), std::string::npos);
}

} // namespace
} // namespace meshtween::studio
