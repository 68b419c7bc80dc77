// Prints the table of docs/path.md: every method on shapes whose way is known, at u = 0.5. With a folder as argument it
// also writes the page's plots there.
#include "meshtween/app/path_plot.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/io/output.h"
#include "meshtween/morph/curve.h"
#include "meshtween/morph/path_quality.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>

using namespace meshtween;

namespace {

struct Case {
    std::string name;
    Mesh from;
    Points to;
};

std::vector<Case> cases() {
    const double degree = std::numbers::pi / 180;
    const Mesh box = bar({6, 1, 1}, {60, 10, 10});
    std::vector<Case> all;
    for (const double angle : {90, 180, 270})
        all.push_back({"bend " + std::to_string(static_cast<int>(angle)), box, bend(box.positions, 6, angle * degree)});
    for (const double angle : {180, 270, 720})
        all.push_back(
            {"twist " + std::to_string(static_cast<int>(angle)), box, twist(box.positions, 6, angle * degree)});
    const Mesh ball = sphere(4);
    all.push_back({"sphere turned 120", ball, turn(ball.positions, {1, 2, 0.5}, 120 * degree)});
    return all;
}

// All methods along one case; the slow one is left to the table.
void plot(const Case& c, const std::filesystem::path& folder) {
    std::vector<PlottedPath> paths;
    for (const MorphMethod method : morph_methods())
        if (method != MorphMethod::dual_mesh)
            paths.push_back(
                {std::string(name_of(method)),
                 path_quality(c.from.triangles, morph(c.from, c.to, {.method = method}).at, {.frames = 21})});
    std::string name = "path-" + c.name + ".svg";
    std::replace(name.begin(), name.end(), ' ', '-');
    write_whole(folder / name, path_plot(paths));
}

} // namespace

int main(int count, char** arguments) {
    const std::vector<Case> all = cases();
    if (count > 1)
        for (const Case& c : all)
            if (c.name == "bend 180" || c.name == "twist 270") plot(c, arguments[1]);
    std::printf("| method |");
    for (const Case& c : all) std::printf(" %s |", c.name.c_str());
    std::printf("\n|---|");
    for (std::size_t k = 0; k < all.size(); ++k) std::printf("---|");
    std::printf("\n");
    for (const MorphMethod method : morph_methods()) {
        std::printf("| %s |", std::string(name_of(method)).c_str());
        for (const Case& c : all) {
            const Morph path = morph(c.from, c.to, {.method = method});
            const PathQuality quality =
                path_quality(c.from.triangles, path.at, {.frames = 3, .self_intersections = false});
            const FrameQuality& half = quality.frames[1];
            const std::size_t meshes = curve(path).nodes.size();
            std::printf(" %.3f / %.2f / %zu / %zu |", half.volume_ratio, 100 * half.edge_strain_mean,
                        half.flipped.size(), meshes);
            std::fflush(stdout);
        }
        std::printf("\n");
    }
}
