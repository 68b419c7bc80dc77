// Lengths of texts after vtkDataReader.cxx, where the upper two bits of the first byte tell how many bytes count.
#include "meshtween/io/vtk_words.h"

#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <limits>

namespace meshtween {
namespace {

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

} // namespace

std::string upper_case(std::string_view word) {
    std::string result(word);
    for (char& c : result) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
}

std::string decoded_vtk_name(std::string_view name) {
    std::string result;
    for (std::size_t i = 0; i < name.size(); ++i) {
        unsigned value = 0;
        if (name[i] == '%' && i + 2 < name.size() &&
            std::from_chars(name.data() + i + 1, name.data() + i + 3, value, 16).ptr == name.data() + i + 3) {
            result += static_cast<char>(value);
            i += 2;
        } else {
            result += name[i];
        }
    }
    return result;
}

VtkType vtk_type_named(std::string_view word) {
    static constexpr std::array<std::pair<std::string_view, VtkType>, 18> names{
        {{"BIT", VtkType::bit},
         {"CHAR", VtkType::int8},
         {"SIGNED_CHAR", VtkType::int8},
         {"UNSIGNED_CHAR", VtkType::uint8},
         {"SHORT", VtkType::int16},
         {"UNSIGNED_SHORT", VtkType::uint16},
         {"INT", VtkType::int32},
         {"UNSIGNED_INT", VtkType::uint32},
         {"LONG", VtkType::int64},
         {"UNSIGNED_LONG", VtkType::uint64},
         {"VTKTYPEINT64", VtkType::int64},
         {"VTKTYPEUINT64", VtkType::uint64},
         {"VTKIDTYPE", VtkType::int32}, // written as int for the sake of older readers
         {"FLOAT", VtkType::float32},
         {"DOUBLE", VtkType::float64},
         {"STRING", VtkType::text},
         {"UTF8_STRING", VtkType::text},
         {"VARIANT", VtkType::text}}};
    const std::string name = upper_case(word);
    for (const auto& [known, type] : names)
        if (known == name) return type;
    throw VtkDamage{fmt::format("'{}' is no type of numbers that VTK has", shown(word))};
}

std::string VtkWords::place() const {
    if (!ascii) return fmt::format("byte {}", at_);
    const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(std::min(word_, bytes_.size()));
    return fmt::format("line {}", 1 + std::count(bytes_.begin(), end, '\n'));
}

std::string_view VtkWords::next_word() {
    while (at_ < bytes_.size() && is_space(bytes_[at_])) ++at_;
    word_ = at_;
    while (at_ < bytes_.size() && !is_space(bytes_[at_])) ++at_;
    return bytes_.substr(word_, at_ - word_);
}

// What is left of the line; the next line begins behind it.
std::string_view VtkWords::rest_of_line() {
    const std::size_t begin = at_, newline = std::min(bytes_.find('\n', at_), bytes_.size());
    at_ = std::min(newline + 1, bytes_.size());
    return bytes_.substr(begin, newline - begin);
}

std::uint64_t VtkWords::count(std::string_view what) {
    const std::string_view word = next_word();
    long long value = 0;
    if (word.empty()) throw VtkDamage{fmt::format("{} is missing; the file is truncated", what)};
    if (!parse(word, value) || value < 0)
        throw VtkDamage{fmt::format("{} should be a count, not '{}'", what, shown(word))};
    return static_cast<std::uint64_t>(value);
}

// Throws where the file cannot hold so many numbers.
void VtkWords::require_room(VtkType type, std::uint64_t numbers, std::string_view what) const {
    const std::uint64_t left = bytes_.size() - at_;
    const std::uint64_t room = ascii || type == VtkType::text ? left / 2 + 1
                               : type == VtkType::bit         ? left * 8
                                                              : left / size_of(type);
    if (numbers > room)
        throw VtkDamage{fmt::format("the header promises {} numbers for {}, but only {} bytes are left; the file is "
                                    "truncated or damaged",
                                    numbers, what, left)};
}

std::uint64_t VtkWords::product(std::uint64_t a, std::uint64_t b, std::string_view what) const {
    if (a != 0 && b > bytes_.size() * 8 / a + 1)
        throw VtkDamage{fmt::format("the header promises {} times {} numbers for {}, but the file has {} bytes; it is "
                                    "truncated or damaged",
                                    a, b, what, bytes_.size())};
    return a * b;
}

// The size of a long is that of the machine that wrote it: what follows the numbers tells.
std::size_t VtkWords::bytes_a_number(VtkType type, std::string_view name, std::uint64_t numbers) const {
    const std::string known = upper_case(name);
    if (known != "LONG" && known != "UNSIGNED_LONG") return size_of(type);
    const auto ends_well = [&](std::size_t size) {
        const std::uint64_t end = at_ + size * numbers;
        return end == bytes_.size() || (end < bytes_.size() && bytes_[end] == '\n');
    };
    return !ends_well(8) && ends_well(4) ? 4 : 8;
}

void VtkWords::skip_strings(std::uint64_t numbers) {
    for (std::uint64_t i = 0; i < numbers; ++i) {
        if (ascii) {
            rest_of_line();
            continue;
        }
        if (at_ >= bytes_.size()) throw VtkDamage{"a text is missing; the file is truncated"};
        const auto first = static_cast<unsigned char>(bytes_[at_]);
        const std::size_t wide = std::array<std::size_t, 4>{8, 4, 2, 1}[first >> 6];
        std::uint64_t length = first & 0x3FU;
        for (std::size_t k = 1; k < wide && at_ + k < bytes_.size(); ++k)
            length = length << 8 | static_cast<unsigned char>(bytes_[at_ + k]);
        if (length > bytes_.size() - at_ || at_ + wide + length > bytes_.size())
            throw VtkDamage{"a text ends behind the end of the file, which is truncated"};
        at_ += wide + length;
    }
}

// The numbers from here; `values` empty-handed where nobody needs them. The line of their header has been read.
VtkBlock VtkWords::numbers(std::string_view type_name, std::uint64_t total, std::string_view what,
                           std::vector<double>* values) {
    const VtkType type = vtk_type_named(type_name);
    require_room(type, total, what);
    VtkBlock block{at_, at_, type, type_name};
    if (values != nullptr) values->reserve(total);
    if (type == VtkType::text)
        skip_strings(total);
    else if (ascii)
        words_as_numbers(total, what, values);
    else if (type == VtkType::bit)
        at_ += (total + 7) / 8;
    else
        bytes_as_numbers(type, bytes_a_number(type, type_name, total), total, what, values);
    block.end = at_;
    return block;
}

void VtkWords::words_as_numbers(std::uint64_t total, std::string_view what, std::vector<double>* values) {
    for (std::uint64_t i = 0; i < total; ++i) {
        const std::string_view word = next_word();
        if (word.empty())
            throw VtkDamage{
                fmt::format("the file ends after {} of the {} numbers of {}; it is truncated", i, total, what)};
        if (values == nullptr) continue;
        double value = std::numeric_limits<double>::quiet_NaN(); // 1.#QNAN and the like
        const bool number = parse(word, value);
        if (!number && std::isalpha(static_cast<unsigned char>(word[0])) != 0 && upper_case(word).substr(0, 3) != "NAN")
            throw VtkDamage{fmt::format("'{}' should be one of the {} numbers of {}", shown(word), total, what)};
        values->push_back(value);
    }
}

void VtkWords::bytes_as_numbers(VtkType type, std::size_t size, std::uint64_t total, std::string_view what,
                                std::vector<double>* values) {
    if (total * size > bytes_.size() - at_)
        throw VtkDamage{fmt::format("the file ends before the {} numbers of {} do; it is truncated", total, what)};
    if (values != nullptr) {
        const VtkType kind = size == 4 && type == VtkType::int64    ? VtkType::int32
                             : size == 4 && type == VtkType::uint64 ? VtkType::uint32
                                                                    : type;
        for (std::uint64_t i = 0; i < total; ++i) {
            std::array<char, 8> raw{};
            std::memcpy(raw.data(), bytes_.data() + at_ + i * size, size);
            std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(size));
            values->push_back(number_at(raw.data(), kind));
        }
    }
    at_ += total * size;
}

} // namespace meshtween
