#include "inputs.h"

#include "meshtween/core/error.h"
#include "meshtween/fit/markers.h"
#include "meshtween/fit/quality.h"

#include <fmt/format.h>

#include <memory>

using namespace meshtween;

namespace {
struct Arguments {
    std::string source, fitted, target, truth, markers_system;
    std::vector<std::string> markers;
    bool weld = true;
};
} // namespace

void add_measure(CLI::App& app, const Common& common) {
    auto* verb = app.add_subcommand("measure", "The quality of a fit as JSON on standard output");
    verb->footer("Lengths are percent of the target's bounding-box diagonal.\n"
                 "Example: meshtween measure source.obj fitted.obj target.obj --truth truth.csv --markers markers.csv");
    const auto a = std::make_shared<Arguments>();
    verb->add_option("SOURCE", a->source, "The mesh before the fit")->required();
    verb->add_option("FITTED", a->fitted, "The same mesh after it")->required();
    verb->add_option("TARGET", a->target, "The mesh that it was fitted to")->required();
    verb->add_option("--truth", a->truth, "CSV of x,y,z: where each vertex should be, in order");
    verb->add_option("--markers", a->markers, "Marker pairs to score")->expected(1, 2);
    add_markers_system(*verb, a->markers_system);
    add_weld_flag(*verb, {&a->weld});
    verb->callback([a, &common] {
        Console console(common.quiet);
        const std::vector<Mesh> both = load_alike({a->source, a->fitted}, console);
        const Mesh &source = both[0], &fitted = both[1], target = load_mesh(a->target, console);
        const Points truth = a->truth.empty() ? Points() : read_points(a->truth);
        MarkerPairs markers;
        if (!a->markers.empty()) markers = load_markers(a->markers, source, target, console, a->markers_system);
        fmt::print("{}\n", to_json(measure(source, Comparison(fitted, target, a->weld), truth,
                                           place_markers(markers.pairs, source), common.seed))
                               .dump(2));
    });
}
