#include "jobs.h"

#include "meshtween/core/error.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <new>

namespace meshtween::studio {

Jobs::~Jobs() {
    cancel();
    wait();
}

bool Jobs::start(const std::string& kind, Work work) {
    const std::lock_guard starting(starting_);
    if (running_.exchange(true)) return false;
    if (thread_.joinable()) thread_.join(); // it has ended: running_ was false
    cancel_ = false;
    tell({{"kind", kind}, {"state", "running"}, {"fraction", 0}, {"stage", "starting"}});
    thread_ = std::thread([this, kind, work = std::move(work)] { run(kind, work); });
    return true;
}

void Jobs::run(const std::string& kind, const Work& work) {
    using Clock = std::chrono::steady_clock;
    auto last = Clock::now();
    std::string last_stage;
    const Progress progress = [&](double fraction, std::string_view stage) {
        const auto now = Clock::now();
        if (now - last > std::chrono::milliseconds(50) ||
            (stage != last_stage && now - last > std::chrono::milliseconds(5))) {
            tell({{"kind", kind}, {"state", "running"}, {"fraction", fraction}, {"stage", stage}});
            last = now;
            last_stage = stage;
        }
        return !cancel_;
    };
    Json end{{"kind", kind}, {"state", "done"}};
    try {
        Json result = work(progress);
        if (cancel_)
            end["state"] = "cancelled";
        else
            end["result"] = std::move(result);
    } catch (const std::bad_alloc&) {
        end["state"] = "failed";
        end["error"] = "out of memory; use smaller meshes or a larger machine";
    } catch (const Error& error) {
        end["state"] = "failed";
        end["error"] = error.what();
    } catch (const std::exception& error) { // what it says is for the terminal
        fmt::print(stderr, "{}: {}\n", kind, error.what());
        end["state"] = "failed";
        end["error"] =
            "something went wrong that this program did not expect; what was there before is still there, and "
            "the program's terminal says more";
    }
    running_ = false;
    tell(std::move(end));
}

void Jobs::tell(Json status) {
    {
        const std::lock_guard lock(mutex_);
        status_ = status;
    }
    events_.publish("job", status); // last: whoever hears of it and asks must be told the same
}

void Jobs::cancel() {
    cancel_ = true;
}

void Jobs::wait() {
    const std::lock_guard starting(starting_);
    if (thread_.joinable()) thread_.join();
}

bool Jobs::running() const {
    return running_;
}

Json Jobs::status() const {
    const std::lock_guard lock(mutex_);
    return status_;
}

} // namespace meshtween::studio
