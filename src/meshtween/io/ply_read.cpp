// The PLY polygon file format, Greg Turk, Stanford 1994: every element and property that is not wanted is read over.
#include "meshtween/io/formats.h"
#include "meshtween/io/ply.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace meshtween {
namespace {

// Numbers one after another, from text.
class AsciiNumbers {
public:
    AsciiNumbers(std::string_view data, const std::filesystem::path& path, const PlyHeader& header)
        : text_(data, path, header.lines + 1), end_(data.data() + data.size()) {}

    double next(PlyType) {
        const std::string_view word = text_.word_anywhere();
        double value = 0;
        if (word.empty()) text_.fail("the file ends too early; it is truncated");
        if (!parse(word, value)) text_.fail(fmt::format("'{}' should be a number", shown(word)));
        return value;
    }
    std::size_t left() const { return static_cast<std::size_t>(end_ - text_.position()) + text_.line().size() + 1; }
    [[noreturn]] void fail(const PlyElement&, std::uint64_t, std::string_view what) const { text_.fail(what); }

private:
    Text text_;
    const char* end_;
};

// Numbers one after another, as memory has them, in either byte order.
class BinaryNumbers {
public:
    BinaryNumbers(std::string_view data, std::filesystem::path path, const PlyHeader& header)
        : data_(data), path_(std::move(path)),
          swap_((header.encoding == PlyEncoding::little_endian) != (std::endian::native == std::endian::little)) {}

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
    std::size_t left() const { return data_.size() - at_; }
    [[noreturn]] void fail(const PlyElement& element, std::uint64_t number, std::string_view what) const {
        bad_file(path_, fmt::format("element '{}' {} (counted from 0): {}", element.name, number, what));
    }

private:
    template <typename Number>
    Number take() {
        if (left() < sizeof(Number)) bad_file(path_, "the file ends too early; it is truncated");
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

// What a vertex's property means. One name a meaning, as the writers in use have them.
enum Slot { slot_x, slot_y, slot_z, slot_red, slot_green, slot_blue, slot_alpha, slot_u, slot_v, slot_none };

Slot slot_named(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, Slot>, 20> names{{{"x", slot_x},
                                                                              {"y", slot_y},
                                                                              {"z", slot_z},
                                                                              {"red", slot_red},
                                                                              {"green", slot_green},
                                                                              {"blue", slot_blue},
                                                                              {"alpha", slot_alpha},
                                                                              {"r", slot_red},
                                                                              {"g", slot_green},
                                                                              {"b", slot_blue},
                                                                              {"a", slot_alpha},
                                                                              {"diffuse_red", slot_red},
                                                                              {"diffuse_green", slot_green},
                                                                              {"diffuse_blue", slot_blue},
                                                                              {"s", slot_u},
                                                                              {"t", slot_v},
                                                                              {"u", slot_u},
                                                                              {"v", slot_v},
                                                                              {"texture_u", slot_u},
                                                                              {"texture_v", slot_v}}};
    for (const auto& [known, slot] : names)
        if (known == name) return slot;
    return slot_none;
}

double color_scale(PlyType type) {
    return type == PlyType::uint8 ? 255 : type == PlyType::uint16 ? 65535 : 1;
}

template <typename Numbers>
class PlyReader {
public:
    PlyReader(Numbers numbers, std::filesystem::path path) : numbers_(std::move(numbers)), path_(std::move(path)) {}

    PolygonMesh read(const PlyHeader& header) {
        for (const PlyElement& element : header.elements) {
            if (element.name == "tristrips")
                bad_file(path_, "holds triangle strips, which are not read; save it again with single faces");
            if (element.name == "vertex")
                read_vertices(element);
            else if (element.name == "face")
                read_faces(element);
            else if (!element.properties.empty())
                for (std::uint64_t i = 0; i < element.count; ++i)
                    for (const PlyProperty& property : element.properties) skip(element, i, property);
        }
        finish_texcoords();
        return std::move(mesh_);
    }

private:
    std::uint64_t list_length(const PlyElement& element, std::uint64_t number, const PlyProperty& property) {
        const double length = numbers_.next(property.count_type);
        if (!(length >= 0) || length > static_cast<double>(numbers_.left()))
            numbers_.fail(element, number,
                          fmt::format("a list cannot have {} entries when {} bytes are left; the file is truncated or "
                                      "damaged",
                                      length, numbers_.left()));
        return static_cast<std::uint64_t>(length);
    }

    void skip(const PlyElement& element, std::uint64_t number, const PlyProperty& property) {
        const std::uint64_t count = property.is_list ? list_length(element, number, property) : 1;
        for (std::uint64_t i = 0; i < count; ++i) numbers_.next(property.type);
    }

    void read_vertices(const PlyElement& element);
    void read_faces(const PlyElement& element);
    void read_corners(const PlyElement& element, std::uint64_t face, const PlyProperty& property);
    void read_face_texcoords(const PlyElement& element, std::uint64_t face, const PlyProperty& property);
    void finish_texcoords();

    Numbers numbers_;
    std::filesystem::path path_;
    PolygonMesh mesh_;
    std::size_t face_begin_ = 0;          // the first corner of the face that is read
    std::vector<float> wedges_;           // u v a corner, from the faces
    std::vector<float> vertex_texcoords_; // u v a vertex
};

template <typename Numbers>
void PlyReader<Numbers>::read_vertices(const PlyElement& element) {
    std::vector<Slot> slots;
    std::array<bool, slot_none + 1> has{};
    std::array<double, slot_none + 1> scale;
    scale.fill(1);
    for (const PlyProperty& property : element.properties) {
        const Slot slot = property.is_list ? slot_none : slot_named(property.name);
        slots.push_back(slot);
        has[slot] = true;
        if (slot >= slot_red && slot <= slot_alpha) scale[slot] = color_scale(property.type);
    }
    if (!has[slot_x] || !has[slot_y] || !has[slot_z]) bad_file(path_, "its vertices have no x, y and z");
    const bool colored = has[slot_red] && has[slot_green] && has[slot_blue], textured = has[slot_u] && has[slot_v];
    const auto count = static_cast<std::size_t>(element.count);
    mesh_.coordinates.reserve(3 * count);
    if (colored) mesh_.colors.reserve(4 * count);
    if (textured) vertex_texcoords_.reserve(2 * count);
    std::array<double, slot_none + 1> row{};
    row[slot_alpha] = 1;
    for (std::uint64_t i = 0; i < element.count; ++i) {
        for (std::size_t p = 0; p < slots.size(); ++p)
            if (element.properties[p].is_list)
                skip(element, i, element.properties[p]);
            else
                row[slots[p]] = numbers_.next(element.properties[p].type) / scale[slots[p]];
        for (const Slot slot : {slot_x, slot_y, slot_z}) {
            if (!std::isfinite(row[slot]))
                numbers_.fail(element, i,
                              fmt::format("{} is {}, which is not a finite number; mend the coordinates or export the "
                                          "model again",
                                          "xyz"[slot], row[slot]));
            mesh_.coordinates.push_back(row[slot]);
        }
        if (colored)
            for (const Slot slot : {slot_red, slot_green, slot_blue, slot_alpha})
                mesh_.colors.push_back(static_cast<float>(row[slot]));
        if (textured)
            for (const Slot slot : {slot_u, slot_v}) vertex_texcoords_.push_back(static_cast<float>(row[slot]));
    }
    normalise_colors(mesh_.colors);
}

bool is_corner_list(const PlyProperty& property) {
    return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

template <typename Numbers>
void PlyReader<Numbers>::read_corners(const PlyElement& element, std::uint64_t face, const PlyProperty& property) {
    const std::uint64_t count = list_length(element, face, property);
    if (count < 3)
        numbers_.fail(element, face,
                      fmt::format("a face needs three corners, this has {}; the file is damaged", count));
    for (std::uint64_t i = 0; i < count; ++i) {
        const double index = numbers_.next(property.type);
        if (!(index >= 0 && index < std::numeric_limits<int>::max()) || index != std::floor(index))
            numbers_.fail(element, face, fmt::format("{} is no vertex's number; the file is damaged", index));
        mesh_.corners.push_back(static_cast<int>(index));
    }
    mesh_.end_polygon();
}

template <typename Numbers>
void PlyReader<Numbers>::read_faces(const PlyElement& element) {
    if (std::count_if(element.properties.begin(), element.properties.end(), is_corner_list) != 1)
        bad_file(path_, "its faces have no list 'vertex_indices'; export the model again");
    mesh_.ends.reserve(static_cast<std::size_t>(element.count));
    mesh_.corners.reserve(static_cast<std::size_t>(element.count) * 3);
    for (std::uint64_t face = 0; face < element.count; ++face) {
        face_begin_ = mesh_.corners.size();
        for (const PlyProperty& property : element.properties)
            if (is_corner_list(property))
                read_corners(element, face, property);
            else if (property.is_list && property.name == "texcoord")
                read_face_texcoords(element, face, property);
            else
                skip(element, face, property);
    }
}

// MeshLab's way: u v for each corner of the face.
template <typename Numbers>
void PlyReader<Numbers>::read_face_texcoords(const PlyElement& element, std::uint64_t face,
                                             const PlyProperty& property) {
    wedges_.resize(2 * face_begin_, 0);
    for (std::uint64_t left = list_length(element, face, property); left > 0; --left) {
        const double value = numbers_.next(property.type);
        wedges_.push_back(std::isfinite(value) ? static_cast<float>(value) : 0);
    }
}

template <typename Numbers>
void PlyReader<Numbers>::finish_texcoords() {
    if (!wedges_.empty()) { // corners of one vertex with the same values share a texture coordinate
        wedges_.resize(2 * mesh_.corners.size(), 0);
        share_texcoords(mesh_, wedges_);
    } else if (!vertex_texcoords_.empty()) {
        for (float& value : vertex_texcoords_)
            if (!std::isfinite(value)) value = 0;
        mesh_.texcoords = std::move(vertex_texcoords_);
        mesh_.texcoord_corners = mesh_.corners;
    }
}

template <typename Numbers>
PolygonMesh read_body(std::string_view bytes, const std::filesystem::path& path, const PlyHeader& header) {
    return PlyReader(Numbers(bytes.substr(header.size), path, header), path).read(header);
}

} // namespace

PolygonMesh read_ply(std::string_view bytes, const std::filesystem::path& path) {
    const PlyHeader header = read_ply_header(bytes, path);
    return header.encoding == PlyEncoding::ascii ? read_body<AsciiNumbers>(bytes, path, header)
                                                 : read_body<BinaryNumbers>(bytes, path, header);
}

} // namespace meshtween
