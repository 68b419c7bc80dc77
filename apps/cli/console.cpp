#include "console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>

namespace {
std::atomic<bool> stop_wanted = false;
static_assert(std::atomic<bool>::is_always_lock_free); // or a signal handler may not touch it
} // namespace

void catch_interrupts() {
    const auto handler = [](int) {
        if (stop_wanted.exchange(true)) _exit(130); // asked twice: at once
    };
    std::signal(SIGINT, handler);
    std::signal(SIGTERM, handler);
}

bool interrupted() {
    return stop_wanted;
}

void stop_if_interrupted() {
    if (interrupted()) throw Interrupted{};
}

Console::Console(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1) {}

Console::~Console() {
    clear();
}

void Console::clear() {
    if (drawn_) fmt::print(stderr, "\r\033[K");
    drawn_ = false;
}

meshtween::Progress Console::progress() {
    using Clock = std::chrono::steady_clock;
    return [this, last = Clock::time_point{}](double fraction, std::string_view stage) mutable {
        const auto now = Clock::now();
        if (terminal_ && !quiet_ && now - last > std::chrono::milliseconds(80)) {
            constexpr int width = 30;
            const int full = static_cast<int>(fraction * width + 0.5);
            fmt::print(stderr, "\r\033[K[{:=<{}}{:<{}}] {:3.0f} % {}", "", full, "", width - full, 100 * fraction,
                       stage);
            std::fflush(stderr);
            last = now;
            drawn_ = true;
        }
        return !interrupted();
    };
}

void Console::note(const std::string& text) {
    if (quiet_) return;
    clear();
    fmt::print(stderr, "{}\n", text);
}

void Console::warn(const std::string& text) {
    clear();
    fmt::print(stderr, "meshtween: {}\n", text);
}

void Console::warn(const std::string& prefix, const std::vector<std::string>& texts) {
    for (const std::string& text : texts) warn(prefix + text);
}
