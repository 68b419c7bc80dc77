#include "fit_run.h"
#include "look_run.h"

#include <memory>

using namespace meshtween;

namespace {
struct Arguments {
    std::string source, target, truth, markers_system, report;
    std::vector<std::string> markers, outputs;
    WriteOptions writing;
    FitFlags fit;
    LookFlags look;
};
} // namespace

void add_fit(CLI::App& app, const Common& common) {
    auto* verb = app.add_subcommand("fit", "Bring the source's mesh onto the target's surface");
    verb->footer("Example: meshtween fit template.ply scan.ply --markers markers.csv -o fitted.ply --report fit.json");
    const auto a = std::make_shared<Arguments>();
    verb->add_option("SOURCE", a->source, "Mesh whose connectivity is kept")->required();
    verb->add_option("TARGET", a->target, "Mesh whose surface it is brought to")->required();
    verb->add_option("--markers", a->markers,
                     "Marker pairs in one file, or the source's and the target's file; without, the start is a guess")
        ->expected(1, 2);
    add_markers_system(*verb, a->markers_system);
    verb->add_option("-o,--output", a->outputs,
                     "x.obj, .ply, .stl, .off, .glb, .vtk, .vtp, .usda or .png; may be given several times")
        ->required()
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    verb->add_option("--report", a->report, "Write what was found out as JSON");
    add_fit_flags(*verb, a->fit);
    add_weld_flag(*verb, {&a->fit.options.weld});
    add_fit_files(*verb, a->fit);
    add_write_flags(*verb, a->writing);
    add_appearance_flag(*verb, a->look, {"source", "target"});
    verb->callback([a, &common] {
        const auto start = std::chrono::steady_clock::now();
        Console console(common.quiet);
        Json report = new_report("fit");
        const auto outputs = load_outputs(a->outputs);
        check_still(outputs);
        check_fit_files(a->fit);
        const Mesh source = load_mesh(a->source, console, report["source"]),
                   target = load_mesh(a->target, console, report["target"]);
        const bool dressed = a->look.appearance == "target";
        if (dressed) require_look(target, a->target);
        const MarkerPairs markers = load_markers(a->markers, source, target, console, a->markers_system);
        const Progress progress = console.progress();
        const Fitted fitted = run_fit(source, target, markers, a->fit, common.seed, part_of(progress, 0, 0.8), console);
        report["fit"] = fitted.report;
        const Mesh result = dressed ? run_look(fitted.mesh, target, {a->source, a->target, a->outputs.front()}, a->look,
                                               part_of(progress, 0.8, 0.95), console, report["look"])
                                    : fitted.mesh;
        const Written written =
            write_still(result, "source's mesh on the target", {{"source", source, {}}, {"target", target, {}}},
                        outputs, part_of(progress, 0.95, 1), a->writing);
        stop_if_interrupted();
        tell_written(written, console, report);
        write_fit_files(fitted, a->fit, a->writing, console, report);
        finish_report(report, a->report, start);
    });
}
