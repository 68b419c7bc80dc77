#include "inputs.h"

#include "meshtween/core/error.h"

#include <fmt/format.h>

#include <memory>

using namespace meshtween;

namespace {
struct Arguments {
    std::string from, to, report;
    std::vector<std::string> outputs;
    PathFlags path;
};
} // namespace

void add_tween(CLI::App& app, const Common& common) {
    auto* verb = app.add_subcommand("tween", "Shapes between two meshes of one connectivity");
    verb->footer("Example: meshtween tween standing.obj bowing.obj -o frame_####.obj --frames 25");
    const auto a = std::make_shared<Arguments>();
    verb->add_option("FROM", a->from, "Mesh at u = 0")->required();
    verb->add_option("TO", a->to, "Mesh at u = 1, with the same vertices and faces in the same order")->required();
    verb->add_option("-o,--output", a->outputs, "x.glb, x.html, x.png, frame_####.obj, or x.obj with --at")
        ->required()
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    verb->add_option("--report", a->report, "Write what was found out as JSON");
    add_path_flags(*verb, a->path);
    verb->callback([a, &common] {
        const auto start = std::chrono::steady_clock::now();
        Console console(common.quiet);
        Json report = new_report("tween");
        const auto outputs = load_outputs(a->outputs);
        const Mesh from = load_mesh(a->from, console), to = load_mesh(a->to, console);
        if (from.positions.rows() != to.positions.rows() || from.triangles.rows() != to.triangles.rows() ||
            from.triangles != to.triangles)
            throw Error(
                ErrorKind::file,
                fmt::format(
                    "{} ({} vertices, {} triangles) and {} ({}, {}) are not of one connectivity; bring the first "
                    "onto the second with meshtween fit",
                    a->from, from.positions.rows(), from.triangles.rows(), a->to, to.positions.rows(),
                    to.triangles.rows()));
        report["from"] = describe(from), report["to"] = describe(to);
        write_path(from, to.positions, a->path, outputs, {}, a->from + " to " + a->to, console.progress(), console,
                   report);
        finish_report(report, a->report, start);
    });
}
