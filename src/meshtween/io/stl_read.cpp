// STL, text and binary. It has no vertices, only corners: those at equal coordinates become one vertex, in order of
// first appearance.
#include "meshtween/io/formats.h"
#include "meshtween/io/stl.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace meshtween {
namespace {

static_assert(std::endian::native == std::endian::little, "read as memory has it");

// Numbers for places: a table of open addressing over the mesh's own coordinates.
class Welder {
public:
    explicit Welder(PolygonMesh& mesh) : mesh_(mesh), table_(1024, -1) {}

    int vertex(std::array<double, 3> place) {
        for (double& c : place) c += 0.0; // -0 becomes 0
        std::vector<double>& all = mesh_.coordinates;
        if (all.size() / 3 * 2 >= table_.size()) grow();
        for (std::size_t slot = slot_of(place);; slot = (slot + 1) & (table_.size() - 1)) {
            if (table_[slot] < 0) {
                table_[slot] = static_cast<int>(all.size() / 3);
                all.insert(all.end(), place.begin(), place.end());
                return table_[slot];
            }
            if (std::memcmp(&all[3 * static_cast<std::size_t>(table_[slot])], place.data(), sizeof place) == 0)
                return table_[slot];
        }
    }

private:
    std::size_t slot_of(const std::array<double, 3>& place) const {
        std::uint64_t hash = 0;
        for (const double c : place) {
            hash = (hash ^ std::bit_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15U;
            hash ^= hash >> 29;
        }
        return hash & (table_.size() - 1);
    }
    void grow() {
        table_.assign(4 * table_.size(), -1);
        for (std::size_t v = 0; v < mesh_.coordinates.size() / 3; ++v) {
            std::size_t slot =
                slot_of({mesh_.coordinates[3 * v], mesh_.coordinates[3 * v + 1], mesh_.coordinates[3 * v + 2]});
            while (table_[slot] >= 0) slot = (slot + 1) & (table_.size() - 1);
            table_[slot] = static_cast<int>(v);
        }
    }

    PolygonMesh& mesh_;
    std::vector<int> table_;
};

// 80 bytes, a count, and for each facet a normal, three corners (floats) and two bytes.
PolygonMesh read_binary(std::string_view bytes, const std::filesystem::path& path, const StlLayout& layout) {
    PolygonMesh mesh;
    Welder welder(mesh);
    mesh.corners.reserve(3 * layout.facets);
    const char* here = bytes.data() + stl_header_size + 4;
    bool attributes = false;
    for (std::size_t facet = 0; facet < layout.facets; ++facet) {
        std::array<float, 9> values;
        std::memcpy(values.data(), here + 12, sizeof values);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::array<double, 3> place{values[3 * k], values[3 * k + 1], values[3 * k + 2]};
            for (const double c : place)
                if (!std::isfinite(c))
                    bad_file(path, fmt::format("facet {} (counted from 0): a coordinate is {}, which is not a finite "
                                               "number; mend the model or export it again",
                                               facet, c));
            mesh.corners.push_back(welder.vertex(place));
        }
        mesh.end_polygon();
        attributes = attributes || here[48] != 0 || here[49] != 0;
        here += stl_facet_length(here, layout.payloads);
    }
    if (attributes) mesh.file.only_here.emplace_back("attributes of facets");
    if (layout.facets != layout.promised)
        mesh.file.notes.push_back(fmt::format("the header promises {}, but the file holds {}: all are read",
                                              counted(layout.promised, "facet"), layout.facets));
    if (layout.surplus > 0)
        mesh.file.notes.push_back(
            fmt::format("{} behind the last facet: passed over", counted(layout.surplus, "byte")));
    return mesh;
}

PolygonMesh read_text(std::string_view bytes, const std::filesystem::path& path) {
    PolygonMesh mesh;
    Welder welder(mesh);
    Text text(bytes, path);
    bool in_solid = false;
    std::size_t begin = 0; // the first corner of the facet
    while (text.next_line()) {
        switch (stl_word(text)) {
        case StlWord::vertex: {
            const double x = text.finite("x"), y = text.finite("y"), z = text.finite("z");
            mesh.corners.push_back(welder.vertex({x, y, z}));
            break;
        }
        case StlWord::end_facet:
            if (mesh.corners.size() < begin + 3)
                text.fail(fmt::format("the facet has {} corners, it needs three; the file is damaged",
                                      mesh.corners.size() - begin));
            mesh.end_polygon();
            begin = mesh.corners.size();
            break;
        case StlWord::solid:
            in_solid = true;
            break;
        case StlWord::end_solid:
            in_solid = false;
            break;
        case StlWord::other:
            text.fail(
                fmt::format("'{}' is no STL statement; the file is damaged or of another format", shown(text.line())));
        default:
            break;
        }
    }
    if (in_solid || begin != mesh.corners.size()) text.fail("'endsolid' is missing at the end; the file is truncated");
    return mesh;
}

char lower(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

// In any case.
bool is(std::string_view word, std::string_view keyword) {
    return std::ranges::equal(word, keyword, [](char a, char b) { return lower(a) == b; });
}

// Some binary files begin with "solid" too: text goes on with a facet or an end.
bool looks_like_text(std::string_view bytes) {
    std::string start(bytes.substr(0, 4096));
    std::ranges::transform(start, start.begin(), lower);
    const std::size_t word = start.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (word == std::string::npos || start.compare(word, 5, "solid") != 0) return false;
    if (start.find('\0') != std::string::npos) return false;
    return start.find("facet", word) != std::string::npos || start.find("end", word) != std::string::npos ||
           bytes.size() > start.size();
}

// Whether facets with payloads fill the file to its end.
bool payloads_fit(std::string_view bytes, std::size_t count) {
    std::size_t at = stl_header_size + 4;
    for (std::size_t facet = 0; facet < count; ++facet) {
        if (bytes.size() - at < stl_facet_size) return false;
        at += stl_facet_length(bytes.data() + at, true);
        if (at > bytes.size()) return false;
    }
    return at == bytes.size();
}

} // namespace

std::size_t stl_facet_length(const char* facet, bool payloads) {
    std::uint16_t attribute = 0;
    if (payloads) std::memcpy(&attribute, facet + 48, sizeof attribute);
    return stl_facet_size + attribute;
}

StlLayout stl_layout(std::string_view bytes, const std::filesystem::path& path) {
    constexpr std::size_t begin = stl_header_size + 4;
    std::uint32_t count = 0;
    const bool has_count = bytes.size() >= begin;
    if (has_count) std::memcpy(&count, bytes.data() + stl_header_size, sizeof count);
    const std::uint64_t expected = begin + stl_facet_size * std::uint64_t{count};
    if (has_count && expected == bytes.size()) return {false, count, false, count, 0};
    if (looks_like_text(bytes)) return {.text = true};
    if (!has_count) bad_file(path, "is too short for an STL file; it is truncated or of another format");
    if (expected < bytes.size()) {
        const std::size_t rest = bytes.size() - begin;
        if (count > 0 && payloads_fit(bytes, count)) return {false, count, true, count, 0};
        if (rest % stl_facet_size == 0) return {false, rest / stl_facet_size, false, count, 0};
        const std::size_t surplus = bytes.size() - expected;
        const bool as_many_each = count > 3 && surplus % count == 0; // bytes behind every facet, and none that say so
        if (surplus < stl_facet_size && count > 0 && !as_many_each) return {false, count, false, count, surplus};
    } else if (bytes.size() > begin && (bytes.size() - begin) % stl_facet_size == 0) {
        return {false, (bytes.size() - begin) / stl_facet_size, false, count, 0};
    }
    bad_file(path,
             fmt::format("promises {} facets, which take {} bytes, but the file has {}; it is truncated or damaged",
                         count, expected, bytes.size()));
}

StlWord stl_word(Text& text) {
    std::string_view word = text.word();
    if (word.empty()) return StlWord::none;
    if (is(word, "vertex")) return StlWord::vertex;
    if (is(word, "facet")) return StlWord::facet;
    if (is(word, "outer") || is(word, "loop")) return StlWord::loop;
    if (is(word, "solid")) return StlWord::solid;
    if (word.size() < 3 || !is(word.substr(0, 3), "end")) return StlWord::other;
    word = word.size() == 3 ? text.word() : word.substr(3);
    if (is(word, "loop")) return StlWord::end_loop;
    if (is(word, "facet")) return StlWord::end_facet;
    return is(word, "solid") ? StlWord::end_solid : StlWord::other;
}

PolygonMesh read_stl(std::string_view bytes, const std::filesystem::path& path) {
    const StlLayout layout = stl_layout(bytes, path);
    return layout.text ? read_text(bytes, path) : read_binary(bytes, path, layout);
}

} // namespace meshtween
