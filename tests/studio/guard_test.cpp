#include "guard.h"

#include <gtest/gtest.h>

namespace meshtween::studio {
namespace {

const Guard guard{"0123456789abcdef0123456789abcdef", 4711};

Asked right() {
    return {"/" + guard.token + "/api/state", "127.0.0.1:4711", "", ""};
}

TEST(Guard, admits_the_page_that_it_served) {
    EXPECT_EQ(guard.admitted_path(right()), "/api/state");
    Asked named = right();
    named.host = "localhost:4711", named.origin = "http://localhost:4711", named.fetch_site = "same-origin";
    EXPECT_EQ(guard.admitted_path(named), "/api/state");
    Asked page = right();
    page.path = "/" + guard.token + "/", page.fetch_site = "none";
    EXPECT_EQ(guard.admitted_path(page), "/");
}

TEST(Guard, refuses_a_wrong_or_missing_token) {
    for (const std::string path : {"", "/", "/api/state", "//api/state", "/0123456789abcdef0123456789abcdeF/api/state",
                                   "/0123456789abcdef0123456789abcdef", "0123456789abcdef0123456789abcdef/api/state"}) {
        Asked asked = right();
        asked.path = path;
        EXPECT_EQ(guard.admitted_path(asked), "") << path;
    }
    EXPECT_EQ(Guard{}.admitted_path({"//", "127.0.0.1:0", "", ""}), "") << "no token admits nobody";
}

TEST(Guard, refuses_rebound_names_and_foreign_pages) {
    for (const std::string host :
         {"", "127.0.0.1", "evil.example:4711", "127.0.0.1:4712", "127.0.0.1:4711.evil.example"}) {
        Asked asked = right();
        asked.host = host;
        EXPECT_EQ(guard.admitted_path(asked), "") << host;
    }
    for (const std::string origin :
         {"null", "https://127.0.0.1:4711", "http://evil.example", "http://localhost:4711"}) {
        Asked asked = right();
        asked.origin = origin;
        EXPECT_EQ(guard.admitted_path(asked), "") << origin << ": not the Host that was asked";
    }
    for (const std::string site : {"cross-site", "same-site", "anything"}) {
        Asked asked = right();
        asked.fetch_site = site;
        EXPECT_EQ(guard.admitted_path(asked), "") << site;
    }
}

TEST(Guard, makes_tokens_that_differ) {
    EXPECT_EQ(random_token().size(), 32U);
    EXPECT_NE(random_token(), random_token());
}

} // namespace
} // namespace meshtween::studio
