#include "events.h"

#include <fmt/format.h>

namespace meshtween::studio {
namespace {
constexpr std::size_t memory = 256; // messages
}

void Events::publish(std::string_view name, const Json& data) {
    {
        const std::lock_guard lock(mutex_);
        messages_.push_back(fmt::format("id: {}\nevent: {}\ndata: {}\n\n", first_ + messages_.size(), name,
                                        data.dump(-1, ' ', false, Json::error_handler_t::replace)));
        if (messages_.size() > memory) {
            messages_.pop_front();
            ++first_;
        }
    }
    arrived_.notify_all();
}

std::string Events::wait(std::uint64_t& next, std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, longest, [&] { return closed_ || first_ + messages_.size() > next; });
    std::string text;
    if (next < first_) {
        text = "event: resync\ndata: {}\n\n";
        next = first_ + messages_.size();
    }
    for (; next < first_ + messages_.size(); ++next) text += messages_[static_cast<std::size_t>(next - first_)];
    return text;
}

std::uint64_t Events::end() const {
    const std::lock_guard lock(mutex_);
    return first_ + messages_.size();
}

void Events::close() {
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
    }
    arrived_.notify_all();
}

bool Events::closed() const {
    const std::lock_guard lock(mutex_);
    return closed_;
}

} // namespace meshtween::studio
