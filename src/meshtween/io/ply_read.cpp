// The PLY polygon file format, Greg Turk, Stanford 1994: every element and property that is not wanted is read over.
#include "meshtween/io/companions.h"
#include "meshtween/io/formats.h"
#include "meshtween/io/ply.h"
#include "meshtween/io/ply_numbers.h"
#include "meshtween/io/ply_slots.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace meshtween {
namespace {

template <typename Numbers>
class PlyReader {
public:
    PlyReader(Numbers numbers, std::filesystem::path path, PlyPlaces* places)
        : numbers_(std::move(numbers)), path_(std::move(path)), places_(places) {}

    PolygonMesh read(const PlyHeader& header) {
        for (const PlyElement& element : header.elements) {
            if (element.name == "vertex")
                read_vertices(element);
            else if (element.name == "face")
                read_faces(element, header);
            else if (element.name == "tristrips")
                read_strips(element);
            else if (!element.properties.empty())
                for (std::uint64_t i = 0; i < element.count; ++i) {
                    numbers_.begin_element();
                    for (const PlyProperty& property : element.properties) skip(element, i, property);
                }
        }
        if (const std::string more = numbers_.surplus(); !more.empty())
            mesh_.file.notes.push_back(
                fmt::format("{} behind what the header promises: passed over; the file may be damaged", more));
        if (short_faces_ > 0)
            mesh_.file.notes.push_back(fmt::format(
                "{} fewer than three corners, first face {} (counted from 0): "
                "passed over",
                short_faces_ == 1 ? "1 face has" : fmt::format("{} faces have", short_faces_), first_short_face_));
        finish_attributes();
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
        for (std::uint64_t i = 0; i < count; ++i) numbers_.pass(property.type);
    }

    void read_vertices(const PlyElement& element);
    void read_vertex(const PlyElement& element, std::uint64_t number, const Slots& slots);
    void read_faces(const PlyElement& element, const PlyHeader& header);
    void end_face(std::uint64_t face);
    void read_strips(const PlyElement& element);
    void read_corners(const PlyElement& element, std::uint64_t face, const PlyProperty& property);
    void read_face_texcoords(const PlyElement& element, std::uint64_t face, const PlyProperty& property);
    int vertex_number(const PlyElement& element, std::uint64_t number, double index) const;
    void finish_attributes();

