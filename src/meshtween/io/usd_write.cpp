// Universal Scene Description, Pixar: the text format, UsdGeomMesh, UsdSkel's schemas (blend shapes with in-betweens)
// and the UsdPreviewSurface specification.
#include "meshtween/io/usd_write.h"

#include "meshtween/core/color.h"
#include "meshtween/core/error.h"
#include "meshtween/core/version.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/formats.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/output.h"
#include "meshtween/io/usd_material.h"
#include "meshtween/io/usd_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace meshtween {
namespace {

using Floats = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
constexpr double codes_per_second = 24;

// The vertices that some of the tables move.
struct Moved {
    std::vector<int> indices;
    bool all = true; // then the indices need not be told
};

struct UsdScene {
    const Mesh& mesh;
    const UsdMorph& morph;
    Point origin{0, 0, 0};
    Floats positions, normals; // of the base
    WrittenPolygons polygons;
};

void put_extent(TextOut& out, const UsdScene& scene, const char* indent) {
    Floats corners(2, 3);
    corners << scene.positions.colwise().minCoeff(), scene.positions.colwise().maxCoeff();
    for (const Points& shape : scene.morph.shapes) {
        const Floats floats = (shape.rowwise() - scene.origin).cast<float>();
        corners.row(0) = corners.row(0).cwiseMin(floats.colwise().minCoeff());
        corners.row(1) = corners.row(1).cwiseMax(floats.colwise().maxCoeff());
    }
    out.put("{}float3[] extent = ", indent);
    put_rows(out, corners);
}

// A normal a corner, as the mesh's file has them, with its edges.
Floats corner_normals(const UsdScene& scene) {
    Floats result(static_cast<Eigen::Index>(scene.polygons.corners.size()), 3);
    for (Eigen::Index c = 0; c < result.rows(); ++c) {
        const auto corner = static_cast<std::size_t>(c);
        const int normal = scene.polygons.normal_corners[corner];
        if (normal >= 0)
            result.row(c) = scene.polygons.normals.row(normal).cast<float>();
        else
            result.row(c) = scene.normals.row(scene.polygons.corners[corner]);
    }
    return result;
}

void put_colors(TextOut& out, const Mesh& mesh) {
    if (mesh.colors.rows() == 0) {
        out.put("        color3f[] primvars:displayColor = [(0.7, 0.625, 0.555)] (\n"
                "            interpolation = \"constant\"\n        )\n");
        return;
    }
    Floats rgb = mesh.colors.leftCols(3).cwiseMax(0).cwiseMin(1);
    for (Eigen::Index i = 0; i < rgb.size(); ++i) rgb.data()[i] = linear_from_srgb(rgb.data()[i]);
    out.put("        color3f[] primvars:displayColor = ");
    put_rows(out, rgb, "interpolation = \"vertex\"");
    if ((mesh.colors.col(3).array() == 1).all()) return;
    std::vector<float> alpha(static_cast<std::size_t>(mesh.colors.rows()));
    for (std::size_t i = 0; i < alpha.size(); ++i) alpha[i] = mesh.colors(static_cast<Eigen::Index>(i), 3);
    out.put("        float[] primvars:displayOpacity = ");
    put_list(out, alpha, "interpolation = \"vertex\"");
}

void put_geometry(TextOut& out, const UsdScene& scene) {
    const Mesh& mesh = scene.mesh;
    std::vector<int> counts;
    for (std::size_t p = 0; p < scene.polygons.ends.size(); ++p)
        counts.push_back(scene.polygons.ends[p] - (p > 0 ? scene.polygons.ends[p - 1] : 0));
    put_extent(out, scene, "        ");
    out.put("        uniform token subdivisionScheme = \"none\"\n        uniform bool doubleSided = 1\n"
            "        int[] faceVertexCounts = ");
    put_list(out, counts);
    out.put("        int[] faceVertexIndices = ");
    put_list(out, scene.polygons.corners);
    out.put("        point3f[] points = ");
    put_rows(out, scene.positions);
    out.put("        normal3f[] normals = ");
    if (scene.morph.shapes.empty() && scene.polygons.normal_corners.size() == scene.polygons.corners.size())
        put_rows(out, corner_normals(scene), "interpolation = \"faceVarying\"");
    else
        put_rows(out, scene.normals, "interpolation = \"vertex\"");
    put_colors(out, mesh);
    if (mesh.texcoords.rows() == 0) return;
    out.put("        texCoord2f[] primvars:st = ");
    put_rows(out, mesh.texcoords, "interpolation = \"faceVarying\"");
    out.put("        int[] primvars:st:indices = ");
    put_list(out, scene.polygons.texcoord_corners);
}

// Faces by name: what a group or a material covers.
void put_subset(TextOut& out, const std::string& prim, const std::string& name, const char* family,
                const std::vector<int>& faces, const std::string& material) {
    out.put("\n        def GeomSubset \"{}\" (\n", prim);
    if (!material.empty()) out.put("            prepend apiSchemas = [\"MaterialBindingAPI\"]\n");
    out.put("            displayName = {}\n        )\n        {{\n", usd_quoted(name));
    out.put("            uniform token elementType = \"face\"\n            uniform token familyName = \"{}\"\n"
            "            int[] indices = ",
            family);
    put_list(out, faces);
    if (!material.empty()) out.put("            rel material:binding = <{}>\n", material);
    out.put("        }}\n");
}

void put_subsets(TextOut& out, const Mesh& mesh, const std::vector<std::string>& materials,
                 std::set<std::string>& taken) {
    const MeshFile& file = *mesh.file;
    const auto faces_of = [](const std::vector<int>& of, int which) {
        std::vector<int> faces;
        for (std::size_t p = 0; p < of.size(); ++p)
            if (of[p] == which) faces.push_back(static_cast<int>(p));
        return faces;
    };
    for (const auto& [kind, family] : {std::pair{&file.objects, "object"}, std::pair{&file.groups, "group"}})
        for (std::size_t i = 0; i < kind->names.size(); ++i)
            put_subset(out, usd_unique(usd_name(kind->names[i], family), taken), kind->names[i], family,
                       faces_of(kind->of, static_cast<int>(i)), {});
    if (materials.size() > 1)
        for (std::size_t i = 0; i < materials.size(); ++i)
            put_subset(out, usd_unique(usd_name(file.materials[i].name, "material"), taken), file.materials[i].name,
                       "materialBind", faces_of(file.polygon_materials, static_cast<int>(i)), materials[i]);
}

// The vertices that a shape moves or turns; few of them are told by their numbers.
Moved moved_vertices(const std::vector<Floats>& tables) {
    Moved moved;
    const Eigen::Index count = tables.front().rows();
    for (Eigen::Index i = 0; i < count; ++i)
        for (const Floats& table : tables)
            if (!table.row(i).isZero(0)) {
                moved.indices.push_back(static_cast<int>(i));
                break;
            }
    moved.all = moved.indices.empty() || 4 * static_cast<Eigen::Index>(moved.indices.size()) > 3 * count;
    return moved;
}

void put_offsets(TextOut& out, const std::string& name, const Floats& table, const Moved& moved,
                 const std::string& about = {}) {
    out.put("            uniform vector3f[] {} = ", name);
    if (moved.all) {
        put_rows(out, table, about);
    } else {
        Floats few(static_cast<Eigen::Index>(moved.indices.size()), 3);
        for (Eigen::Index i = 0; i < few.rows(); ++i)
            few.row(i) = table.row(moved.indices[static_cast<std::size_t>(i)]);
        put_rows(out, few, about);
    }
}

// Offsets of a shape and of its normals from the base as it is written: base + offset is then rounded once. What does
// not move has none.
std::pair<Floats, Floats> offsets(const UsdScene& scene, std::size_t shape) {
    constexpr double same_normal = 1e-6;
    const Points &to = scene.morph.shapes[shape], &normals = scene.morph.normals[shape + 1];
    Floats moves = Floats::Zero(to.rows(), 3), turns = moves;
    for (Eigen::Index i = 0; i < to.rows(); ++i) {
        if (to.row(i) != scene.mesh.positions.row(i))
            moves.row(i) = ((to.row(i) - scene.origin) - scene.positions.row(i).cast<double>()).cast<float>();
        const Point turn = normals.row(i) - scene.normals.row(i).cast<double>();
        if (turn.norm() > same_normal) turns.row(i) = turn.cast<float>();
    }
    return {std::move(moves), std::move(turns)};
}

void put_blend_shape(TextOut& out, const UsdScene& scene, const std::string& prim,
                     const std::vector<std::size_t>& shapes) {
    std::vector<Floats> tables;
    for (const std::size_t shape : shapes) {
        auto [moves, turns] = offsets(scene, shape);
        tables.push_back(std::move(moves));
        tables.push_back(std::move(turns));
    }
    const Moved moved = moved_vertices(tables);
    out.put("\n        def BlendShape \"{}\" (\n            displayName = {}\n        )\n        {{\n", prim,
            usd_quoted(shapes.size() == 1 ? scene.morph.names[shapes[0]] : "morph"));
    const std::size_t last = tables.size() - 2;
    put_offsets(out, "offsets", tables[last], moved);
    put_offsets(out, "normalOffsets", tables[last + 1], moved);
    for (std::size_t i = 0; i + 1 < shapes.size(); ++i) {
        const std::string name =
            "inbetweens:" + usd_name(scene.morph.names[shapes[i]], "shape") + fmt::format("_{}", i);
        put_offsets(out, name, tables[2 * i], moved, fmt::format("weight = {}", scene.morph.stops[shapes[i]]));
        put_offsets(out, name + ":normalOffsets", tables[2 * i + 1], moved);
    }
    if (!moved.all) {
        out.put("            uniform int[] pointIndices = ");
        put_list(out, moved.indices);
    }
    out.put("        }}\n");
}

// One blend shape a shape, or one of all of them with in-betweens: the shapes of each.
std::vector<std::vector<std::size_t>> blend_shapes(const UsdMorph& morph) {
    std::vector<std::vector<std::size_t>> result;
    for (std::size_t k = 0; k < morph.shapes.size(); ++k)
        if (morph.stops.empty() || k == 0)
            result.push_back({k});
        else
            result.front().push_back(k);
    return result;
}

// A row of the weights that the blend shapes have at a time.
std::vector<float> weights_at(const UsdMorph& morph, std::size_t key) {
    const std::size_t count = morph.shapes.size();
    const std::span row = std::span(morph.weights).subspan(key * count, count);
    if (morph.stops.empty()) return {row.begin(), row.end()};
    double place = 0; // of two neighbours blended: between their stops, by the same parts
    for (std::size_t k = 0; k < count; ++k) place += static_cast<double>(row[k]) * static_cast<double>(morph.stops[k]);
    return {static_cast<float>(place)};
}

void put_skeleton(TextOut& out, const UsdScene& scene, const std::vector<std::string>& names) {
    const char* still = "((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))";
    out.put("\n    def Skeleton \"Skeleton\" (\n        prepend apiSchemas = [\"SkelBindingAPI\"]\n    )\n    {{\n"
            "        uniform token[] joints = [\"root\"]\n        uniform matrix4d[] bindTransforms = [{}]\n"
            "        uniform matrix4d[] restTransforms = [{}]\n"
            "        rel skel:animationSource = </Model/Skeleton/Animation>\n\n"
            "        def SkelAnimation \"Animation\"\n        {{\n            uniform token[] blendShapes = ",
            still, still);
    put_list(out, names);
    out.put("            float[] blendShapeWeights.timeSamples = {{\n");
    for (std::size_t key = 0; key < scene.morph.times.size(); ++key) {
        out.put("                {}: ", codes_per_second * static_cast<double>(scene.morph.times[key]));
        put_list(out, weights_at(scene.morph, key), {}, ",");
    }
    out.put("            }}\n        }}\n    }}\n");
}

void put_header(TextOut& out, const UsdScene& scene) {
    out.put("#usda 1.0\n(\n    defaultPrim = \"Model\"\n    doc = \"written by meshtween {}\"\n"
            "    metersPerUnit = 1\n    upAxis = \"Y\"\n",
            version());
    if (!scene.morph.times.empty())
        out.put("    startTimeCode = 0\n    endTimeCode = {}\n    timeCodesPerSecond = {}\n    framesPerSecond = {}\n",
                codes_per_second * static_cast<double>(scene.morph.times.back()), codes_per_second, codes_per_second);
    out.put(")\n\n");
}

void put_model(TextOut& out, const UsdScene& scene, const UsdMaterials& materials) {
    const bool moves = !scene.morph.shapes.empty();
    put_header(out, scene);
    out.put("def {} \"Model\"\n{{\n", moves ? "SkelRoot" : "Xform");
    if (moves) put_extent(out, scene, "    ");
    if (!scene.origin.isZero())
        out.put("    double3 xformOp:translate = ({}, {}, {})\n"
                "    uniform token[] xformOpOrder = [\"xformOp:translate\"]\n",
                scene.origin[0], scene.origin[1], scene.origin[2]);
    const std::vector<std::vector<std::size_t>> shapes = blend_shapes(scene.morph);
    std::set<std::string> taken;
    std::vector<std::string> names, targets;
    for (const std::vector<std::size_t>& each : shapes) {
        const std::string name = each.size() > 1 ? "morph" : scene.morph.names[each[0]];
        names.push_back('"' + usd_unique(usd_name(name, "shape"), taken) + '"');
        targets.push_back("</Model/Surface/" + names.back().substr(1, names.back().size() - 2) + ">");
    }
    if (moves) put_skeleton(out, scene, names);
    out.put("\n    def Mesh \"Surface\" (\n        prepend apiSchemas = [\"MaterialBindingAPI\"{}]\n    )\n    {{\n",
            moves ? ", \"SkelBindingAPI\"" : "");
    put_geometry(out, scene);
    if (materials.paths.size() == 1) out.put("        rel material:binding = <{}>\n", materials.paths[0]);
    if (moves) {
        out.put("        rel skel:skeleton = </Model/Skeleton>\n        uniform token[] skel:blendShapes = ");
        put_list(out, names);
        out.put("        rel skel:blendShapeTargets = ");
        put_list(out, targets);
    }
    if (is_described(scene.mesh)) put_subsets(out, scene.mesh, materials.paths, taken);
    for (std::size_t i = 0; i < shapes.size(); ++i)
        put_blend_shape(out, scene, names[i].substr(1, names[i].size() - 2), shapes[i]);
    out.put("    }}\n{}}}\n", materials.text);
}

void check_morph(const Mesh& mesh, const UsdMorph& morph) {
    const std::size_t count = morph.shapes.size();
    if (morph.names.size() != count || morph.weights.size() != count * morph.times.size() ||
        (count > 0 && morph.normals.size() != count + 1) || (!morph.stops.empty() && morph.stops.size() != count))
        throw Error(ErrorKind::argument, "names, normals and weights of the shapes do not agree in number");
    for (const Points& shape : morph.shapes)
        if (shape.rows() != mesh.positions.rows())
            throw Error(ErrorKind::argument, fmt::format("a shape has {} vertices, but the mesh has {}", shape.rows(),
                                                         mesh.positions.rows()));
}

// Float has 24 bits: a mesh a few diagonals away from the origin keeps 1e-6 of its diagonal, one further away does not.
Point origin_of(const Points& positions) {
    const Point centre = (positions.colwise().minCoeff() + positions.colwise().maxCoeff()) / 2;
    return centre.norm() > 4 * diagonal(positions) ? centre : Point(0, 0, 0);
}

} // namespace

std::vector<std::string> write_usd(const Mesh& mesh, const UsdMorph& morph, const std::filesystem::path& path,
                                   const WriteOptions& options) {
    check_morph(mesh, morph);
    UsdScene scene{mesh, morph, origin_of(mesh.positions), {}, {}, written_polygons(mesh)};
    scene.positions = (mesh.positions.rowwise() - scene.origin).cast<float>();
    scene.normals = morph.normals.empty() ? vertex_normals(mesh.positions, mesh.triangles).cast<float>().eval()
                                          : morph.normals.front().cast<float>().eval();
    const UsdMaterials materials = usd_materials(mesh, path, options);
    write_whole(path, [&](std::ostream& stream) {
        TextOut out(stream);
        put_model(out, scene, materials);
    });
    return materials.notes;
}

std::vector<std::string> write_usda(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions& options) {
    return write_usd(mesh, {}, path, options);
}

} // namespace meshtween
