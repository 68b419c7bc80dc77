// What the server tells the page while it works: a short memory of messages that any number of streams read.
#pragma once

#include <nlohmann/json.hpp>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>

namespace meshtween::studio {

using Json = nlohmann::ordered_json;

class Events {
public:
    void publish(std::string_view name, const Json& data);

    // The messages from number `next` on, as text of server-sent events with their numbers as ids, waiting up to
    // `longest` for one; moves `next` behind them. A reader that fell too far behind gets one message "resync" instead
    // of what it missed. Empty where nothing came.
    std::string wait(std::uint64_t& next, std::chrono::milliseconds longest);
    std::uint64_t end() const; // the number that the next message will get

    void close(); // wakes all readers, from now on wait() returns at once
    bool closed() const;

private:
    mutable std::mutex mutex_;
    std::condition_variable arrived_;
    std::deque<std::string> messages_;
    std::uint64_t first_ = 0; // number of messages_.front()
    bool closed_ = false;
};

} // namespace meshtween::studio
