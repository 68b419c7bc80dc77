// Wavefront OBJ, after "Object Files (.obj)", Appendix B1 of the Advanced Visualizer manual; vertex colours behind the
// coordinates as MeshLab and ZBrush write them. Read here rather than by a library so that doubles stay doubles and a
// message can name the line.
#include "meshtween/io/formats.h"
#include "meshtween/io/material_library.h"
#include "meshtween/io/obj_statements.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <unordered_map>

namespace meshtween {
namespace {

// A name that holds for all polygons from here on.
class CurrentName {
public:
    void set(std::string_view name, std::size_t polygons) {
        if (name.empty()) {
            current_ = -1;
            return;
        }
        const auto [found, is_new] = numbers_.try_emplace(std::string(name), static_cast<int>(all.names.size()));
        if (is_new) all.names.emplace_back(name);
        current_ = found->second;
        all.of.resize(polygons, -1);
    }
    void end_polygon() {
        if (!all.names.empty()) all.of.push_back(current_);
    }
    PolygonNames all;

private:
    std::unordered_map<std::string, int> numbers_;
    int current_ = -1;
};

// What was passed over, and the line where it was first.
struct Passed {
    std::size_t count = 0;
    long line = 0;
    void add(const Text& text) {
        if (count++ == 0) line = text.line_number();
    }
};

class ObjReader {
public:
    ObjReader(std::string_view bytes, const std::filesystem::path& path) : text_(bytes, path) {}

    PolygonMesh read() {
        for (std::string_view keyword; next_statement(text_, keyword);)
            if (!keyword.empty()) statement(keyword);
        check_vertices();
        finish_corners(mesh_.texcoord_corners, mesh_.texcoords.size() / 2, texcoords_missing_, "texture coordinates");
        finish_corners(normal_corners_, normals_.size() / 3, normals_missing_, "normals");
        if (!mesh_.colors.empty()) mesh_.colors.resize(mesh_.coordinates.size() / 3 * 4, 1);
        normalise_colors(mesh_.colors);
        describe();
        return std::move(mesh_);
    }

private:
    void statement(std::string_view keyword) {
        if (keyword == "v") return vertex();
        if (keyword == "vt") return numbers(mesh_.texcoords, 2);
        if (keyword == "vn") return numbers(normals_, 3);
        if (keyword == "f" || keyword == "fo") return face();
        if (keyword == "g") return groups_.set(text_.rest(), mesh_.ends.size());
        if (keyword == "o") return objects_.set(text_.rest(), mesh_.ends.size());
        if (keyword == "s") return smoothing_.set(text_.rest(), mesh_.ends.size());
        if (keyword == "usemtl") return materials_.set(text_.rest(), mesh_.ends.size());
        if (keyword == "mtllib") {
            mesh_.file.material_libraries.emplace_back(text_.rest());
        } else if (keyword == "l" || keyword == "p") {
            ++wires_;
        } else if (keyword == "curv" || keyword == "curv2" || keyword == "surf") {
            ++freeforms_;
        } else if (std::isalpha(static_cast<unsigned char>(keyword[0])) == 0) {
            text_.fail(
                fmt::format("'{}' is no OBJ statement; the file is damaged or of another format", shown(keyword)));
        }
    }

    // v x y z, then nothing, a weight, or r g b [a]. A colour that is no number harms no shape: it becomes 0.
    void vertex() {
        for (const char* name : {"x", "y", "z"}) mesh_.coordinates.push_back(text_.finite(name));
        std::array<double, 4> more{0, 0, 0, 1};
        std::size_t count = 0;
        bool bad = false;
        for (std::string_view word = text_.word(); !word.empty() && count < 4; word = text_.word(), ++count)
            if (!parse(word, more[count]) || !std::isfinite(more[count])) {
                more[count] = 0;
                bad = true;
            }
        if (count < 3) return;
        if (bad) bad_colors_.add(text_);
        mesh_.colors.resize((mesh_.coordinates.size() / 3 - 1) * 4, 1); // white before the first that has one
        for (const double value : more) mesh_.colors.push_back(static_cast<float>(value));
    }

    // A texture coordinate or a normal that is no number harms nothing: it becomes 0.
    template <typename Number>
    void numbers(std::vector<Number>& values, int count) {
        for (int i = 0; i < count; ++i) {
            double value = 0;
            if (!parse(text_.word(), value) || !std::isfinite(value)) value = 0;
            values.push_back(static_cast<Number>(value));
        }
    }

    // f v, v/vt, v//vn or v/vt/vn a corner; indices from 1, or from the last backwards as -1.
    void face() {
        const std::size_t begin = mesh_.corners.size();
        for (std::string_view corner = text_.word(); !corner.empty(); corner = text_.word()) {
            const std::size_t slash = std::min(corner.find('/'), corner.size());
            mesh_.corners.push_back(vertex_of(corner.substr(0, slash)));
            if (slash == corner.size()) continue;
            const std::string_view rest = corner.substr(slash + 1);
            const std::size_t second = std::min(rest.find('/'), rest.size());
            put(mesh_.texcoord_corners, rest.substr(0, second), mesh_.texcoords.size() / 2, texcoords_missing_);
            if (second == rest.size()) continue;
            put(normal_corners_, rest.substr(second + 1), normals_.size() / 3, normals_missing_);
        }
        if (mesh_.corners.size() < begin + 3) { // a side or a point: no part of the surface
            mesh_.corners.resize(begin);
            shorten(mesh_.texcoord_corners);
            shorten(normal_corners_);
            return short_faces_.add(text_);
        }
        mesh_.end_polygon();
        for (CurrentName* name : {&groups_, &objects_, &smoothing_, &materials_}) name->end_polygon();
        face_lines_.push_back(static_cast<int>(text_.line_number()));
    }

