// XML File Formats, in "VTK File Formats", The VTK User's Guide, Kitware 2010; blocks and headers after
// vtkXMLDataParser.cxx: a length, or with compression the number of blocks, the size of each but the last, that of the
// last where it is smaller, and each block's compressed size.
#include "meshtween/io/base64.h"
#include "meshtween/io/text.h"
#include "meshtween/io/vtp.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace meshtween {
namespace {

constexpr std::size_t block_size = 32768; // as VTK writes them
constexpr std::uint64_t longest_text = 1 << 20;
constexpr std::uint64_t most_expansion = 1040; // zlib shrinks nothing more than 1032 times

void reverse_each(std::string& bytes, std::size_t size) {
    for (std::size_t i = 0; i + size <= bytes.size(); i += size)
        std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(i),
                     bytes.begin() + static_cast<std::ptrdiff_t>(i + size));
}

// An array's place in the file and how it is written there.
struct Stored {
    const VtpFile& file;
    std::string_view data;
    bool base64, appended;
    std::string what;

    std::size_t number_size, expected; // of the array: bytes of a number, how many there should be or any_count

    [[noreturn]] void fail(std::string_view why) const { bad_file(file.path, fmt::format("{}: {}", what, why)); }

    [[noreturn]] void fail_count(std::uint64_t count) const {
        if (expected == any_count) fail(fmt::format("is a text of {} letters, too long", count));
        fail(fmt::format("holds {} numbers, but {} are promised; the file is truncated or damaged", count, expected));
    }

    // The first `size` bytes.
    std::string first(std::uint64_t size) const {
        if (size > data.size())
            fail(fmt::format("its header promises {} bytes, but only {} are left; the file is truncated or damaged",
                             size, data.size()));
        if (!base64) return std::string(data.substr(0, size));
        std::optional<std::string> bytes = from_base64(data, size);
        if (!bytes) fail("holds letters that are not base64; the file is damaged");
        if (bytes->size() < size)
            fail(fmt::format("its header promises {} bytes, but there are {}; the file is truncated or damaged", size,
                             bytes->size()));
        return std::move(*bytes);
    }

    std::vector<std::uint64_t> header(std::size_t numbers) const {
        const std::size_t size = file.encoding.header_size;
        std::string bytes = first(numbers * size);
        if (file.encoding.big_endian) reverse_each(bytes, size);
        std::vector<std::uint64_t> values(numbers, 0);
        for (std::size_t i = 0; i < numbers; ++i) std::memcpy(&values[i], bytes.data() + i * size, size);
        return values;
    }
};

// Arrays lie one after the other: a file that names the same bytes for many is refused before they fill the memory.
void count_read(const Stored& stored, std::uint64_t bytes) {
    if (!stored.appended) return;
    stored.file.read += bytes;
    if (stored.file.read > 2 * stored.file.appended.size())
        stored.fail("the arrays of the appended data lie over one another; the file is damaged");
}

std::string inflated(const Stored& stored) {
    const std::size_t size = stored.file.encoding.header_size;
    const std::uint64_t blocks = stored.header(1)[0];
    if (blocks == 0) return {};
    if (blocks > stored.data.size())
        stored.fail(
            fmt::format("promises {} compressed blocks in {} bytes; the file is damaged", blocks, stored.data.size()));
    const std::vector<std::uint64_t> header = stored.header(3 + blocks);
    std::uint64_t packed = (3 + blocks) * size;
    for (std::size_t i = 3; i < header.size(); ++i) {
        if (header[i] > stored.data.size())
            stored.fail(
                fmt::format("promises a block of {} bytes in {}; the file is damaged", header[i], stored.data.size()));
        packed += header[i];
    }
    std::uint64_t whole = 0;
    for (std::size_t i = 0; i < blocks; ++i) {
        const std::uint64_t block = i + 1 == blocks && header[2] != 0 ? header[2] : header[1];
        if (block > most_expansion * packed - whole)
            stored.fail("its blocks promise more than they can hold; the file is damaged");
        whole += block;
    }
    if (stored.expected == any_count ? whole > longest_text : whole / stored.number_size != stored.expected)
        stored.fail_count(whole / stored.number_size);
    count_read(stored, packed);
    const std::string bytes = stored.first(packed);
    std::string result;
    std::size_t at = (3 + blocks) * size;
    for (std::size_t i = 0; i < blocks; ++i) {
        uLongf got = i + 1 == blocks && header[2] != 0 ? header[2] : header[1];
        const uLongf wanted = got;
        result.resize(result.size() + wanted);
        char* to = result.data() + result.size() - wanted;
        const int status = uncompress(reinterpret_cast<Bytef*>(to), &got,
                                      reinterpret_cast<const Bytef*>(bytes.data() + at), header[3 + i]);
        if (status != Z_OK || got != wanted)
            stored.fail(
                fmt::format("compressed block {} of {} is damaged or not of the size that its header says", i, blocks));
        at += header[3 + i];
    }
    return result;
}

std::string stored_bytes(const Stored& stored) {
    if (stored.file.encoding.compressed) return inflated(stored);
    const std::uint64_t size = stored.header(1)[0];
    if (size > stored.data.size())
        stored.fail(fmt::format("its header promises {} bytes, but only {} are left; the file is truncated or damaged",
                                size, stored.data.size()));
    count_read(stored, size);
    return stored.first(stored.file.encoding.header_size + size).substr(stored.file.encoding.header_size);
}

