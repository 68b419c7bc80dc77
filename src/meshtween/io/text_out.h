// Formatted text to a stream, a large piece at a time. Numbers are the shortest that read back as the same bits.
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <ostream>

namespace meshtween {

class TextOut {
public:
    explicit TextOut(std::ostream& stream) : stream_(stream) {}
    TextOut(const TextOut&) = delete;
    TextOut& operator=(const TextOut&) = delete;
    ~TextOut() { flush(); }

    template <typename... Arguments>
    void put(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
        fmt::format_to(std::back_inserter(buffer_), format, std::forward<Arguments>(arguments)...);
        if (buffer_.size() > piece) flush();
    }

private:
    static constexpr std::size_t piece = 1 << 16;
    void flush() {
        stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
        buffer_.clear();
    }

    std::ostream& stream_;
    fmt::memory_buffer buffer_;
};

} // namespace meshtween
