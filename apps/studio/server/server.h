// The studio's HTTP server: routes, what every request must show, and the stream of events.
#pragma once

#include "events.h"
#include "guard.h"
#include "session.h"
#include "tabs.h"

#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace httplib {
class Server;
struct Request;
struct Response;
} // namespace httplib

namespace meshtween::studio {

// An answer, and a question as handlers see it.
struct Reply {
    std::string body, type = "application/json";
    std::string download; // the name to save it under; empty to show it
};
struct Question {
    std::map<std::string, std::string> parameters; // the first value of each
    std::string body;
    const std::string& at(const std::string& name) const; // throws Error(argument) where it is missing
    Json json() const;                                    // of the body; throws Error(argument)
};
struct Route {
    std::function<Reply(const Question&)> run;
    std::size_t most_bytes = 0; // of the body
    bool edits = false;         // only for the page that edits
};
using Routes = std::map<std::string, Route>; // "GET /api/state"

Routes routes(Session& session, Tabs& tabs, Events& events, std::size_t most_upload);

class Server {
public:
    // Binds to 127.0.0.1 at once; port 0 takes a free one. Throws Error(argument) where the port is taken.
    Server(Session& session, Events& events, int port, std::size_t most_upload);
    ~Server(); // stops
    const Guard& guard() const { return guard_; }
    void listen(); // until stop()
    void stop();   // from any thread

private:
    void wire();
    void answer(const httplib::Request& request, httplib::Response& response, std::string body) const;
    void stream_events(const httplib::Request& request, httplib::Response& response);

    Events& events_;
    Tabs tabs_;
    Guard guard_;
    Routes routes_;
    std::atomic<int> streams_ = 0;
    std::unique_ptr<httplib::Server> http_;
};

} // namespace meshtween::studio
