// Textured models for the validator and the browser: what a glTF and a file of two materials become.
#include "textured_files.h"

#include "meshtween/app/export.h"
#include "meshtween/app/preview.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"
#include "meshtween/morph/keys.h"
#include "support/gltf_sample.h"
#include "support/twist.h"

namespace meshtween {
namespace {

// Squares of two colours.
std::string checks(const std::filesystem::path& path, std::array<std::uint8_t, 6> colors) {
    Image image{64, 64, {}};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (std::size_t c = 0; c < 3; ++c) image.rgb.push_back(colors[((x / 16 + y / 16) % 2 == 0 ? 0U : 3U) + c]);
    write_png(image, path);
    return read_whole(path);
}

Curve twisted(const Mesh& mesh) {
    return key_path(mesh, {mesh.positions, twist(mesh.positions, 3, 2)}).curve;
}

// Its two halves have a material each; texture coordinates run around it, with a seam.
Mesh of_two_materials(Mesh mesh, const std::string& png) {
    auto file = std::make_shared<MeshFile>();
    file->format = ".obj";
    file->images = {{"squares", "image/png", png, {}}};
    file->materials = {{.name = "paper", .base_color_image = 0},
                       {.name = "red", .base_color = {0.6F, 0.05F, 0.03F, 1}, .roughness = 0.3F}};
    const Eigen::Index m = mesh.triangles.rows();
    mesh.texcoords.resize(3 * m, 2);
    mesh.texcoord_triangles.resize(m, 3);
    file->cut.resize(m, 3);
    for (Eigen::Index t = 0; t < m; ++t) {
        std::array<double, 3> around;
        for (int c = 0; c < 3; ++c) {
            const Point p = mesh.positions.row(mesh.triangles(t, c));
            around[static_cast<std::size_t>(c)] = std::atan2(p[2], p[1]) / (2 * std::numbers::pi) + 0.5;
        }
        const double most = *std::max_element(around.begin(), around.end());
        for (int c = 0; c < 3; ++c) {
            const Point p = mesh.positions.row(mesh.triangles(t, c));
            const int corner = static_cast<int>(3 * t + c);
            double v = around[static_cast<std::size_t>(c)];
            if (most - v > 0.5) v += 1;
            mesh.texcoords.row(corner) << static_cast<float>(p[0]), static_cast<float>(2 * v);
            mesh.texcoord_triangles(t, c) = file->cut(t, c) = corner;
            file->corners.push_back(mesh.triangles(t, c));
        }
        file->ends.push_back(static_cast<int>(3 * t + 3));
        file->polygon_materials.push_back(mesh.positions(mesh.triangles(t, 0), 0) < 1.5 ? 0 : 1);
    }
    file->vertices = mesh.positions.rows();
    mesh.file = file;
    return mesh;
}

} // namespace

void write_textured(const std::filesystem::path& folder) {
    const std::filesystem::path made = folder / "made";
    std::filesystem::create_directories(made);
    const std::string png = checks(made / "checks.png", {236, 228, 208, 38, 92, 120});
    const GltfMaker sample = gltf_sample(straight_bar(), png);
    write_whole(folder / "sample.glb", sample.glb());
    write_whole(made / "sample.bin", sample.bin);
    write_whole(made / "sample.gltf", sample.gltf("sample.bin"));
    Mesh mesh = read_mesh(folder / "sample.glb");
    const Curve curve = twisted(mesh);
    const std::string glb = morph_glb(mesh, curve, {.title = "Sample"});
    write_whole(folder / "sample_morph.glb", glb);
    write_whole(folder / "sample_morph.html", morph_html(glb, {.title = "Sample"}));
    mesh.positions = curve.at(0.5);
    write_mesh(mesh, folder / "sample_fit.glb");
    mesh = read_mesh(made / "sample.gltf");
    mesh.positions = curve.at(0.5);
    write_mesh(mesh, folder / "sample_fit.gltf");

    const Mesh dressed = of_two_materials(straight_bar(), checks(made / "squares.png", {250, 246, 236, 201, 132, 52}));
    const std::string parts = morph_glb(dressed, twisted(dressed), {.title = "Two materials"});
    write_whole(folder / "materials.glb", parts);
    write_whole(folder / "materials.html", morph_html(parts, {.title = "Two materials"}));
    write_mesh(dressed, folder / "materials_fit.glb");
}

} // namespace meshtween