std::vector<double> text_numbers(const VtpFile& file, std::string_view text, std::string_view what) {
    std::vector<double> values;
    Text words(text, file.path);
    for (std::string_view word = words.word_anywhere(); !word.empty(); word = words.word_anywhere()) {
        double value = std::numeric_limits<double>::quiet_NaN(); // 1.#QNAN and the like
        if (!parse(word, value) && std::isalpha(static_cast<unsigned char>(word[0])) != 0 && word != "nan" &&
            word != "NaN")
            bad_file(file.path, fmt::format("{}: '{}' should be a number", what, shown(word)));
        values.push_back(value);
    }
    return values;
}

} // namespace

VtkType vtp_type_named(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, VtkType>, 11> names{{{"Int8", VtkType::int8},
                                                                                 {"UInt8", VtkType::uint8},
                                                                                 {"Int16", VtkType::int16},
                                                                                 {"UInt16", VtkType::uint16},
                                                                                 {"Int32", VtkType::int32},
                                                                                 {"UInt32", VtkType::uint32},
                                                                                 {"Int64", VtkType::int64},
                                                                                 {"UInt64", VtkType::uint64},
                                                                                 {"Float32", VtkType::float32},
                                                                                 {"Float64", VtkType::float64},
                                                                                 {"String", VtkType::text}}};
    for (const auto& [known, type] : names)
        if (known == name) return type;
    return VtkType::unknown;
}

VtkType vtp_type(pugi::xml_node array) {
    return vtp_type_named(array.attribute("type").value());
}

int vtp_components(pugi::xml_node array) {
    return std::clamp(array.attribute("NumberOfComponents").as_int(1), 0, 1 << 20);
}

pugi::xml_node vtp_array(pugi::xml_node parent, const char* name) {
    return parent.find_child_by_attribute("DataArray", "Name", name);
}

std::vector<double> vtp_numbers(const VtpFile& file, pugi::xml_node array, std::string_view what,
                                std::size_t expected) {
    const std::string_view format = array.attribute("format").as_string("ascii");
    std::vector<double> values;
    if (format == "ascii") {
        values = text_numbers(file, array.child_value(), what);
    } else if (format == "binary" || format == "appended") {
        const VtkType type = vtp_type(array) == VtkType::text ? VtkType::int8 : vtp_type(array);
        const std::size_t size = size_of(type);
        if (size == 0)
            bad_file(file.path,
                     fmt::format("{}: '{}' is no type of numbers", what, shown(array.attribute("type").value())));
        Stored stored{file, array.child_value(), true, false, std::string(what), size, expected};
        if (format == "appended") {
            const unsigned long long offset = array.attribute("offset").as_ullong();
            if (offset >= file.appended.size())
                stored.fail(
                    fmt::format("begins at byte {} of the appended data, which have {}; the file is truncated or "
                                "damaged",
                                offset, file.appended.size()));
            stored.data = file.appended.substr(offset);
            stored.base64 = file.appended_base64;
            stored.appended = true;
        }
        std::string bytes = stored_bytes(stored);
        if (file.encoding.big_endian) reverse_each(bytes, size);
        values.reserve(bytes.size() / size);
        for (std::size_t at = 0; at + size <= bytes.size(); at += size)
            values.push_back(number_at(bytes.data() + at, type));
    } else {
        bad_file(file.path, fmt::format("{}: '{}' should be ascii, binary or appended", what, shown(format)));
    }
    if (expected != any_count && values.size() != expected)
        bad_file(file.path, fmt::format("{}: holds {} numbers, but {} are promised; the file is truncated or damaged",
                                        what, values.size(), expected));
    return values;
}

std::string vtp_encoded(const std::string& little_endian_bytes, VtkType type, const VtpEncoding& encoding,
                        bool base64) {
    std::string bytes = little_endian_bytes;
    if (encoding.big_endian) reverse_each(bytes, size_of(type));
    const auto number = [&](std::uint64_t value) {
        std::string word(reinterpret_cast<const char*>(&value), encoding.header_size);
        if (encoding.big_endian) std::reverse(word.begin(), word.end());
        return word;
    };
    if (!encoding.compressed) {
        bytes.insert(0, number(bytes.size()));
        return base64 ? to_base64(bytes) : bytes;
    }
    const std::size_t blocks = (bytes.size() + block_size - 1) / block_size;
    std::string header = number(blocks) + number(block_size) + number(bytes.size() % block_size), packed;
    for (std::size_t i = 0; i < blocks; ++i) {
        const std::string_view block = std::string_view(bytes).substr(i * block_size, block_size);
        uLongf size = compressBound(block.size());
        const std::size_t before = packed.size();
        packed.resize(before + size);
        compress(reinterpret_cast<Bytef*>(packed.data() + before), &size, reinterpret_cast<const Bytef*>(block.data()),
                 block.size());
        packed.resize(before + size);
        header += number(size);
    }
    return base64 ? to_base64(header) + to_base64(packed) : header + packed;
}

} // namespace meshtween
