// OFF: the mesh's own file with other positions and normals, or a new one.
#include "meshtween/io/file_normals.h"
#include "meshtween/io/formats.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/off.h"
#include "meshtween/io/output.h"
#include "meshtween/io/patch.h"
#include "meshtween/io/text_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace meshtween {
namespace {

void rewrite(const Mesh& mesh, std::ostream& stream) {
    const MeshFile& file = *mesh.file;
    Patch patch(file.bytes, stream);
    if (shape_key(mesh) != file.shape) {
        OffPlaces places;
        read_off(file.bytes, file.path, &places);
        const Points normals = places.normals.empty() ? Points() : file_normals(mesh);
        for (std::size_t i = 0, n = 0; i < places.positions.size(); ++i) {
            patch.replace(places.positions[i], mesh.positions.data()[i]);
            if (i % 3 != 2) continue; // the normal stands behind z
            for (int k = 0; k < 3 && n < places.normals.size(); ++k, ++n)
                patch.replace(places.normals[n], static_cast<float>(normals.data()[n]));
        }
    }
    patch.finish();
}

bool are_bytes(const Colors& colors) {
    for (Eigen::Index i = 0; i < colors.size(); ++i) {
        const float color = colors.data()[i];
        if (!(color >= 0 && color <= 1) || std::round(color * 255) / 255 != color) return false;
    }
    return true;
}

// Readers tell fractions from bytes by the point.
std::string with_point(float color) {
    std::string text = fmt::format("{}", color);
    if (text.find('e') != std::string::npos) text = fmt::format("{:.9f}", color);
    if (text.find('.') == std::string::npos) text += ".0";
    return text;
}

void write_new(const Mesh& mesh, std::ostream& stream) {
    const WrittenPolygons polygons = written_polygons(mesh);
    const bool colored = mesh.colors.rows() > 0, bytes = are_bytes(mesh.colors);
    TextOut out(stream);
    out.put("{}OFF\n{} {} 0\n", colored ? "C" : "", mesh.positions.rows(), polygons.ends.size());
    for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
        out.put("{} {} {}", mesh.positions(i, 0), mesh.positions(i, 1), mesh.positions(i, 2));
        for (int k = 0; k < 4 && colored; ++k)
            if (bytes)
                out.put(" {}", std::lround(mesh.colors(i, k) * 255));
            else
                out.put(" {}", with_point(mesh.colors(i, k)));
        out.put("\n");
    }
    for (std::size_t p = 0; p < polygons.ends.size(); ++p) {
        out.put("{}", polygons.ends[p] - polygons.begin(p));
        for (int c = polygons.begin(p); c < polygons.ends[p]; ++c)
            out.put(" {}", polygons.corners[static_cast<std::size_t>(c)]);
        out.put("\n");
    }
}

} // namespace

std::vector<std::string> write_off(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions&) {
    const bool again = is_rewritable(mesh, ".off");
    write_whole(path, [&](std::ostream& stream) { again ? rewrite(mesh, stream) : write_new(mesh, stream); });
    return {};
}

} // namespace meshtween