    void shorten(std::vector<int>& indices) const {
        if (indices.size() > mesh_.corners.size()) indices.resize(mesh_.corners.size());
    }

    // Puts an index beside the last corner. One that means nothing is left out: the shape does not need it.
    void put(std::vector<int>& indices, std::string_view word, std::size_t so_far, Passed& missing) {
        if (word.empty()) return;
        long long index = 0;
        const auto count = static_cast<long long>(so_far);
        if (!parse(word, index) || index == 0 || index < -count || index > std::numeric_limits<int>::max()) {
            missing.add(text_);
            return;
        }
        indices.resize(mesh_.corners.size() - 1, -1);
        indices.push_back(static_cast<int>(index > 0 ? index - 1 : count + index));
    }

    int vertex_of(std::string_view word) const {
        const long long index = text_.integer_from(word, "vertex");
        const auto so_far = static_cast<long long>(mesh_.coordinates.size() / 3);
        if (index > 0 && index <= std::numeric_limits<int>::max()) return static_cast<int>(index - 1);
        if (index == 0) text_.fail("vertex 0 does not exist: OBJ counts from 1; export the model again");
        if (index > 0 || index < -so_far)
            text_.fail(
                fmt::format("vertex {} is out of range: there are {} so far; export the model again", index, so_far));
        return static_cast<int>(so_far + index);
    }

    // A face may name a vertex that comes after it, so this waits for the end.
    void check_vertices() const {
        const std::size_t count = mesh_.coordinates.size() / 3;
        if (count == 0) return; // said by require_sound
        const auto bad = std::find_if(mesh_.corners.begin(), mesh_.corners.end(), [&](int index) {
            return index >= 0 && static_cast<std::size_t>(index) >= count;
        });
        if (bad == mesh_.corners.end()) return;
        const auto corner = static_cast<int>(bad - mesh_.corners.begin());
        const auto face = std::upper_bound(mesh_.ends.begin(), mesh_.ends.end(), corner) - mesh_.ends.begin();
        text_.fail_at(face_lines_[static_cast<std::size_t>(face)],
                      fmt::format("vertex {} is out of range: the file holds {}; it is damaged, export the model again",
                                  *bad + 1, count));
    }

    // One index a corner, or none at all where no corner has one.
    void finish_corners(std::vector<int>& indices, std::size_t count, Passed& missing, std::string_view what) {
        for (int& index : indices)
            if (index >= 0 && static_cast<std::size_t>(index) >= count) {
                index = -1;
                ++missing.count;
            }
        if (missing.count > 0)
            mesh_.file.notes.push_back(fmt::format("{} {} {} that the file does not hold; they have none now",
                                                   counted(missing.count, "corner"),
                                                   missing.count == 1 ? "names" : "name", what));
        if (std::all_of(indices.begin(), indices.end(), [](int index) { return index < 0; })) indices.clear();
        if (!indices.empty()) indices.resize(mesh_.corners.size(), -1);
    }

    void describe() {
        MeshFile& file = mesh_.file;
        if (short_faces_.count > 0)
            file.notes.push_back(
                fmt::format("{} fewer than three corners, first in line {}: passed over",
                            short_faces_.count == 1 ? "1 face has" : fmt::format("{} faces have", short_faces_.count),
                            short_faces_.line));
        if (bad_colors_.count > 0)
            file.notes.push_back(fmt::format("{} no numbers, first in line {}: taken as 0",
                                             bad_colors_.count == 1 ? "1 colour holds"
                                                                    : fmt::format("{} colours hold", bad_colors_.count),
                                             bad_colors_.line));
        if (!normal_corners_.empty()) {
            file.normals = Eigen::Map<const Points>(normals_.data(), static_cast<Eigen::Index>(normals_.size() / 3), 3);
            file.normal_corners = std::move(normal_corners_);
        }
        file.groups = std::move(groups_.all);
        file.objects = std::move(objects_.all);
        file.smoothing = std::move(smoothing_.all);
        for (const std::string& name : materials_.all.names) file.materials.emplace_back().name = name;
        file.polygon_materials = std::move(materials_.all.of);
        if (wires_ > 0) file.only_here.push_back(counted(wires_, "statement") + " of lines or points");
        if (freeforms_ > 0) file.only_here.push_back(counted(freeforms_, "free-form curve or surface"));
    }

    Text text_;
    PolygonMesh mesh_;
    std::vector<double> normals_;
    std::vector<int> normal_corners_, face_lines_;
    CurrentName groups_, objects_, smoothing_, materials_;
    Passed short_faces_, bad_colors_, texcoords_missing_, normals_missing_;
    std::size_t wires_ = 0, freeforms_ = 0;
};

} // namespace

PolygonMesh read_obj(std::string_view bytes, const std::filesystem::path& path) {
    PolygonMesh mesh = ObjReader(bytes, path).read();
    read_libraries(mesh.file, path.parent_path());
    return mesh;
}

} // namespace meshtween
