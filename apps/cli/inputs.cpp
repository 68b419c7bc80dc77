#include "inputs.h"

#include "meshtween/core/version.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/check.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include <fmt/format.h>

using namespace meshtween;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Mesh load_mesh(const std::string& path, Console& console) {
    Mesh mesh = read_mesh(path);
    for (const Finding& finding : check(mesh)) {
        if (finding.severity == Severity::error)
            throw Error(ErrorKind::file, fmt::format("{}: {}", path, finding.what));
        if (finding.severity == Severity::warning) console.warn(fmt::format("{}: {}", path, finding.what));
    }
    stop_if_interrupted();
    return mesh;
}

MarkerPairs load_markers(const std::vector<std::string>& files, const Mesh& source, const Mesh& target,
                         Console& console) {
    if (files.empty()) return {};
    MarkerPairs markers = files.size() == 2 ? read_marker_pairs(files[0], files[1], source, target)
                                            : read_marker_pairs(files[0], source, target);
    console.warn(files[0] + ": ", markers.notes);
    if (markers.pairs.empty())
        throw Error(ErrorKind::file,
                    fmt::format("{}: no usable pair of markers; correct the file, or leave --markers out", files[0]));
    return markers;
}

std::vector<Output> load_outputs(const std::vector<std::string>& names) {
    std::vector<Output> outputs;
    outputs.reserve(names.size());
    for (const std::string& name : names) outputs.push_back(output(name));
    return outputs;
}

void add_path_flags(CLI::App& verb, PathFlags& flags) {
    std::vector<std::string> methods;
    for (const MorphMethod method : morph_methods()) methods.emplace_back(name_of(method));
    verb.add_option("--method", flags.method, "Path between the shapes")
        ->check(CLI::IsMember(methods))
        ->capture_default_str();
    verb.add_option("--frames", flags.frames, "Frames of a numbered sequence, both ends included")
        ->check(CLI::Range(2, 100000))
        ->capture_default_str();
    verb.add_option("--at", flags.at, "Write only the shape at this u, 0 (source) to 1 (target)")
        ->check(CLI::Validator(
            [](const std::string& text) { // a range check alone lets nan through
                double u = 0;
                return CLI::detail::lexical_cast(text, u) && u >= 0 && u <= 1 ? ""
                                                                              : text + " is not a number from 0 to 1";
            },
            "0..1"))
        ->expected(1);
    verb.add_option("--c1", flags.options.c1, "C1 of the dual method's Eq. 12, over 1")->capture_default_str();
    verb.add_option("--c2", flags.options.c2, "C2 of the dual method's Eq. 12, under 1")->capture_default_str();
}

void write_path(const Mesh& from, const Points& to, PathFlags flags, const std::vector<Output>& outputs,
                const std::vector<Tile>& before, const std::string& title, const Progress& progress, Console& console,
                Json& report) {
    const auto start = std::chrono::steady_clock::now();
    flags.options.method = morph_method(flags.method);
    const Morph path = morph(from, to, flags.options, part_of(progress, 0, 0.3));
    stop_if_interrupted();
    Mesh first = from;
    Written written;
    if (flags.at.empty()) {
        first.positions = path.at(0);
        written = write_outputs({first, path, {}, flags.frames, title, before}, outputs, part_of(progress, 0.3, 1));
    } else {
        first.positions = path.at(flags.at.front());
        written =
            write_still(first, fmt::format("u = {:.3g}", flags.at.front()), before, outputs, part_of(progress, 0.3, 1));
    }
    stop_if_interrupted();
    Json& row = report["path"] = {{"method", name_of(flags.options.method)}, {"seconds", seconds_since(start)}};
    if (written.nodes > 0) row["curve"] = {{"meshes", written.nodes}, {"deviation", written.deviation}};
    if (path.report) {
        const SolveReport solve = path.report();
        row["solve"] = {{"sweeps", solve.sweeps}, {"residual", solve.residual}, {"converged", solve.converged}};
        if (!solve.converged)
            console.warn(
                fmt::format("the path's solve stopped after {} sweeps with a residual of {:.2g}; set --c1 and --c2 "
                            "further from 1, or use another --method",
                            solve.sweeps, solve.residual));
    }
    row["shapes"] = path_report(from, path, flags.at.empty() ? std::vector<double>{0, 0.25, 0.5, 0.75, 1} : flags.at);
    for (const auto& file : written.files) {
        report["outputs"].push_back(file.string());
        console.note("wrote " + file.string());
    }
}

Json new_report(const std::string& verb) {
    return {{"program", "meshtween"}, {"version", meshtween::version()}, {"verb", verb}};
}

void finish_report(Json& report, const std::string& file, std::chrono::steady_clock::time_point start) {
    report["threads"] = threads();
    report["seconds"] = seconds_since(start);
    report["peak_memory_mib"] = peak_memory_mib();
    if (!file.empty()) write_whole(file, report.dump(2) + "\n");
}
