#include "fit_run.h"
#include "look_run.h"
#include "path_inputs.h"

#include "meshtween/core/error.h"

#include <memory>

using namespace meshtween;

namespace {

struct Arguments {
    std::string source, target, template_mesh, markers_system;
    std::vector<std::string> markers, markers_a, markers_b, outputs;
    FitFlags fit;
    PathFlags path;
    LookFlags look;
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

bool shows_source(const LookFlags& look) {
    return look.appearance == "source" || look.appearance == "both";
}

bool shows_target(const LookFlags& look) {
    return look.appearance == "target" || look.appearance == "both";
}

// The path's mesh with the target's look, or fading to it. `dressed` is the mesh on the target with the target's look.
void show_target(PathWork& work, Mesh dressed, const LookFlags& look) {
    dressed.positions = work.mesh.positions;
    if (look.appearance == "both")
        work.other = std::make_shared<const Mesh>(std::move(dressed));
    else
        work.mesh = std::move(dressed);
}

// Source to target: one fit.
void morph_two(const Arguments& a, std::uint32_t seed, Console& console, Json& report) {
    const auto outputs = load_outputs(a.outputs);
    a.path.at.empty() ? check_playable(outputs) : check_still(outputs);
    check_fit_files(a.fit);
    const Mesh source = load_mesh(a.source, console, report["source"]),
               target = load_mesh(a.target, console, report["target"]);
    if (shows_target(a.look)) require_look(target, a.target);
    const MarkerPairs markers = load_markers(a.markers, source, target, console, a.markers_system);
    const Progress progress = console.progress();
    const Fitted fitted = run_fit(source, target, markers, a.fit, seed, part_of(progress, 0, 0.55), console);
    report["fit"] = fitted.report;
    const std::vector<Tile> tiles{{"source", source, side(markers, true)},
                                  {"target", target, side(markers, false)},
                                  {"source's mesh on the target", fitted.mesh, {}}};
    PathWork work{fitted.source,
                  {fitted.source.positions, fitted.mesh.positions},
                  outputs,
                  tiles,
                  title_of({a.source, a.target}),
                  !a.report.empty(),
                  true};
    if (shows_target(a.look)) {
        const Progress part = part_of(progress, 0.55, 0.6);
        show_target(
            work, run_look(fitted.mesh, target, {a.source, a.target, a.outputs}, a.look, part, console, report["look"]),
            a.look);
        work.ends_before = false; // they would not show it
    }
    write_path(work, a.path, part_of(progress, 0.6, 1), console, report);
    write_fit_files(fitted, a.fit, a.path.writing, console, report);
}

// One template on both shapes (the paper's Fig. 12), then from one fit to the other.
void morph_through_template(const Arguments& a, std::uint32_t seed, Console& console, Json& report) {
    const auto outputs = load_outputs(a.outputs);
    a.path.at.empty() ? check_playable(outputs) : check_still(outputs);
    const Mesh common = load_mesh(a.template_mesh, console, report["template"]),
               first = load_mesh(a.source, console, report["source"]),
               second = load_mesh(a.target, console, report["target"]);
    if (shows_source(a.look)) require_look(first, a.source);
    if (shows_target(a.look)) require_look(second, a.target);
    const MarkerPairs to_first = load_markers(a.markers_a, common, first, console, a.markers_system);
    const MarkerPairs to_second = load_markers(a.markers_b, common, second, console, a.markers_system);
    const Progress progress = console.progress();
    const Fitted from = run_fit(common, first, to_first, a.fit, seed, part_of(progress, 0, 0.35), console);
    const Fitted to = run_fit(common, second, to_second, a.fit, seed, part_of(progress, 0.35, 0.7), console);
    report["fit_source"] = from.report, report["fit_target"] = to.report;
    const std::vector<Tile> tiles{{"template", common, side(to_first, true)},
                                  {"source", first, side(to_first, false)},
                                  {"target", second, side(to_second, false)}};
    PathWork work{from.mesh, {from.mesh.positions, to.mesh.positions}, outputs,
                  tiles,     title_of({a.source, a.target}),           !a.report.empty()};
    const LookNames names{a.template_mesh, a.source, a.outputs}, other_names{a.template_mesh, a.target, a.outputs};
    if (shows_source(a.look))
        work.mesh =
            run_look(from.mesh, first, names, a.look, part_of(progress, 0.7, 0.75), console, report["look_source"]);
    if (shows_target(a.look))
        show_target(work,
                    run_look(to.mesh, second, other_names, a.look, part_of(progress, 0.75, 0.8), console,
                             report["look_target"]),
                    a.look);
    write_path(work, a.path, part_of(progress, 0.8, 1), console, report);
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
    add_markers_system(*verb, a->markers_system);
    verb->add_option("-o,--output", a->outputs,
                     "x.glb, x.usda, x.html, x.png, x.apng, x.svg or frame_####.obj; may be given several times")
        ->required()
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    verb->add_option("--report", a->report, "Write what was found out as JSON");
    add_fit_flags(*verb, a->fit);
    add_fit_files(*verb, a->fit);
    for (const char* of_one_fit : {"--map", "--weights", "--refine"})
        with_template->excludes(verb->get_option(of_one_fit));
    add_path_flags(*verb, a->path);
    add_appearance_flag(*verb, a->look, {"source", "target", "both"});
    add_weld_flag(*verb, {&a->fit.options.weld, &a->path.options.weld});
    verb->callback([a, &common] {
        const auto start = std::chrono::steady_clock::now();
        Console console(common.quiet);
        Json report = new_report("morph");
        if (a->path.loop && a->look.appearance == "both")
            throw Error(ErrorKind::argument, "--appearance both does not come back to the first look as --loop does; "
                                             "leave one of them out (GLB and HTML go back and forth without --loop)");
        if (a->template_mesh.empty())
            morph_two(*a, common.seed, console, report);
        else
            morph_through_template(*a, common.seed, console, report);
        finish_report(report, a->report, start);
    });
}
