#include "fit_run.h"
#include "path_inputs.h"

#include <memory>

using namespace meshtween;

namespace {

struct Arguments {
    std::string source, target, template_mesh;
    std::vector<std::string> markers, markers_a, markers_b, outputs;
    FitFlags fit;
    PathFlags path;
    std::string report;
};

Points side(const MarkerPairs& markers, bool source) {
    Points points(std::ssize(markers.pairs), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const MarkerPair& pair = markers.pairs[static_cast<std::size_t>(i)];
        points.row(i) = source ? pair.source : pair.target;
    }
    return points;
}

// Source to target: one fit.
void morph_two(const Arguments& a, std::uint32_t seed, Console& console, Json& report) {
    const auto outputs = load_outputs(a.outputs);
    a.path.at.empty() ? check_playable(outputs) : check_still(outputs);
    check_fit_files(a.fit);
    const Mesh source = load_mesh(a.source, console, report["source"]),
               target = load_mesh(a.target, console, report["target"]);
    const MarkerPairs markers = load_markers(a.markers, source, target, console);
    const Progress progress = console.progress();
    const Fitted fitted = run_fit(source, target, markers, a.fit, seed, part_of(progress, 0, 0.6), console);
    report["fit"] = fitted.report;
    const std::vector<Tile> tiles{{"source", source, side(markers, true)},
                                  {"target", target, side(markers, false)},
                                  {"source's mesh on the target", fitted.mesh, {}}};
    write_path({fitted.source,
                {fitted.source.positions, fitted.mesh.positions},
                outputs,
                tiles,
                title_of({a.source, a.target}),
                !a.report.empty(),
                true},
               a.path, part_of(progress, 0.6, 1), console, report);
    write_fit_files(fitted, a.fit, a.path.writing, console, report);
}

// One template on both shapes (the paper's Fig. 12), then from one fit to the other.
void morph_through_template(const Arguments& a, std::uint32_t seed, Console& console, Json& report) {
    const auto outputs = load_outputs(a.outputs);
    a.path.at.empty() ? check_playable(outputs) : check_still(outputs);
    const Mesh common = load_mesh(a.template_mesh, console, report["template"]),
               first = load_mesh(a.source, console, report["source"]),
               second = load_mesh(a.target, console, report["target"]);
    const MarkerPairs to_first = load_markers(a.markers_a, common, first, console);
    const MarkerPairs to_second = load_markers(a.markers_b, common, second, console);
    const Progress progress = console.progress();
    const Fitted from = run_fit(common, first, to_first, a.fit, seed, part_of(progress, 0, 0.35), console);
    const Fitted to = run_fit(common, second, to_second, a.fit, seed, part_of(progress, 0.35, 0.7), console);
    report["fit_source"] = from.report, report["fit_target"] = to.report;
    const std::vector<Tile> tiles{{"template", common, side(to_first, true)},
                                  {"source", first, side(to_first, false)},
                                  {"target", second, side(to_second, false)}};
    write_path({from.mesh,
                {from.mesh.positions, to.mesh.positions},
                outputs,
                tiles,
                title_of({a.source, a.target}),
                !a.report.empty()},
               a.path, part_of(progress, 0.7, 1), console, report);
}

} // namespace

void add_morph(CLI::App& app, const Common& common) {
    auto* verb = app.add_subcommand("morph", "Fit the source's mesh to the target and write every shape between them");
    verb->footer("Example: meshtween morph igea.ply planck.obj --markers markers.csv -o morph.glb -o morph.png");
    const auto a = std::make_shared<Arguments>();
    verb->add_option("SOURCE", a->source, "Mesh to start from, whose connectivity everything keeps")->required();
    verb->add_option("TARGET", a->target, "Mesh to end at")->required();
    auto* markers =
        verb->add_option(
                "--markers", a->markers,
                "Marker pairs in one file, or the source's and the target's file; without, the start is a guess")
            ->expected(1, 2);
    auto* with_template =
        verb->add_option("--template", a->template_mesh, "Mesh fitted to both, whose connectivity is kept");
    verb->add_option("--markers-a", a->markers_a, "Template and SOURCE")->expected(1, 2)->needs(with_template);
    verb->add_option("--markers-b", a->markers_b, "Template and TARGET")->expected(1, 2)->needs(with_template);
    with_template->excludes(markers);
    verb->add_option("-o,--output", a->outputs,
                     "x.glb, x.html, x.png, x.apng, x.svg or frame_####.obj; may be given several times")
        ->required()
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    verb->add_option("--report", a->report, "Write what was found out as JSON");
    add_fit_flags(*verb, a->fit);
    add_fit_files(*verb, a->fit);
    for (const char* of_one_fit : {"--map", "--weights", "--refine"})
        with_template->excludes(verb->get_option(of_one_fit));
    add_path_flags(*verb, a->path);
    add_weld_flag(*verb, {&a->fit.options.weld, &a->path.options.weld});
    verb->callback([a, &common] {
        const auto start = std::chrono::steady_clock::now();
        Console console(common.quiet);
        Json report = new_report("morph");
        if (a->template_mesh.empty())
            morph_two(*a, common.seed, console, report);
        else
            morph_through_template(*a, common.seed, console, report);
        finish_report(report, a->report, start);
    });
}
