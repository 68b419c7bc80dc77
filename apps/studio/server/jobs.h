// Long work: one piece at a time, on a thread of its own, told of and stopped through events.
#pragma once

#include "events.h"

#include "meshtween/core/progress.h"

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace meshtween::studio {

class Jobs {
public:
    // Does the work and returns what the page is told at the end; may throw. Where progress said to stop, the return
    // value is not looked at.
    using Work = std::function<Json(const Progress&)>;

    explicit Jobs(Events& events) : events_(events) {}
    ~Jobs(); // cancels and waits

    // False where another job is running. Publishes "job" messages {kind, state, fraction, stage, ...}: state is
    // running, done (with "result"), cancelled or failed (with "error").
    bool start(const std::string& kind, Work work);
    void cancel();
    void wait(); // until no job runs
    bool running() const;
    Json status() const; // the last message

private:
    void run(const std::string& kind, const Work& work);
    void tell(Json status);

    Events& events_;
    mutable std::mutex mutex_;
    std::mutex starting_; // held while a thread is joined and the next one made
    std::thread thread_;
    std::atomic<bool> cancel_ = false, running_ = false;
    Json status_ = Json::object();
};

} // namespace meshtween::studio
