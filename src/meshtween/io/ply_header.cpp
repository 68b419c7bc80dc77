// The PLY polygon file format, Greg Turk, Stanford 1994.
#include "meshtween/io/ply.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace meshtween {
namespace {

PlyType type_named(std::string_view name, const Text& text) {
    static constexpr std::array<std::pair<std::string_view, PlyType>, 16> types{{{"char", PlyType::int8},
                                                                                 {"int8", PlyType::int8},
                                                                                 {"uchar", PlyType::uint8},
                                                                                 {"uint8", PlyType::uint8},
                                                                                 {"short", PlyType::int16},
                                                                                 {"int16", PlyType::int16},
                                                                                 {"ushort", PlyType::uint16},
                                                                                 {"uint16", PlyType::uint16},
                                                                                 {"int", PlyType::int32},
                                                                                 {"int32", PlyType::int32},
                                                                                 {"uint", PlyType::uint32},
                                                                                 {"uint32", PlyType::uint32},
                                                                                 {"float", PlyType::float32},
                                                                                 {"float32", PlyType::float32},
                                                                                 {"double", PlyType::float64},
                                                                                 {"float64", PlyType::float64}}};
    for (const auto& [known, type] : types)
        if (known == name) return type;
    text.fail(fmt::format("'{}' is no PLY type; the header is damaged", shown(name)));
}

PlyEncoding read_encoding(Text& text) {
    const std::string_view name = text.word();
    if (name == "ascii") return PlyEncoding::ascii;
    if (name == "binary_little_endian") return PlyEncoding::little_endian;
    if (name == "binary_big_endian") return PlyEncoding::big_endian;
    text.fail(fmt::format("'{}' is no PLY format; ascii, binary_little_endian and binary_big_endian are", shown(name)));
}

PlyElement read_element(Text& text) {
    PlyElement element;
    element.name = text.word();
    const long long count = text.integer("the number of elements");
    if (count < 0 || count > std::numeric_limits<int>::max())
        text.fail(fmt::format("{} elements '{}' are more than can be held, or the header is damaged", count,
                              shown(element.name)));
    element.count = static_cast<std::uint64_t>(count);
    return element;
}

PlyProperty read_property(Text& text) {
    PlyProperty property;
    std::string_view word = text.word();
    property.is_list = word == "list";
    if (property.is_list) {
        property.count_type = type_named(text.word(), text);
        if (property.count_type == PlyType::float32 || property.count_type == PlyType::float64)
            text.fail("a list's length must have a whole-number type; the header is damaged");
        word = text.word();
    }
    property.type = type_named(word, text);
    property.name = text.word();
    return property;
}

// The least number of bytes that one element takes.
std::uint64_t least_size(const PlyElement& element, PlyEncoding encoding) {
    std::uint64_t size = 0;
    for (const PlyProperty& property : element.properties)
        size += encoding == PlyEncoding::ascii ? 2 : size_of(property.is_list ? property.count_type : property.type);
    return size;
}

void refuse_empty_promises(const PlyHeader& header, std::size_t file_size, const std::filesystem::path& path) {
    std::uint64_t least = 0;
    for (const PlyElement& element : header.elements) {
        least += element.count * least_size(element, header.encoding);
        if (least > file_size - header.size + 1)
            bad_file(path,
                     fmt::format("the header promises {} elements '{}', which take at least {} bytes, but only {} "
                                 "follow it; the file is truncated or damaged",
                                 element.count, element.name, least, file_size - header.size));
    }
}

} // namespace

std::size_t size_of(PlyType type) {
    static constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}

PlyHeader read_ply_header(std::string_view bytes, const std::filesystem::path& path) {
    Text text(bytes, path);
    if (!text.next_line() || text.word() != "ply")
        text.fail("a PLY file begins with 'ply'; this is damaged or of another format");
    // A carriage return alone ends all lines or none: the data may begin with a newline's byte.
    const char* first = text.position();
    const bool returns = first > bytes.data() && first[-1] == '\r';
    PlyHeader header;
    bool encoded = false;
    while (text.next_line()) {
        const std::string_view keyword = text.word();
        if (keyword == "end_header") {
            if (!encoded) text.fail("the header names no format; the file is damaged");
            const char* end = returns ? keyword.data() + keyword.size() + 1 : text.position();
            header.size = std::min(static_cast<std::size_t>(end - bytes.data()), bytes.size());
            header.lines = text.line_number();
            refuse_empty_promises(header, bytes.size(), path);
            return header;
        }
        if (keyword == "comment" && text.peek() == "TextureFile") {
            text.word();
            header.textures.emplace_back(text.rest());
        } else if (keyword == "format") {
            header.encoding = read_encoding(text);
            encoded = true;
        } else if (keyword == "element") {
            PlyElement element = read_element(text);
            for (const PlyElement& other : header.elements)
                if (other.name == element.name)
                    text.fail(fmt::format("element '{}' comes twice; the header is damaged", shown(element.name)));
            header.elements.push_back(std::move(element));
        } else if (keyword == "property") {
            if (header.elements.empty()) text.fail("a property comes before any element; the header is damaged");
            header.elements.back().properties.push_back(read_property(text));
        } else if (!keyword.empty() && keyword != "comment" && keyword != "obj_info") {
            text.fail(fmt::format("'{}' is no PLY header line; the file is damaged", shown(keyword)));
        }
    }
    text.fail("the header has no end; the file is truncated");
}

} // namespace meshtween
