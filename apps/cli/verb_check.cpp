#include "inputs.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/check.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/seams.h"

#include <fmt/format.h>

#include <memory>

using namespace meshtween;

namespace {

// Prints what is wrong with one file; true where nothing stops work with it.
bool check_file(const std::string& path) {
    try {
        const Mesh mesh = read_mesh(path);
        fmt::print("{}: {} vertices, {} triangles\n", path, mesh.positions.rows(), mesh.triangles.rows());
        if (mesh.file)
            for (const std::string& note : mesh.file->notes) fmt::print("{}: note: {}\n", path, note);
        bool usable = true;
        for (const Finding& finding : check(mesh, seams(mesh))) {
            fmt::print("{}: {}: {}\n", path, name_of(finding.severity), finding.what);
            usable = usable && finding.severity != Severity::error;
        }
        return usable;
    } catch (const Error& error) {
        fmt::print("{}\n", error.what());
        return false;
    }
}

} // namespace

void add_check(CLI::App& app, const Common&) {
    auto* verb = app.add_subcommand("check", "What is wrong with a mesh, in words with the element's number");
    verb->footer("Elements are numbered from 0. Exit status 3 where a mesh cannot be used at all.\n"
                 "Example: meshtween check scan.ply template.obj");
    const auto paths = std::make_shared<std::vector<std::string>>();
    verb->add_option("MESH", *paths, "Meshes to look at")->required();
    verb->callback([paths] {
        long bad = 0;
        for (const std::string& path : *paths) bad += !check_file(path);
        std::fflush(stdout);
        if (bad > 0) throw Error(ErrorKind::file, fmt::format("{} of {} meshes cannot be used", bad, paths->size()));
    });
}
