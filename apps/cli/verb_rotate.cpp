#include "inputs.h"

#include "meshtween/core/error.h"
#include "meshtween/fit/rotate.h"
#include "meshtween/io/rotation_markers.h"

#include <fmt/format.h>

#include <memory>

using namespace meshtween;

namespace {

struct Arguments {
    std::string mesh, markers, markers_system;
    std::vector<double> axis, centre;
    double angle = 0;
    std::vector<std::string> outputs;
    WriteOptions writing;
};

Point point(const std::vector<double>& xyz) {
    return {xyz[0], xyz[1], xyz[2]};
}

} // namespace

void add_rotate(CLI::App& app, const Common& common) {
    auto* verb = app.add_subcommand("rotate", "Turn a part of a mesh about an axis, the warp taking the rest along");
    verb->footer("The markers' file has rows of name,x,y,z,role: role \"turn\" for points that turn, \"hold\" for "
                 "points that stay.\n"
                 "Example: meshtween rotate woman.obj --markers head.csv --axis 0,1,0 --centre 0,1.5,0 --angle 60 -o "
                 "turned.obj");
    const auto a = std::make_shared<Arguments>();
    verb->add_option("MESH", a->mesh, "Mesh to deform")->required();
    verb->add_option("--markers", a->markers, "CSV of name,x,y,z,role")->required();
    add_markers_system(*verb, a->markers_system);
    verb->add_option("--axis", a->axis, "X,Y,Z of the axis' direction")->required()->delimiter(',')->expected(3);
    verb->add_option("--centre", a->centre, "X,Y,Z of a point on the axis")->required()->delimiter(',')->expected(3);
    verb->add_option("--angle", a->angle, "Degrees, counter-clockwise seen against the axis; any size")->required();
    verb->add_option("-o,--output", a->outputs,
                     "x.obj, .ply, .stl, .off, .glb, .vtk, .vtp, .usda or .png; may be given several times")
        ->required()
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_write_flags(*verb, a->writing);
    verb->callback([a, &common] {
        Console console(common.quiet);
        const auto outputs = load_outputs(a->outputs);
        const Mesh mesh = load_mesh(a->mesh, console);
        const RotationMarkers markers = read_rotation_markers(a->markers, mesh, marker_reading(a->markers_system));
        console.warn("", markers.notes);
        Mesh turned = mesh;
        turned.positions =
            rotate(mesh.positions, markers.turn, markers.hold, point(a->axis), point(a->centre), a->angle);
        const Written written = write_still(turned, fmt::format("turned by {:g} degrees", a->angle),
                                            {{"before", mesh, markers.turn}}, outputs, {}, a->writing);
        tell_written(written, console);
    });
}
