#include "path_inputs.h"

#include "meshtween/core/error.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numeric>

using namespace meshtween;

namespace {

struct Arguments {
    std::vector<std::string> meshes, outputs;
    std::vector<double> weights;
    std::string report;
    PathFlags path;
};

// Weights that add up to 1; equal ones where none were given.
std::vector<double> shares(std::vector<double> weights, std::size_t count) {
    if (weights.empty()) weights.assign(count, 1);
    if (weights.size() != count)
        throw Error(ErrorKind::argument,
                    fmt::format("--weights has {} numbers for {} meshes; one each is needed", weights.size(), count));
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!std::isfinite(sum) || !(sum > 1e-3))
        throw Error(ErrorKind::argument, fmt::format("--weights add up to {:g}; their sum must be above 0", sum));
    for (double& weight : weights) weight /= sum;
    return weights;
}

} // namespace

void add_blend(CLI::App& app, const Common& common) {
    auto* verb = app.add_subcommand("blend", "One shape from several of one connectivity: a mean, or a caricature");
    verb->footer("Weights are divided by their sum. One below 0 leads away from its shape: 1.5,-0.5 overdoes what sets "
                 "the first apart from the second.\n"
                 "Example: meshtween blend anna.obj bea.obj cleo.obj --weights 1,1,2 -o mean.obj");
    const auto a = std::make_shared<Arguments>();
    verb->add_option("MESH", a->meshes, "Meshes with the same vertices and faces in the same order")
        ->required()
        ->expected(-2);
    verb->add_option("--weights", a->weights, "A number a mesh, with commas; all alike where none are given")
        ->delimiter(',')
        ->expected(1, 10000);
    verb->add_option("-o,--output", a->outputs,
                     "x.obj, .ply, .stl, .off, .glb, .vtk, .vtp, .usda or .png; may be given several times")
        ->required()
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    verb->add_option("--report", a->report, "Write what was found out as JSON");
    add_method_flags(*verb, a->path);
    add_weld_flag(*verb, {&a->path.options.weld});
    verb->callback([a, &common] {
        const auto start = std::chrono::steady_clock::now();
        Console console(common.quiet);
        Json report = new_report("blend");
        const auto outputs = load_outputs(a->outputs);
        const std::vector<double> weights = shares(a->weights, a->meshes.size());
        const std::vector<Mesh> meshes = load_one_connectivity(a->meshes, console);
        std::vector<Points> shapes;
        for (const Mesh& mesh : meshes) shapes.push_back(mesh.positions);
        MorphOptions options = a->path.options;
        options.method = morph_method(a->path.method);
        Mesh blended = meshes.front();
        blended.positions = blend(blended, shapes, weights, options);
        stop_if_interrupted();
        report["weights"] = weights;
        report["method"] = a->path.method;
        report["blend"] = describe(blended);
        tell_written(write_still(blended, "blend", {}, outputs, {}, a->path.writing), console, report);
        finish_report(report, a->report, start);
    });
}
