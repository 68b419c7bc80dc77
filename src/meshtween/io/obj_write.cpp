// OBJ: the mesh's own file with other positions and normals, or a new one.
#include "meshtween/io/companions.h"
#include "meshtween/io/file_normals.h"
#include "meshtween/io/formats.h"
#include "meshtween/io/material_library.h"
#include "meshtween/io/obj_statements.h"
#include "meshtween/io/output.h"
#include "meshtween/io/patch.h"
#include "meshtween/io/text_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace meshtween {
namespace {
namespace fs = std::filesystem;

// Replaces the three numbers behind the keyword.
template <typename Number>
void replace_row(Patch& patch, Text& text, const Points& values, Eigen::Index row) {
    if (row >= values.rows()) return;
    for (int k = 0; k < 3; ++k) {
        const std::string_view word = text.word();
        if (word.empty()) return;
        patch.replace(word, static_cast<Number>(values(row, k)));
    }
}

// Carries each library once, however often it is named.
class Libraries {
public:
    explicit Libraries(const Move& move) : move_(move) {}

    const std::string& carry(std::string_view name) {
        auto known = carried_.find(name);
        if (known == carried_.end()) known = carried_.emplace(name, carry_library(move_, name)).first;
        return known->second;
    }

private:
    const Move& move_;
    std::map<std::string, std::string, std::less<>> carried_;
};

void rewrite(const Mesh& mesh, const Move& move, std::ostream& stream) {
    const MeshFile& file = *mesh.file;
    const bool moved = shape_key(mesh) != file.shape;
    const Points normals = moved && file.normals.rows() > 0 ? file_normals(mesh) : Points();
    Text text(file.bytes, file.path);
    Patch patch(file.bytes, stream);
    Libraries libraries(move);
    Eigen::Index vertex = 0, normal = 0;
    for (std::string_view keyword; next_statement(text, keyword);) {
        if (keyword == "v" && moved)
            replace_row<double>(patch, text, mesh.positions, vertex++);
        else if (keyword == "vn")
            replace_row<float>(patch, text, normals, normal++);
        else if (keyword == "mtllib")
            for (const std::string_view name : library_names(text.rest(), move.from))
                if (const std::string& carried = libraries.carry(name); carried != name) patch.replace(name, carried);
    }
    patch.finish();
}

// Names that hold from one polygon on.
class Statement {
public:
    Statement(std::string_view keyword, const std::vector<std::string>& names, const std::vector<int>& of,
              std::string_view none)
        : keyword_(keyword), names_(names), of_(of), none_(none) {}

    void put(TextOut& out, std::size_t polygon) {
        const int now = polygon < of_.size() ? of_[polygon] : -1;
        if (now == last_) return;
        last_ = now;
        if (now >= 0)
            out.put("{} {}\n", keyword_, one_line(names_[static_cast<std::size_t>(now)]));
        else
            out.put("{}{}\n", keyword_, none_);
    }
    static std::string one_line(std::string name) {
        std::replace_if(
            name.begin(), name.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
        return name;
    }

private:
    std::string_view keyword_;
    const std::vector<std::string>& names_;
    const std::vector<int>& of_;
    std::string_view none_;
    int last_ = -1;
};

void put_points(TextOut& out, const Mesh& mesh, const WrittenPolygons& polygons) {
    for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
        out.put("v {} {} {}", mesh.positions(i, 0), mesh.positions(i, 1), mesh.positions(i, 2));
        if (mesh.colors.rows() > 0) out.put(" {} {} {}", mesh.colors(i, 0), mesh.colors(i, 1), mesh.colors(i, 2));
        out.put("\n");
    }
    for (Eigen::Index i = 0; i < mesh.texcoords.rows(); ++i)
        out.put("vt {} {}\n", mesh.texcoords(i, 0), mesh.texcoords(i, 1));
    const Eigen::MatrixX3f normals = polygons.normals.cast<float>();
    for (Eigen::Index i = 0; i < normals.rows(); ++i)
        out.put("vn {} {} {}\n", normals(i, 0), normals(i, 1), normals(i, 2));
}

void put_polygon(TextOut& out, const WrittenPolygons& polygons, std::size_t p) {
    const auto index = [](const std::vector<int>& corners, std::size_t c) { return corners.empty() ? -1 : corners[c]; };
    out.put("f");
    for (auto c = static_cast<std::size_t>(polygons.begin(p)); c < static_cast<std::size_t>(polygons.ends[p]); ++c) {
        const int vertex = polygons.corners[c], uv = index(polygons.texcoord_corners, c),
                  normal = index(polygons.normal_corners, c);
        if (normal < 0 && uv < 0)
            out.put(" {}", vertex + 1);
        else if (normal < 0)
            out.put(" {}/{}", vertex + 1, uv + 1);
        else if (uv < 0)
            out.put(" {}//{}", vertex + 1, normal + 1);
        else
            out.put(" {}/{}/{}", vertex + 1, uv + 1, normal + 1);
    }
    out.put("\n");
}

void write_new(const Mesh& mesh, const std::vector<std::string>& libraries, std::ostream& stream) {
    const WrittenPolygons polygons = written_polygons(mesh);
    static const MeshFile none;
    const MeshFile& file = is_described(mesh) ? *mesh.file : none;
    std::vector<std::string> materials;
    for (const Material& material : file.materials) materials.push_back(material.name);
    Statement objects("o", file.objects.names, file.objects.of, " none"),
        groups("g", file.groups.names, file.groups.of, ""),
        smoothing("s", file.smoothing.names, file.smoothing.of, " off"),
        material("usemtl", materials, file.polygon_materials, " none");
    TextOut out(stream);
    for (const std::string& library : libraries) out.put("mtllib {}\n", library);
    put_points(out, mesh, polygons);
    for (std::size_t p = 0; p < polygons.ends.size(); ++p) {
        for (Statement* statement : {&objects, &groups, &material, &smoothing}) statement->put(out, p);
        put_polygon(out, polygons, p);
    }
}

// The libraries to name: those of the mesh's own OBJ, or one made from what its file says of materials.
std::vector<std::string> carry_libraries(const Mesh& mesh, const fs::path& path, const Move& move) {
    std::vector<std::string> result;
    if (!is_described(mesh)) return result;
    const MeshFile& file = *mesh.file;
    Libraries libraries(move);
    for (const std::string& statement : file.material_libraries)
        for (const std::string_view name : library_names(statement, move.from)) result.push_back(libraries.carry(name));
    if (!result.empty() || file.materials.empty() || file.format == ".obj" || !fs::is_directory(move.to)) return result;
    std::vector<std::string> images;
    for (std::size_t i = 0; i < file.images.size(); ++i) images.push_back(carry_image(move, file.images[i], i));
    const std::string library = material_library(file, images);
    try {
        result.push_back(place_beside(move.to, path.stem().string() + ".mtl", library, library_mark));
    } catch (const std::exception& error) {
        move.notes->emplace_back(error.what());
    }
    return result;
}

} // namespace

std::vector<std::string> write_obj(const Mesh& mesh, const fs::path& path, const WriteOptions& options) {
    std::vector<std::string> notes;
    const Move move = move_to(path, mesh.file ? mesh.file->path : fs::path(), options, notes);
    if (is_rewritable(mesh, ".obj")) {
        write_whole(path, [&](std::ostream& stream) { rewrite(mesh, move, stream); });
    } else {
        const std::vector<std::string> libraries = carry_libraries(mesh, path, move);
        write_whole(path, [&](std::ostream& stream) { write_new(mesh, libraries, stream); });
    }
    return notes;
}

} // namespace meshtween
