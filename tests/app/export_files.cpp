// Writes what the validator and the browser look at, and meshes for the program: export_files FOLDER FOLDER
#include "meshtween/app/export.h"
#include "meshtween/app/usd_morph.h"
#include "meshtween/io/gltf_write.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"
#include "meshtween/morph/keys.h"
#include "support/twist.h"
#include "textured_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <functional>

using namespace meshtween;

namespace {

// The bar with a colour a vertex and a UV seam along one of its sides.
Mesh painted(Mesh mesh) {
    const Eigen::Index n = mesh.positions.rows();
    mesh.colors.resize(n, 4);
    mesh.texcoords.resize(2 * n, 2);
    for (Eigen::Index i = 0; i < n; ++i) {
        const Point p = mesh.positions.row(i);
        mesh.colors.row(i) << static_cast<float>(p[0] / 3), 0.5F, static_cast<float>(1 - p[0] / 3), 1;
        const double around = std::atan2(p[2], p[1]) / (2 * std::numbers::pi) + 0.5;
        mesh.texcoords.row(i) << static_cast<float>(around), static_cast<float>(p[0] / 3);
        mesh.texcoords.row(n + i) << static_cast<float>(around + 1), static_cast<float>(p[0] / 3);
    }
    mesh.texcoord_triangles = mesh.triangles;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int c = 0; c < 3; ++c) {
            const auto u = [&](int k) { return mesh.texcoords(mesh.triangles(t, k), 0); };
            if (u(c) < 0.25F && std::max({u(0), u(1), u(2)}) > 0.75F)
                mesh.texcoord_triangles(t, c) += static_cast<int>(n);
        }
    return mesh;
}

// u, all vertices of the path there and the curve's weights, for a few u, as JSON.
std::string shapes_of(const Curve& curve, const std::function<Points(double)>& at) {
    std::string text = "[";
    for (const double u : {0.0, 0.05, 0.13, 0.31, 0.44, 0.5, 0.62, 0.77, 0.9, 1.0}) {
        const Points p = at(u);
        text += fmt::format("{}{{\"u\":{},\"vertices\":[{}],\"weights\":[{}]}}", text.size() > 1 ? "," : "", u,
                            fmt::join(p.data(), p.data() + p.size(), ","), fmt::join(curve.weights(u), ","));
    }
    return text + "]";
}

// A bar and the same one twisted, for the program to morph: bar.obj, bar_twisted_90.obj, bar_twisted_270.obj.
void write_bars(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    Mesh mesh = straight_bar();
    write_mesh(mesh, folder / "bar.obj");
    const Points straight = mesh.positions;
    for (const int degrees : {90, 270}) {
        mesh.positions = twist(straight, 3, degrees * std::numbers::pi / 180);
        write_mesh(mesh, folder / fmt::format("bar_twisted_{}.obj", degrees));
    }
}

// A path of straight lines, which USD holds as one blend shape with in-betweens, and what it is at some moments.
void write_straight(const Mesh& mesh, const std::filesystem::path& folder) {
    Curve curve;
    curve.basis = even_basis(1, 2);
    curve.nodes = {mesh.positions, twist(mesh.positions, 3, 1), twist(mesh.positions, 3, 4)};
    curve.keys = {0, 0.5, 1};
    write_morph_usd(mesh, curve, weight_keys(curve), folder / "straight.usda");
    std::string moments;
    for (const double t : {0.0, 0.13, 0.5, 0.62, 1.0}) {
        const Points p = curve.at(t);
        moments += fmt::format("{}{{\"t\":{},\"vertices\":[{}]}}", moments.empty() ? "" : ",", t,
                               fmt::join(p.data(), p.data() + p.size(), ","));
    }
    write_whole(folder / "straight.json", "{\"seconds\":2,\"tolerance\":1e-6,\"moments\":[" + moments + "]}");
}

} // namespace

int main(int count, char** arguments) {
    if (count != 3) return 1;
    const std::filesystem::path folder = arguments[1];
    std::filesystem::create_directories(folder);
    write_bars(arguments[2]);
    write_textured(folder);
    const Mesh mesh = straight_bar();
    write_straight(mesh, arguments[2]);
    const Curve curve = twist_curve(mesh);
    const PlayOptions options{.seconds = 2, .ping_pong = true, .title = "A bar, twisted <by 180\u00b0>"};
    write_whole(folder / "mesh.glb", mesh_glb(mesh));
    write_whole(folder / "painted.glb", mesh_glb(painted(mesh)));
    const std::string glb = morph_glb(mesh, curve, options);
    write_whole(folder / "morph.glb", glb);
    write_whole(folder / "morph.html", morph_html(glb, options));
    write_whole(folder / "morph.json", shapes_of(curve, [&](double u) { return curve.at(u); }));
    write_whole(folder / "morph_painted.glb",
                morph_glb(painted(mesh), curve, {.seconds = 1, .ping_pong = false, .title = ""}));

    const Mesh large = straight_bar(5); // more vertices than 16 bits count
    write_whole(folder / "morph_large.glb", morph_glb(large, twist_curve(large, 1, 5)));

    const Curve keys = key_path(mesh, {mesh.positions, curve.nodes.back(), twist(mesh.positions, 3, 4.5)}).curve;
    const std::string keys_glb = morph_glb(mesh, keys, {.ping_pong = false, .ease = Ease::in_out, .title = "Keys"});
    write_whole(folder / "keys.glb", keys_glb);
    write_whole(folder / "keys.html", morph_html(keys_glb, {.ease = Ease::in_out, .title = "Keys"}));
    write_whole(folder / "keys.json", shapes_of(keys, [&](double u) { return keys.at(u); }));

    const Morph bend = morph(mesh, turn(curve.nodes.back(), {1, 2, 0.5}, 2)); // the path itself, not its curve
    const Curve bend_curve = meshtween::curve(bend);
    write_whole(folder / "path.html", morph_html(morph_glb(mesh, bend_curve)));
    write_whole(folder / "path.json", shapes_of(bend_curve, bend.at));

    Curve far = curve; // needs the node's translation
    for (Points& node : far.nodes) node.rowwise() += Point(2e5, -1e6, 3e5);
    const std::string far_glb = morph_glb(mesh, far);
    write_whole(folder / "far.glb", far_glb);
    write_whole(folder / "far.html", morph_html(far_glb, {.seconds = 2, .ping_pong = false, .title = ""}));
    write_whole(folder / "far.json", shapes_of(far, [&](double u) { return far.at(u); }));
    return 0;
}
