// What is open is never written over, and nothing that a person made is lost.
#include "session.h"

#include "meshtween/geometry/shapes.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"
#include "support/errors.h"
#include "support/scratch.h"

#include <gtest/gtest.h>

#include <chrono>

namespace meshtween::studio {
namespace fs = std::filesystem;
namespace {

struct Shelf {
    Scratch scratch;
    fs::path shelf = scratch.path("shelf");
    Events events;

    std::unique_ptr<Session> open(const fs::path& project) {
        return std::make_unique<Session>(project, std::vector<fs::path>{}, events, shelf);
    }
    std::unique_ptr<Session> open() { return open(shelf / "new" / "project.json"); }

    std::string ball(double radius, double shift = 0, int level = 2) const {
        Mesh mesh = sphere(level);
        mesh.positions *= radius;
        mesh.positions.col(0).array() += shift;
        const fs::path file = scratch.path("made.ply");
        write_mesh(mesh, file);
        return read_whole(file);
    }
};

// A marker on both sides, at the ends of an axis of a ball of radius 1.
Json marker(const std::string& id, double x, double y, double z) {
    return {{"id", id}, {"name", id}, {"source", {x, y, z}}, {"target", {x, y, z}}};
}

// As if the project had been saved so many seconds ago.
void age(const fs::path& project, int seconds) {
    fs::last_write_time(project, fs::file_time_type::clock::now() - std::chrono::seconds(seconds));
}

void place(Session& session, Side side, const std::string& name, const std::string& bytes) {
    const Json found = session.add_model(side, name, bytes);
    Json document = session.state()["document"];
    document["models"][std::string(name_of(side))] = found["model"];
    session.set_document(document);
}

TEST(Projects, a_sample_or_a_new_one_leaves_the_open_one_as_it_is) {
    Shelf house;
    const auto session = house.open();
    session->open_sample("bow", true);
    const fs::path first = session->file();
    EXPECT_EQ(first.parent_path().filename(), "new") << "an empty project is begun in place";
    Json document = session->state()["document"];
    document["markers"][0]["name"] = "mine";
    session->set_document(document);
    const std::string before = read_whole(first);
    const int number = session->state()["project"]["number"];
    session->open_sample("bow", true);
    const fs::path second = session->file();
    session->new_project();
    EXPECT_NE(second, first);
    EXPECT_NE(session->file(), second);
    EXPECT_EQ(read_whole(first), before);
    EXPECT_TRUE(session->state()["document"]["markers"].empty());
    const fs::path empty = session->file();
    session->new_project();
    EXPECT_EQ(session->file(), empty) << "an empty one is new already";
    EXPECT_GT(session->state()["project"]["number"], number);
    // A change of the project before that comes late is not written into this one.
    message_of(ErrorKind::argument, [&] { session->set_document(document, number); });
    EXPECT_TRUE(session->state()["document"]["markers"].empty());

    const Json list = session->projects();
    ASSERT_EQ(list.size(), 2U) << list.dump(1);
    for (const Json& one : list) EXPECT_FALSE(one["open"]);
    session->open_project("new");
    EXPECT_EQ(session->file(), first);
    EXPECT_EQ(session->state()["document"]["markers"][0]["name"], "mine");
    EXPECT_FALSE(session->state()["meshes"]["source"].is_null());
    EXPECT_EQ(read_whole(house.shelf / "last"), first.string()) << "the program goes on with it the next time";
    for (const char* id : {"", ".", "..", "../shelf/new", "nothing"})
        message_of(ErrorKind::argument, [&] { session->open_project(id); });
}

TEST(Projects, one_that_another_studio_has_open_stays_with_it) {
    Shelf house;
    const auto one = house.open();
    one->open_sample("bow", true);
    const auto two = house.open(house.shelf / "other" / "project.json");
    EXPECT_NE(message_of(ErrorKind::file, [&] { two->open_project("new"); }).find("another studio"), std::string::npos);
    EXPECT_EQ(two->file().parent_path().filename(), "other");
    one->new_project();
    two->open_project("new");
    EXPECT_EQ(two->state()["document"]["markers"].size(), one->projects()[0]["markers"].get<std::size_t>());
}

TEST(Projects, the_pair_that_was_named_finds_its_project_and_no_other) {
    Shelf house;
    const fs::path a = house.scratch.file("a.ply", house.ball(1)), b = house.scratch.file("b.ply", house.ball(2)),
                   c = house.scratch.file("c.ply", house.ball(3));
    const std::vector<fs::path> pair{a, b};
    const fs::path project = project_of(house.shelf, a, b);
    {
        Session session(project, pair, house.events, house.shelf);
        session.set_document({{"markers", Json::array({marker("m1", 1, 0, 0)})}});
    }
    EXPECT_EQ(project_of(house.shelf, a, b), fs::canonical(project));
    EXPECT_NE(project_of(house.shelf, a, c).parent_path(), project.parent_path());
    {
        Session session(project, pair, house.events, house.shelf);
        EXPECT_EQ(session.state()["document"]["markers"].size(), 1U);
        place(session, Side::target, "dropped.ply", house.ball(1.01));
    }
    EXPECT_NE(project_of(house.shelf, a, b).parent_path(), project.parent_path()) << "its target is another one now";
    const std::vector<fs::path> other{a, c};
    EXPECT_NE(message_of(ErrorKind::argument, [&] { Session(project, other, house.events, house.shelf); })
                  .find("dropped.ply"),
              std::string::npos);
}

TEST(Models, a_replaced_one_keeps_the_markers_that_lie_on_it_and_comes_back_with_its_fit) {
    Shelf house;
    const auto session = house.open();
    place(*session, Side::source, "a.ply", house.ball(1));
    place(*session, Side::target, "b.ply", house.ball(1));
    Json document = session->state()["document"];
    document["markers"] =
        Json::array({marker("px", 1, 0, 0), marker("mx", -1, 0, 0), marker("py", 0, 1, 0), marker("half", 0, 0, 1)});
    document["markers"][3]["target"] = nullptr;
    session->set_document(document);
    session->start_fit(nullptr);
    session->wait();
    const Json fit = session->state()["fit"];
    ASSERT_FALSE(fit.is_null()) << session->state()["job"].dump();

    // A ball that is a little larger and shifted: -x is far from it, +x nearly on it.
    const Json found = session->add_model(Side::target, "c.ply", house.ball(1.05, -0.1));
    EXPECT_EQ(session->state()["meshes"]["target"]["name"], "b.ply")
        << "until the document says so, nothing has changed";
    ASSERT_EQ(found["carried"].size(), 3U) << "a marker without a place there is not asked about";
    for (const Json& one : found["carried"]) {
        if (one["id"] == "px") {
            EXPECT_NEAR(one["at"][0], 0.95, 1e-6) << "put onto the new surface";
        }
        if (one["id"] == "mx") {
            EXPECT_TRUE(one["at"].is_null()) << "4 % of the diagonal away";
        }
    }
    const Json far = session->add_model(Side::target, "far.ply", house.ball(1, 40));
    for (const Json& one : far["carried"]) EXPECT_TRUE(one["at"].is_null());

    const Json before = session->state()["document"];
    Json replaced = before;
    replaced["models"]["target"] = found["model"];
    session->set_document(replaced);
    EXPECT_EQ(session->state()["meshes"]["target"]["name"], "c.ply");
    EXPECT_TRUE(session->state()["fit"].is_null()) << "the fit is of the other model";
    session->set_document(before); // as undo does
    EXPECT_EQ(session->state()["meshes"]["target"]["name"], "b.ply");
    EXPECT_EQ(session->state()["fit"], fit);
    EXPECT_FALSE(session->fitted_buffer("positions").empty());
    EXPECT_EQ(session->state()["document"], before);
}

TEST(Models, of_one_name_do_not_replace_each_other_on_the_disk) {
    Shelf house;
    const auto session = house.open();
    place(*session, Side::source, "a.ply", house.ball(1));
    const Json first = session->state()["document"];
    place(*session, Side::source, "a.ply", house.ball(2));
    EXPECT_NE(session->state()["meshes"]["source"]["hash"], first["models"]["source"]["hash"]);
    session->open_sample("bow", false); // forgets what it holds in memory
    session->open_project("new");
    session->set_document(first);
    EXPECT_EQ(session->state()["meshes"]["source"]["hash"], first["models"]["source"]["hash"]);
}

TEST(Models, named_elsewhere_are_in_reach_of_undo_after_a_restart) {
    Shelf house;
    const fs::path a = house.scratch.file("a.ply", house.ball(1)), b = house.scratch.file("b.ply", house.ball(2));
    const fs::path project = project_of(house.shelf, a, b);
    Json before;
    {
        Session session(project, {a, b}, house.events, house.shelf);
        before = session.state()["document"];
        place(session, Side::target, "c.ply", house.ball(3));
    }
    const auto session = house.open(project);
    session->set_document(before);
    EXPECT_EQ(session->state()["meshes"]["target"]["name"], "b.ply");
    Json elsewhere = before;
    elsewhere["models"]["target"]["path"] = house.scratch.file("secret.ply", house.ball(4)).string();
    message_of(ErrorKind::file, [&] { session->set_document(elsewhere); });
}

TEST(States, the_last_ten_are_kept_and_can_be_gone_back_to) {
    Shelf house;
    const auto session = house.open();
    place(*session, Side::source, "a.ply", house.ball(1));
    const auto edit = [&](int i) {
        Json document = session->state()["document"];
        document["markers"] = Json::array({marker("step " + std::to_string(i), 1, 0, 0)});
        session->set_document(document);
    };
    for (int i = 0; i < 25; ++i) {
        age(session->file(), 100 * (30 - i));
        edit(i);
    }
    const Json states = session->kept_states();
    ASSERT_EQ(states.size(), 10U);
    for (std::size_t i = 1; i < states.size(); ++i) EXPECT_GT(states[i - 1]["saved"], states[i]["saved"]);
    EXPECT_EQ(session->kept_document(states[0]["name"])["markers"][0]["name"], "step 23")
        << "the state before this one";
    EXPECT_EQ(session->kept_document(states[1]["name"])["markers"][0]["name"], "step 22");
    EXPECT_TRUE(session->kept_document(states[9]["name"])["markers"].empty()) << "and the first of all";
    edit(26), edit(27);
    EXPECT_EQ(session->kept_states()[0], states[0]) << "what did not stand for a second was on the way";
    session->set_document(session->kept_document(states[1]["name"]));
    EXPECT_EQ(session->state()["document"]["markers"][0]["name"], "step 22");
    message_of(ErrorKind::argument, [&] { session->kept_document("../project.json"); });
}

TEST(States, what_can_be_undone_is_kept_as_the_page_wrote_it) {
    Shelf house;
    auto session = house.open();
    EXPECT_EQ(session->history(), "null");
    session->set_history(R"({"past": []})");
    session.reset();
    EXPECT_EQ(house.open()->history(), R"({"past": []})");
}

TEST(Copies, open_as_projects_of_their_own) {
    Shelf house;
    const auto session = house.open();
    place(*session, Side::source, "Тест é.ply", house.ball(1));
    place(*session, Side::target, "b.ply", house.ball(2));
    Json project = session->project_json();
    project["source"]["path"] = "models/source/Тест é.ply";
    project["target"]["path"] = "models/target/b.ply";
    project["markers"] = Json::array({marker("nose", 1, 0, 0)});
    const std::vector<NamedBytes> files{{"project.json", project.dump()},
                                        {"models/source/Тест é.ply", house.ball(1)},
                                        {"models/target/b.ply", house.ball(2)}};
    const fs::path open = session->file();
    const std::string id = session->add_project(files);
    EXPECT_EQ(session->file(), open) << "it is opened when it is asked for";
    session->open_project(id);
    EXPECT_EQ(session->state()["meshes"]["source"]["name"], "Тест é.ply");
    EXPECT_EQ(session->state()["document"]["markers"][0]["name"], "nose");

    // Without the models' files: found by what is in them.
    const std::string second = session->add_project({{"project.json", project.dump()}});
    session->open_project(second);
    EXPECT_EQ(session->state()["meshes"]["target"]["name"], "b.ply");

    const auto told = [&](const std::vector<NamedBytes>& some) {
        try {
            session->add_project(some);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const auto folders = [&] { return std::distance(fs::directory_iterator(house.shelf), fs::directory_iterator()); };
    const auto there = folders();
    EXPECT_NE(told({}).find("no project.json"), std::string::npos);
    EXPECT_NE(told({{"project.json", "{"}}).find("no meshtween project"), std::string::npos);
    Json strange = project;
    strange["source"] = {{"path", "/etc/passwd"}, {"hash", ""}};
    EXPECT_NE(told({{"project.json", strange.dump()}}).find("open that file first"), std::string::npos);
    std::vector<NamedBytes> damaged = files;
    damaged[1].bytes = "ply\ngarbage";
    EXPECT_NE(told(damaged).find("Тест é.ply"), std::string::npos);
    for (const char* name : {"../escaped.ply", "/tmp/escaped.ply", "a/b/c/d.ply"}) {
        std::vector<NamedBytes> hostile = files;
        hostile.push_back({name, "x"});
        EXPECT_NE(told(hostile), "") << name;
    }
    EXPECT_EQ(folders(), there) << "what was refused leaves nothing";
}

} // namespace
} // namespace meshtween::studio
