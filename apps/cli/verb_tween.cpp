#include "path_inputs.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

using namespace meshtween;

namespace {
struct Arguments {
    std::vector<std::string> meshes;
    std::string report;
    std::vector<std::string> outputs;
    PathFlags path;
};
} // namespace

void add_tween(CLI::App& app, const Common& common) {
    auto* verb = app.add_subcommand("tween", "Shapes between two meshes of one connectivity, or through several");
    verb->footer("Example: meshtween tween standing.obj bowing.obj -o frame_####.obj --frames 25\n"
                 "         meshtween tween walk1.obj walk2.obj walk3.obj --loop -o walk.glb -o walk.svg");
    const auto a = std::make_shared<Arguments>();
    verb->add_option("MESH", a->meshes,
                     "The shapes in their order, two or more, with the same vertices and faces in the same order")
        ->required()
        ->expected(-2);
    verb->add_option("-o,--output", a->outputs,
                     "x.glb, x.usda, x.html, x.png, x.apng, x.svg, frame_####.obj, or x.obj with --at; may be given "
                     "several times")
        ->required()
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    verb->add_option("--report", a->report, "Write what was found out as JSON, the path's quality frame by frame");
    verb->add_option("--times", a->path.times,
                     "When each shape is passed, rising from 0 to 1, one a shape (and one more with --loop)")
        ->delimiter(',')
        ->expected(1, 10001);
    add_path_flags(*verb, a->path);
    add_weld_flag(*verb, {&a->path.options.weld});
    verb->callback([a, &common] {
        const auto start = std::chrono::steady_clock::now();
        Console console(common.quiet);
        Json report = new_report("tween");
        PathWork work;
        work.outputs = load_outputs(a->outputs);
        a->path.at.empty() ? check_playable(work.outputs) : check_still(work.outputs);
        const std::vector<Mesh> meshes = load_one_connectivity(a->meshes, console);
        for (const Mesh& mesh : meshes) {
            report["keys"].push_back(describe(mesh));
            work.shapes.push_back(mesh.positions);
        }
        work.mesh = meshes.front();
        work.title = title_of(a->meshes);
        work.measured = !a->report.empty();
        write_path(work, a->path, console.progress(), console, report);
        finish_report(report, a->report, start);
    });
}
