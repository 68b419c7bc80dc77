// A file's bytes with some of its words replaced, to a stream.
#pragma once

#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <iterator>
#include <ostream>
#include <string_view>
#include <type_traits>

namespace meshtween {

class Patch {
public:
    Patch(std::string_view bytes, std::ostream& stream)
        : from_(bytes.data()), end_(bytes.data() + bytes.size()), stream_(stream) {}
    Patch(const Patch&) = delete;
    Patch& operator=(const Patch&) = delete;

    // `word` is a part of the bytes, behind all that were replaced before.
    void replace(std::string_view word, std::string_view by) {
        keep_until(word.data());
        buffer_.append(by.data(), by.data() + by.size());
        from_ = word.data() + word.size();
    }
    // A word that reads as this number stays as it is.
    template <typename Number>
    requires std::is_arithmetic_v<Number>
    void replace(std::string_view word, Number value) {
        double old = 0;
        if (parse(word, old) && static_cast<Number>(old) == value) return;
        keep_until(word.data());
        fmt::format_to(std::back_inserter(buffer_), "{}", value);
        from_ = word.data() + word.size();
    }
    void finish() {
        keep_until(end_);
        flush();
    }

private:
    static constexpr std::size_t piece = 1 << 16;

    void keep_until(const char* here) {
        if (here - from_ > static_cast<std::ptrdiff_t>(piece)) {
            flush();
            stream_.write(from_, here - from_);
        } else {
            buffer_.append(from_, here);
            if (buffer_.size() > piece) flush();
        }
        from_ = here;
    }
    void flush() {
        stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
        buffer_.clear();
    }

    const char *from_, *end_;
    std::ostream& stream_;
    fmt::memory_buffer buffer_;
};

} // namespace meshtween
