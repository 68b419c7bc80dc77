// Wavefront OBJ, after "Object Files (.obj)", Appendix B1 of the Advanced Visualizer manual; vertex colours behind the
// coordinates as MeshLab and ZBrush write them. Read here rather than by a library so that doubles stay doubles and a
// message can name the line.
#include "meshtween/io/formats.h"
#include "meshtween/io/output.h"
#include "meshtween/io/text.h"
#include "meshtween/io/text_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>

namespace meshtween {
namespace {

class ObjReader {
public:
    ObjReader(std::string_view bytes, const std::filesystem::path& path) : text_(bytes, path) {}

    PolygonMesh read() {
        while (text_.next_joined_line()) statement();
        check_indices();
        if (!mesh_.colors.empty()) mesh_.colors.resize(mesh_.coordinates.size() / 3 * 4, 1);
        if (any_texcoord_) mesh_.texcoord_corners.resize(mesh_.corners.size(), -1);
        normalise_colors(mesh_.colors);
        return std::move(mesh_);
    }

private:
    void statement() {
        const std::string_view keyword = text_.word();
        if (keyword.empty() || keyword[0] == '#') return;
        if (keyword == "v") return vertex();
        if (keyword == "vt") return texcoord();
        if (keyword == "f" || keyword == "fo") return face();
        if (std::isalpha(static_cast<unsigned char>(keyword[0])) == 0)
            text_.fail(
                fmt::format("'{}' is no OBJ statement; the file is damaged or of another format", shown(keyword)));
    }

    // v x y z, then nothing, a weight, or r g b [a].
    void vertex() {
        for (const char* name : {"x", "y", "z"}) mesh_.coordinates.push_back(text_.finite(name));
        std::array<double, 4> more{0, 0, 0, 1};
        std::size_t count = 0;
        for (std::string_view word = text_.word(); !word.empty() && count < 4; word = text_.word())
            more[count++] = text_.finite_from(word, "a colour");
        if (count < 3) return;
        mesh_.colors.resize((mesh_.coordinates.size() / 3 - 1) * 4, 1); // white before the first that has one
        for (const double value : more) mesh_.colors.push_back(static_cast<float>(value));
    }

    // A texture coordinate that is no number harms nothing: it becomes 0.
    void texcoord() {
        for (int i = 0; i < 2; ++i) {
            double value = 0;
            if (!parse(text_.word(), value) || !std::isfinite(value)) value = 0;
            mesh_.texcoords.push_back(static_cast<float>(value));
        }
    }

    // f v, v/vt, v//vn or v/vt/vn a corner; indices from 1, or from the last backwards as -1.
    void face() {
        int count = 0;
        for (std::string_view corner = text_.word(); !corner.empty(); corner = text_.word(), ++count) {
            const std::size_t slash = std::min(corner.find('/'), corner.size());
            mesh_.corners.push_back(resolve(corner.substr(0, slash), "vertex", mesh_.coordinates.size() / 3));
            std::string_view uv = corner.substr(std::min(slash + 1, corner.size()));
            uv = uv.substr(0, uv.find('/'));
            if (uv.empty()) continue;
            any_texcoord_ = true;
            mesh_.texcoord_corners.resize(mesh_.corners.size() - 1, -1);
            mesh_.texcoord_corners.push_back(resolve(uv, "texture coordinate", mesh_.texcoords.size() / 2));
        }
        if (count < 3)
            text_.fail(fmt::format("a face needs three corners, this has {}; the file is truncated or damaged", count));
        mesh_.end_polygon();
        face_lines_.push_back(static_cast<int>(text_.line_number()));
    }

    int resolve(std::string_view word, std::string_view what, std::size_t count) const {
        const long long index = text_.integer_from(word, what);
        const auto so_far = static_cast<long long>(count);
        if (index > 0 && index <= std::numeric_limits<int>::max()) return static_cast<int>(index - 1);
        if (index == 0) text_.fail(fmt::format("{} 0 does not exist: OBJ counts from 1; export the model again", what));
        if (index > 0 || index < -so_far)
            text_.fail(
                fmt::format("{} {} is out of range: there are {} so far; export the model again", what, index, so_far));
        return static_cast<int>(so_far + index);
    }

    // A face may name a vertex that comes after it, so this waits for the end.
    void check_indices() const {
        const auto check = [&](const std::vector<int>& indices, std::size_t count, std::string_view what) {
            const auto bad = std::find_if(indices.begin(), indices.end(), [&](int index) {
                return index >= 0 && static_cast<std::size_t>(index) >= count;
            });
            if (bad == indices.end()) return;
            const auto corner = static_cast<int>(bad - indices.begin());
            const auto face = std::upper_bound(mesh_.ends.begin(), mesh_.ends.end(), corner) - mesh_.ends.begin();
            text_.fail_at(face_lines_[static_cast<std::size_t>(face)],
                          fmt::format("{} {} is out of range: the file holds {}; it is damaged, export the model again",
                                      what, *bad + 1, count));
        };
        if (mesh_.coordinates.empty()) return; // said by require_sound
        check(mesh_.corners, mesh_.coordinates.size() / 3, "vertex");
        check(mesh_.texcoord_corners, mesh_.texcoords.size() / 2, "texture coordinate");
    }

    Text text_;
    PolygonMesh mesh_;
    std::vector<int> face_lines_;
    bool any_texcoord_ = false;
};

} // namespace

PolygonMesh read_obj(std::string_view bytes, const std::filesystem::path& path) {
    return ObjReader(bytes, path).read();
}

namespace {

void write_new(const Mesh& mesh, std::ostream& stream) {
    TextOut out(stream);
    for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
        out.put("v {} {} {}", mesh.positions(i, 0), mesh.positions(i, 1), mesh.positions(i, 2));
        if (mesh.colors.rows() > 0) out.put(" {} {} {}", mesh.colors(i, 0), mesh.colors(i, 1), mesh.colors(i, 2));
        out.put("\n");
    }
    for (Eigen::Index i = 0; i < mesh.texcoords.rows(); ++i)
        out.put("vt {} {}\n", mesh.texcoords(i, 0), mesh.texcoords(i, 1));
    const Triangles &t = mesh.triangles, &uv = mesh.texcoord_triangles;
    for (Eigen::Index i = 0; i < t.rows(); ++i)
        if (uv.rows() > 0)
            out.put("f {}/{} {}/{} {}/{}\n", t(i, 0) + 1, uv(i, 0) + 1, t(i, 1) + 1, uv(i, 1) + 1, t(i, 2) + 1,
                    uv(i, 2) + 1);
        else
            out.put("f {} {} {}\n", t(i, 0) + 1, t(i, 1) + 1, t(i, 2) + 1);
}

} // namespace

std::vector<std::string> write_obj(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions&) {
    write_whole(path, [&](std::ostream& stream) { write_new(mesh, stream); });
    return {};
}

} // namespace meshtween