    Numbers numbers_;
    std::filesystem::path path_;
    PlyPlaces* places_;
    PolygonMesh mesh_;
    std::array<double, slot_none + 1> row_{};
    std::array<const char*, slot_none + 1> row_places_{};
    bool colored_ = false, textured_ = false, curved_ = false;
    std::size_t face_begin_ = 0; // the first corner of the face that is read
    std::size_t short_faces_ = 0;
    std::uint64_t first_short_face_ = 0;
    std::vector<double> normals_;         // x y z a vertex
    std::vector<float> wedges_;           // u v a corner, from the faces
    std::vector<float> vertex_texcoords_; // u v a vertex
};

// Whole numbers run to 255 or, where they are wide, to 65535; of some writers' wide ones only to 255.
void scale_colors(std::vector<float>& colors, const PlyElement& element, const Slots& slots) {
    const bool wide = std::any_of(colors.begin(), colors.end(), [](float c) { return c > 255; });
    for (std::size_t p = 0; p < slots.of.size(); ++p) {
        const Slot slot = slots.of[p];
        const PlyType type = element.properties[p].type;
        if (slot < slot_red || slot > slot_alpha || (type != PlyType::uint8 && type != PlyType::uint16)) continue;
        const float most = wide && type == PlyType::uint16 ? 65535 : 255;
        for (std::size_t i = slot - slot_red; i < colors.size(); i += 4) colors[i] /= most;
    }
}

template <typename Numbers>
void PlyReader<Numbers>::read_vertices(const PlyElement& element) {
    const Slots slots(element);
    if (!slots.has_all({slot_x, slot_y, slot_z})) bad_file(path_, "its vertices have no x, y and z");
    colored_ = slots.has_all({slot_red, slot_green, slot_blue});
    textured_ = slots.has_all({slot_u, slot_v});
    curved_ = slots.has_all({slot_nx, slot_ny, slot_nz});
    const auto count = static_cast<std::size_t>(element.count);
    mesh_.coordinates.reserve(3 * count);
    if (colored_) mesh_.colors.reserve(4 * count);
    if (textured_) vertex_texcoords_.reserve(2 * count);
    if (curved_) normals_.reserve(3 * count);
    row_[slot_alpha] = 1;
    for (std::uint64_t i = 0; i < element.count; ++i) read_vertex(element, i, slots);
    if (colored_) scale_colors(mesh_.colors, element, slots);
    normalise_colors(mesh_.colors);
}

template <typename Numbers>
void PlyReader<Numbers>::read_vertex(const PlyElement& element, std::uint64_t number, const Slots& slots) {
    numbers_.begin_element();
    for (std::size_t p = 0; p < slots.of.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        const Slot slot = slots.of[p];
        if (places_ != nullptr) row_places_[slot] = numbers_.here();
        if (slot == slot_none)
            skip(element, number, property);
        else
            row_[slot] = slot <= slot_z ? numbers_.next(property.type) : numbers_.next_attribute(property.type);
    }
    for (const Slot slot : {slot_x, slot_y, slot_z}) {
        if (!std::isfinite(row_[slot]))
            numbers_.fail(element, number,
                          fmt::format("{} is {}, which is not a finite number; mend the coordinates or export the "
                                      "model again",
                                      "xyz"[slot], row_[slot]));
        mesh_.coordinates.push_back(row_[slot]);
    }
    const auto finite = [](double value) { return std::isfinite(value) ? value : 0; };
    if (colored_)
        for (const Slot slot : {slot_red, slot_green, slot_blue, slot_alpha})
            mesh_.colors.push_back(static_cast<float>(row_[slot]));
    if (textured_)
        for (const Slot slot : {slot_u, slot_v}) vertex_texcoords_.push_back(static_cast<float>(finite(row_[slot])));
    if (curved_)
        for (const Slot slot : {slot_nx, slot_ny, slot_nz}) normals_.push_back(finite(row_[slot]));
    if (places_ == nullptr) return;
    for (const Slot slot : {slot_x, slot_y, slot_z}) places_->positions.push_back(row_places_[slot]);
    if (curved_)
        for (const Slot slot : {slot_nx, slot_ny, slot_nz}) places_->normals.push_back(row_places_[slot]);
}

template <typename Numbers>
int PlyReader<Numbers>::vertex_number(const PlyElement& element, std::uint64_t number, double index) const {
    if (!(index >= 0 && index < std::numeric_limits<int>::max()) || index != std::floor(index))
        numbers_.fail(element, number, fmt::format("{} is no vertex's number; the file is damaged", index));
    return static_cast<int>(index);
}

template <typename Numbers>
void PlyReader<Numbers>::read_corners(const PlyElement& element, std::uint64_t face, const PlyProperty& property) {
    for (std::uint64_t left = list_length(element, face, property); left > 0; --left)
        mesh_.corners.push_back(vertex_number(element, face, numbers_.next(property.type)));
}

template <typename Numbers>
void PlyReader<Numbers>::read_faces(const PlyElement& element, const PlyHeader& header) {
    const bool strips = std::any_of(header.elements.begin(), header.elements.end(),
                                    [](const PlyElement& other) { return other.name == "tristrips"; });
    if (std::count_if(element.properties.begin(), element.properties.end(), is_corner_list) != 1 && !strips)
        bad_file(path_, "its faces have no list 'vertex_indices'; export the model again");
    const Slots slots(element);
    const bool textured = !header.textures.empty(), curved = slots.has_all({slot_nx, slot_ny, slot_nz});
    mesh_.ends.reserve(static_cast<std::size_t>(element.count));
    mesh_.corners.reserve(static_cast<std::size_t>(element.count) * 3);
    for (std::uint64_t face = 0; face < element.count; ++face) {
        face_begin_ = mesh_.corners.size();
        double texture = 0;
        numbers_.begin_element();
        for (std::size_t p = 0; p < slots.of.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (places_ != nullptr) row_places_[slots.of[p]] = numbers_.here();
            if (is_corner_list(property))
                read_corners(element, face, property);
            else if (property.is_list && property.name == "texcoord")
                read_face_texcoords(element, face, property);
            else if (!property.is_list && property.name == "texnumber")
                texture = numbers_.next_attribute(property.type);
            else
                skip(element, face, property);
        }
        end_face(face);
        if (mesh_.corners.size() == face_begin_) continue;
        if (textured) {
            const bool known = texture >= 0 && texture < static_cast<double>(header.textures.size());
            mesh_.file.polygon_materials.push_back(known ? static_cast<int>(texture) : -1);
        }
        if (places_ != nullptr && curved)
            for (const Slot slot : {slot_nx, slot_ny, slot_nz}) places_->face_normals.push_back(row_places_[slot]);
    }
}

// A face of fewer than three corners is no part of the surface.
template <typename Numbers>
void PlyReader<Numbers>::end_face(std::uint64_t face) {
    if (mesh_.corners.size() >= face_begin_ + 3) return mesh_.end_polygon();
    if (short_faces_++ == 0) first_short_face_ = face;
    mesh_.corners.resize(face_begin_);
    wedges_.resize(std::min(wedges_.size(), 2 * face_begin_));
}

// Each corner makes a triangle with the two before it, every other one turned over; -1 begins a new strip. Triangles
// that name a vertex twice only lead from one part of a strip to the next.
template <typename Numbers>
void PlyReader<Numbers>::read_strips(const PlyElement& element) {
    for (std::uint64_t strip = 0; strip < element.count; ++strip) {
        numbers_.begin_element();
        for (const PlyProperty& property : element.properties) {
            if (!is_corner_list(property)) {
                skip(element, strip, property);
                continue;
            }
            std::array<int, 2> before{-1, -1};
            bool turned = false;
            for (std::uint64_t left = list_length(element, strip, property); left > 0; --left) {
                const double index = numbers_.next(property.type);
                const bool restart = index == -1 || index == std::numeric_limits<std::uint32_t>::max();
                const int vertex = restart ? -1 : vertex_number(element, strip, index);
                const auto [a, b] = before;
                if (a >= 0 && vertex >= 0 && a != b && b != vertex && a != vertex) {
                    mesh_.corners.insert(mesh_.corners.end(), {turned ? b : a, turned ? a : b, vertex});
                    mesh_.end_polygon();
                }
                turned = a >= 0 && vertex >= 0 ? !turned : false;
                before = vertex < 0 ? std::array{-1, -1} : std::array{b, vertex};
            }
        }
    }
}

// MeshLab's way: u v for each corner of the face.
template <typename Numbers>
void PlyReader<Numbers>::read_face_texcoords(const PlyElement& element, std::uint64_t face,
                                             const PlyProperty& property) {
    wedges_.resize(2 * face_begin_, 0);
    for (std::uint64_t left = list_length(element, face, property); left > 0; --left) {
        const double value = numbers_.next_attribute(property.type);
        wedges_.push_back(std::isfinite(value) ? static_cast<float>(value) : 0);
    }
}

template <typename Numbers>
void PlyReader<Numbers>::finish_attributes() {
    if (!mesh_.file.polygon_materials.empty()) mesh_.file.polygon_materials.resize(mesh_.ends.size(), -1);
    if (!wedges_.empty()) { // corners of one vertex with the same values share a texture coordinate
        wedges_.resize(2 * mesh_.corners.size(), 0);
        share_texcoords(mesh_, wedges_);
    } else if (!vertex_texcoords_.empty()) {
        mesh_.texcoords = std::move(vertex_texcoords_);
        mesh_.texcoord_corners = mesh_.corners;
    }
    if (normals_.empty()) return;
    mesh_.file.normals = Eigen::Map<const Points>(normals_.data(), static_cast<Eigen::Index>(normals_.size() / 3), 3);
    mesh_.file.normal_corners = mesh_.corners;
}

PolygonMesh read_text(std::string_view bytes, const std::filesystem::path& path, const PlyHeader& header,
                      PlyPlaces* places, bool by_lines) {
    if (places != nullptr) *places = {};
    return PlyReader(AsciiNumbers(bytes, path, header, by_lines), path, places).read(header);
}

// What nobody here understands, by name.
void tell_customs(MeshFile& file, const PlyHeader& header) {
    std::vector<std::string> properties;
    for (const PlyElement& element : header.elements) {
        const bool vertex = element.name == "vertex", face = element.name == "face";
        if (!vertex && !face) {
            if (element.count > 0 && element.name != "tristrips")
                file.only_here.push_back(fmt::format("the element '{}'", shown(element.name)));
            continue;
        }
        for (const PlyProperty& property : element.properties) {
            const bool known = vertex ? !property.is_list && slot_named(property.name) != slot_none
                                      : is_corner_list(property) || property.name == "texcoord" ||
                                            property.name == "texnumber" || property.name == "nx" ||
                                            property.name == "ny" || property.name == "nz";
            if (!known) properties.push_back(shown(property.name));
        }
    }
    if (properties.size() == 1) file.only_here.push_back(fmt::format("the property '{}'", properties[0]));
    if (properties.size() > 1)
        file.only_here.push_back(fmt::format("the {} properties {}", properties.size(), listed(properties)));
}

// A material for each picture.
void add_textures(MeshFile& file, const PlyHeader& header, const std::filesystem::path& folder) {
    for (const std::string& name : header.textures) {
        const std::filesystem::path found = find_companion(folder, name);
        if (found.empty()) file.notes.push_back(fmt::format("there is no picture {}, which it names", name));
        Material& material = file.materials.emplace_back();
        material.name = std::filesystem::path(name).stem().string();
        if (found.empty()) continue;
        material.base_color_image = static_cast<int>(file.images.size());
        file.images.push_back({name, {}, {}, found});
    }
}

} // namespace

// An element a line, or, where that cannot be read, words without regard to lines.
PolygonMesh read_ply_body(std::string_view bytes, const std::filesystem::path& path, const PlyHeader& header,
                          PlyPlaces* places) {
    if (header.encoding != PlyEncoding::ascii)
        return PlyReader(BinaryNumbers(bytes, path, header), path, places).read(header);
    std::optional<Error> by_lines;
    try {
        return read_text(bytes, path, header, places, true);
    } catch (const RaggedLines&) {
    } catch (const Error& error) {
        by_lines = error;
    }
    try {
        return read_text(bytes, path, header, places, false);
    } catch (const Error&) {
        if (by_lines) throw *by_lines;
        throw;
    }
}

PolygonMesh read_ply(std::string_view bytes, const std::filesystem::path& path) {
    const PlyHeader header = read_ply_header(bytes, path);
    PolygonMesh mesh = read_ply_body(bytes, path, header);
    tell_customs(mesh.file, header);
    add_textures(mesh.file, header, path.parent_path());
    return mesh;
}

} // namespace meshtween
