#include "meshtween/io/seams.h"

#include "meshtween/io/mesh_file.h"

namespace meshtween {
namespace {

// A file's corner, a place in MeshFile::corners, in a list beside those: -1 where the list has none.
int entry(const std::vector<int>& list, const MeshFile& file, int t, int k) {
    const auto corner = static_cast<std::size_t>(file.cut(t, k));
    return corner < list.size() ? list[corner] : -1;
}

} // namespace

Weld seams(const Mesh& mesh, const std::vector<const Points*>& shapes) {
    const MeshFile* file = mesh.file.get();
    if (file == nullptr || file->cut.rows() != mesh.triangles.rows()) return weld(mesh, shapes);
    CornerAttributes attributes;
    if (file->normals.rows() > 0)
        attributes.normal = [file](int t, int k) -> Point {
            const int row = entry(file->normal_corners, *file, t, k);
            return row < 0 ? Point(0, 0, 0) : Point(file->normals.row(row));
        };
    if (!file->more_texcoords.empty())
        attributes.agree = [file](int t, int k, int u, int l) {
            for (const TexcoordSet& set : file->more_texcoords) {
                const int a = entry(set.corners, *file, t, k), b = entry(set.corners, *file, u, l);
                if ((a < 0) != (b < 0) || (a >= 0 && set.texcoords.row(a) != set.texcoords.row(b))) return false;
            }
            return true;
        };
    return weld(mesh, shapes, attributes);
}

} // namespace meshtween
