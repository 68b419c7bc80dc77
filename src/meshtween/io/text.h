// A text file as lines and words, with messages that name the line.
#pragma once

#include "meshtween/core/error.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace meshtween {

[[noreturn]] inline void bad_file(const std::filesystem::path& path, std::string_view what) {
    throw Error(ErrorKind::file, fmt::format("{}: {}", path.string(), what));
}

// A word of the file as a message can show it: short, and without control characters.
std::string shown(std::string_view word);

// "a", "a and b", "a, b and c".
std::string listed(const std::vector<std::string>& parts);

// "1 face", "12 faces".
std::string counted(std::size_t count, std::string_view noun);

// The file as UTF-8 with lines that end in \n: UTF-16 goes by its mark, what is neither is Latin-1, a lone \r ends a
// line.
std::string plain_text(std::string bytes);

// Reads all of `word` as a number; false where it is none. Too large becomes infinite, too small zero. Locale plays no
// part.
inline bool parse(std::string_view word, double& value) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range) value = std::strtod(std::string(word).c_str(), nullptr);
    return error != std::errc::invalid_argument && end == word.data() + word.size();
}

inline bool parse(std::string_view word, long long& value) {
    if (!word.empty() && word.front() == '+') word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc() && end == word.data() + word.size();
}

class Text {
public:
    // `first_line` is the number of the line that `bytes` begins with.
    Text(std::string_view bytes, std::filesystem::path path, long first_line = 1)
        : next_(bytes.data()), end_(bytes.data() + bytes.size()), number_(first_line - 1), path_(std::move(path)) {
        if (bytes.substr(0, 3) == "\xEF\xBB\xBF") next_ += 3; // the mark that some editors put before UTF-8
    }

    // Goes to the next line; false at the end of the file. Lines end in a newline, a carriage return or both.
    bool next_line() {
        if (next_ >= end_) return false;
        if (next_ > newline_ || newline_ == nullptr) newline_ = find(next_, end_, '\n');
        begin_ = word_ = next_;
        line_end_ = find(next_, newline_, '\r');
        next_ = line_end_ + (line_end_ + 1 == newline_ ? 2 : 1);
        ++number_;
        return true;
    }

    // A line that ends in a backslash goes on in the next, unless a statement of its own begins there: some writers put
    // a backslash behind the last number too. The words read before stay read. Tells whether it did.
    bool join_lines() {
        const char* end = line_end_;
        while (ends_in_backslash() && next_ < end_ && !next_begins_with_letter()) {
            const char *begin = begin_, *word = word_;
            next_line();
            begin_ = begin, word_ = word;
        }
        return line_end_ != end;
    }

    // What follows this character in the line is passed over. Tells whether it is there.
    bool cut_at(char c) {
        const char* end = std::exchange(line_end_, find(word_, line_end_, c));
        return line_end_ != end;
    }

    // What is left of the line, without the blanks around it.
    std::string_view rest() const {
        const char *begin = word_, *end = line_end_;
        while (begin < end && is_blank(*begin)) ++begin;
        while (begin < end && is_blank(end[-1])) --end;
        return {begin, static_cast<std::size_t>(end - begin)};
    }

    // The next word of the line; empty at its end.
    std::string_view word() {
        while (word_ < line_end_ && is_space(*word_)) ++word_;
        const char* begin = word_;
        while (word_ < line_end_ && !is_space(*word_)) ++word_;
        return {begin, static_cast<std::size_t>(word_ - begin)};
    }

    // The next word of the line, backslashes included.
    std::string_view word_between_blanks() {
        while (word_ < line_end_ && is_blank(*word_)) ++word_;
        const char* begin = word_;
        while (word_ < line_end_ && !is_blank(*word_)) ++word_;
        return {begin, static_cast<std::size_t>(word_ - begin)};
    }

    // The next word of the line, which stays the next.
    std::string_view peek() {
        const char* here = word_;
        const std::string_view found = word();
        word_ = here;
        return found;
    }

    // The next word of the file, over the ends of lines; empty at the end of the file.
    std::string_view word_anywhere() {
        while (true) {
            if (const std::string_view found = word(); !found.empty()) return found;
            if (!next_line()) return {};
        }
    }

    // The next word of the file, which stays the next.
    std::string_view peek_anywhere() {
        const std::string_view found = word_anywhere();
        if (!found.empty()) word_ = found.data();
        return found;
    }

    // The next word of the line as a finite number. `what` names it in messages: "x".
    double finite(std::string_view what) { return finite_from(word(), what); }

    double finite_from(std::string_view found, std::string_view what) const {
        double value = 0;
        if (!parse(found, value)) missing(found, what);
        if (!std::isfinite(value))
            fail(fmt::format("{} is {}, which is not a finite number; mend the coordinates or export the model again",
                             what, shown(found)));
        return value;
    }

    long long integer(std::string_view what) { return integer_from(word(), what); }

    long long integer_from(std::string_view found, std::string_view what) const {
        long long value = 0;
        if (!parse(found, value)) missing(found, what);
        return value;
    }

    std::string_view line() const { return {begin_, static_cast<std::size_t>(line_end_ - begin_)}; }
    long line_number() const { return number_; }
    const char* position() const { return next_ < end_ ? next_ : end_; } // where the next line begins
    const std::filesystem::path& path() const { return path_; }

    [[noreturn]] void fail(std::string_view what) const { fail_at(number_, what); }
    [[noreturn]] void fail_at(long number, std::string_view what) const {
        bad_file(path_, fmt::format("line {}: {}", number, what));
    }

private:
    // Joined lines keep their backslash and newline inside; no number holds one.
    static bool is_space(char c) { return is_blank(c) || c == '\\'; }
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }

    static const char* find(const char* begin, const char* end, char c) {
        const void* found = begin < end ? std::memchr(begin, c, static_cast<std::size_t>(end - begin)) : nullptr;
        return found != nullptr ? static_cast<const char*>(found) : end;
    }

    bool ends_in_backslash() const {
        const char* last = line_end_;
        while (last > begin_ && is_blank(last[-1])) --last;
        return last > begin_ && last[-1] == '\\';
    }

    bool next_begins_with_letter() const {
        const char* next = next_;
        while (next < end_ && (*next == ' ' || *next == '\t')) ++next;
        return next < end_ && ((*next >= 'a' && *next <= 'z') || (*next >= 'A' && *next <= 'Z'));
    }

    [[noreturn]] void missing(std::string_view found, std::string_view what) const {
        if (found.empty())
            fail(fmt::format("{} is missing; the file is truncated or damaged, export the model again", what));
        fail(fmt::format("{} should be a number, not '{}'", what, shown(found)));
    }

    const char *next_, *end_;
    const char *begin_ = nullptr, *word_ = nullptr, *line_end_ = nullptr;
    const char* newline_ = nullptr; // the next from where the line begins, or the end
    long number_;
    std::filesystem::path path_;
};

} // namespace meshtween
