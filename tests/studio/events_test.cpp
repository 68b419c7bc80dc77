#include "events.h"
#include "jobs.h"
#include "tabs.h"

#include "meshtween/core/error.h"

#include <gtest/gtest.h>

namespace meshtween::studio {
namespace {

using std::chrono::milliseconds;

TEST(Events, give_each_reader_every_message_once_and_in_order) {
    Events events;
    std::uint64_t a = events.end(), b = a;
    events.publish("x", {{"n", 1}});
    events.publish("y", {{"n", 2}});
    EXPECT_EQ(events.wait(a, milliseconds(0)),
              "id: 0\nevent: x\ndata: {\"n\":1}\n\nid: 1\nevent: y\ndata: {\"n\":2}\n\n");
    EXPECT_EQ(events.wait(a, milliseconds(0)), "");
    events.publish("z", nullptr);
    EXPECT_EQ(events.wait(a, milliseconds(0)), "id: 2\nevent: z\ndata: null\n\n");
    EXPECT_NE(events.wait(b, milliseconds(0)).find("event: x"), std::string::npos);
}

TEST(Events, tell_a_reader_that_fell_behind_to_ask_anew) {
    Events events;
    std::uint64_t next = 0;
    for (int i = 0; i < 1000; ++i) events.publish("x", i);
    EXPECT_EQ(events.wait(next, milliseconds(0)).substr(0, 13), "event: resync");
    EXPECT_EQ(next, events.end());
}

TEST(Jobs, run_one_at_a_time_and_tell_their_result) {
    Events events;
    Jobs jobs(events);
    std::atomic<bool> go = false;
    ASSERT_TRUE(jobs.start("wait", [&](const Progress&) {
        while (!go) std::this_thread::yield();
        return Json(7);
    }));
    EXPECT_FALSE(jobs.start("other", [](const Progress&) { return Json(); }));
    go = true;
    jobs.wait();
    EXPECT_EQ(jobs.status()["state"], "done");
    EXPECT_EQ(jobs.status()["result"], 7);
    EXPECT_TRUE(jobs.start("other", [](const Progress&) { return Json(); }));
}

TEST(Jobs, are_cancelled_through_their_progress) {
    Events events;
    Jobs jobs(events);
    ASSERT_TRUE(jobs.start("endless", [](const Progress& progress) {
        while (progress(0.5, "turning")) std::this_thread::yield();
        return Json("not looked at");
    }));
    jobs.cancel();
    jobs.wait();
    EXPECT_EQ(jobs.status()["state"], "cancelled");
    EXPECT_FALSE(jobs.status().contains("result"));
}

TEST(Jobs, tell_what_went_wrong) {
    Events events;
    Jobs jobs(events);
    ASSERT_TRUE(jobs.start(
        "bad", [](const Progress&) -> Json { throw Error(ErrorKind::computation, "markers lie on one line"); }));
    jobs.wait();
    EXPECT_EQ(jobs.status()["state"], "failed");
    EXPECT_EQ(jobs.status()["error"], "markers lie on one line");
}

TEST(Tabs, let_the_first_edit_until_it_goes_or_another_takes_over) {
    Tabs tabs;
    EXPECT_EQ(tabs.editor(), "");
    tabs.join("a");
    tabs.join("b");
    EXPECT_EQ(tabs.editor(), "a");
    tabs.take_over("b");
    EXPECT_EQ(tabs.editor(), "b");
    tabs.leave("b");
    EXPECT_EQ(tabs.editor(), "a");
}

} // namespace
} // namespace meshtween::studio
