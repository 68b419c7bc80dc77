// The numbers of a PLY file's body one after another, from text and as memory has them.
#pragma once

#include "meshtween/io/ply.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

namespace meshtween {

// Thrown where an element's words run out in its line.
struct RaggedLines {};

// Text: an element is a line, and what follows its last word there is passed over (MeshLab writes more words than its
// header names). Some files take lines as no more than blanks: those run on, and then nothing may be left over.
class AsciiNumbers {
public:
    AsciiNumbers(std::string_view bytes, const std::filesystem::path& path, const PlyHeader& header, bool by_lines)
        : text_(bytes.substr(header.size), path, header.lines + 1), end_(bytes.data() + bytes.size()),
          by_lines_(by_lines) {}

    void begin_element() {
        if (!by_lines_) return;
        do
            if (!text_.next_line()) throw RaggedLines{};
        while (text_.peek().empty());
    }
    // The next number; a word that is none ends the reading.
    double next(PlyType) {
        const std::string_view word = take();
        double value = 0;
        if (!parse(word, value)) text_.fail(fmt::format("'{}' should be a number", shown(word)));
        return value;
    }
    // The next number; a word that is none, such as 1.#QNAN, is not a number.
    double next_attribute(PlyType) {
        double value = 0;
        return parse(take(), value) ? value : std::numeric_limits<double>::quiet_NaN();
    }
    void pass(PlyType) { take(); }
    const char* here() { // where the next number begins
        if (by_lines_) return text_.peek().data();
        const std::string_view found = text_.peek_anywhere();
        return found.data();
    }
    std::size_t left() const { return static_cast<std::size_t>(end_ - text_.position()) + text_.line().size() + 1; }
    [[noreturn]] void fail(const PlyElement&, std::uint64_t, std::string_view what) const { text_.fail(what); }

    // What is behind the last element, in words for people; empty where nothing is.
    std::string surplus() {
        if (!by_lines_) {
            if (!text_.word_anywhere().empty())
                text_.fail("more words follow than the header names; the file is damaged");
            return {};
        }
        std::size_t lines = 0;
        while (text_.next_line()) lines += !text_.peek().empty();
        return lines == 0 ? std::string() : counted(lines, "line");
    }

private:
    std::string_view take() {
        const std::string_view word = by_lines_ ? text_.word() : text_.word_anywhere();
        if (!word.empty()) return word;
        if (by_lines_) throw RaggedLines{};
        text_.fail("the file ends too early; it is truncated");
    }

    Text text_;
    const char* end_;
    bool by_lines_;
};

// In either byte order.
class BinaryNumbers {
public:
    BinaryNumbers(std::string_view bytes, std::filesystem::path path, const PlyHeader& header)
        : data_(bytes.substr(header.size)), path_(std::move(path)),
          swap_((header.encoding == PlyEncoding::little_endian) != (std::endian::native == std::endian::little)) {}

    void begin_element() {}
    double next(PlyType type) {
        switch (type) {
        case PlyType::int8:
            return take<std::int8_t>();
        case PlyType::uint8:
            return take<std::uint8_t>();
        case PlyType::int16:
            return take<std::int16_t>();
        case PlyType::uint16:
            return take<std::uint16_t>();
        case PlyType::int32:
            return take<std::int32_t>();
        case PlyType::uint32:
            return take<std::uint32_t>();
        case PlyType::float32:
            return take<float>();
        default:
            return take<double>();
        }
    }
    double next_attribute(PlyType type) { return next(type); }
    void pass(PlyType type) {
        require(size_of(type));
        at_ += size_of(type);
    }
    const char* here() const { return data_.data() + at_; }
    std::size_t left() const { return data_.size() - at_; }
    [[noreturn]] void fail(const PlyElement& element, std::uint64_t number, std::string_view what) const {
        bad_file(path_, fmt::format("element '{}' {} (counted from 0): {}", element.name, number, what));
    }

    std::string surplus() const {
        const std::string_view rest = data_.substr(at_);
        const bool blank = rest.find_first_not_of(std::string_view(" \t\r\n\0", 5)) == std::string_view::npos;
        return blank ? std::string() : counted(rest.size(), "byte");
    }

private:
    void require(std::size_t size) const {
        if (left() < size) bad_file(path_, "the file ends too early; it is truncated");
    }
    template <typename Number>
    Number take() {
        require(sizeof(Number));
        std::array<char, sizeof(Number)> raw;
        std::memcpy(raw.data(), data_.data() + at_, sizeof(Number));
        if (swap_) std::reverse(raw.begin(), raw.end());
        at_ += sizeof(Number);
        return std::bit_cast<Number>(raw);
    }

    std::string_view data_;
    std::filesystem::path path_;
    bool swap_;
    std::size_t at_ = 0;
};

} // namespace meshtween
