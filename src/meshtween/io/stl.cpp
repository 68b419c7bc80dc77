// STL, text and binary. It has no vertices, only corners: those at equal coordinates become one vertex, in order of
// first appearance.
#include "meshtween/io/formats.h"
#include "meshtween/io/output.h"
#include "meshtween/io/text.h"

#include "meshtween/geometry/measure.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace meshtween {
namespace {

static_assert(std::endian::native == std::endian::little, "read and written as memory has it");
constexpr std::size_t header_size = 80, facet_size = 50;

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
PolygonMesh read_binary(std::string_view bytes, const std::filesystem::path& path, std::size_t count) {
    PolygonMesh mesh;
    Welder welder(mesh);
    mesh.corners.reserve(3 * count);
    for (std::size_t facet = 0; facet < count; ++facet) {
        std::array<float, 9> values;
        std::memcpy(values.data(), bytes.data() + header_size + 4 + facet * facet_size + 12, sizeof values);
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
    }
    return mesh;
}

PolygonMesh read_text(std::string_view bytes, const std::filesystem::path& path) {
    PolygonMesh mesh;
    Welder welder(mesh);
    Text text(bytes, path);
    bool in_solid = false;
    std::size_t begin = 0; // the first corner of the facet
    while (text.next_line()) {
        const std::string_view keyword = text.word();
        if (keyword == "vertex") {
            const double x = text.finite("x"), y = text.finite("y"), z = text.finite("z");
            mesh.corners.push_back(welder.vertex({x, y, z}));
        } else if (keyword == "endfacet") {
            if (mesh.corners.size() < begin + 3)
                text.fail(fmt::format("the facet has {} corners, it needs three; the file is damaged",
                                      mesh.corners.size() - begin));
            mesh.end_polygon();
            begin = mesh.corners.size();
        } else if (keyword == "solid") {
            in_solid = true;
        } else if (keyword == "endsolid") {
            in_solid = false;
        } else if (!keyword.empty() && keyword != "facet" && keyword != "outer" && keyword != "endloop") {
            text.fail(
                fmt::format("'{}' is no STL statement; the file is damaged or of another format", shown(keyword)));
        }
    }
    if (in_solid || begin != mesh.corners.size()) text.fail("'endsolid' is missing at the end; the file is truncated");
    return mesh;
}

} // namespace

PolygonMesh read_stl(std::string_view bytes, const std::filesystem::path& path) {
    std::uint32_t count = 0;
    const bool has_count = bytes.size() >= header_size + 4;
    if (has_count) std::memcpy(&count, bytes.data() + header_size, sizeof count);
    const std::uint64_t expected = header_size + 4 + facet_size * std::uint64_t{count};
    // Some binary files begin with "solid" too: their length tells.
    if (has_count && expected == bytes.size()) return read_binary(bytes, path, count);
    std::string_view start = bytes.substr(0, 512);
    start.remove_prefix(std::min(start.find_first_not_of(" \t\r\n\xEF\xBB\xBF"), start.size()));
    if (start.substr(0, 5) == "solid" && start.find('\0') == std::string_view::npos) return read_text(bytes, path);
    if (has_count && expected < bytes.size()) return read_binary(bytes, path, count);
    if (!has_count) bad_file(path, "is too short for an STL file; it is truncated or of another format");
    bad_file(path,
             fmt::format("promises {} facets, which take {} bytes, but the file has {}; it is truncated or damaged",
                         count, expected, bytes.size()));
}

namespace {

void write_new(const Mesh& mesh, std::ostream& stream) {
    std::string header = "binary STL, written by meshtween";
    header.resize(header_size, '\0');
    const auto count = static_cast<std::uint32_t>(mesh.triangles.rows());
    stream << header;
    stream.write(reinterpret_cast<const char*>(&count), sizeof count);
    const Points normals = triangle_normals(mesh.positions, mesh.triangles);
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
        std::array<float, 12> values;
        for (Eigen::Index c = 0; c < 3; ++c) {
            values[static_cast<std::size_t>(c)] = static_cast<float>(normals(t, c));
            for (Eigen::Index k = 0; k < 3; ++k)
                values[static_cast<std::size_t>(3 + 3 * k + c)] =
                    static_cast<float>(mesh.positions(mesh.triangles(t, k), c));
        }
        std::array<char, facet_size> raw{};
        std::memcpy(raw.data(), values.data(), sizeof values);
        stream.write(raw.data(), raw.size());
    }
}

} // namespace

std::vector<std::string> write_stl(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions&) {
    write_whole(path, [&](std::ostream& stream) { write_new(mesh, stream); });
    return {};
}

} // namespace meshtween
