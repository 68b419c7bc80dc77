#include "fit_run.h"

#include "meshtween/core/error.h"
#include "meshtween/fit/counterpart.h"
#include "meshtween/fit/markers.h"
#include "meshtween/fit/quality.h"
#include "meshtween/fit/refined_fit.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

using namespace meshtween;

namespace {

// A range check alone lets nan through.
CLI::Validator a_number_in(double least, double most) {
    return CLI::Validator(
        [=](const std::string& text) {
            double value = 0;
            return CLI::detail::lexical_cast(text, value) && value >= least && value <= most
                       ? ""
                       : fmt::format("{} is not a number from {} to {}", text, least, most);
        },
        fmt::format("{}..{}", least, most));
}

bool names_a_mesh(const std::string& file) {
    const std::string extension = std::filesystem::path(file).extension().string();
    const auto& known = mesh_extensions();
    return std::find(known.begin(), known.end(), extension) != known.end();
}

Json refined_report(const RefinedFit& done, const Mesh& source) {
    return {{"vertices_before", source.positions.rows()},
            {"vertices", done.source.positions.rows()},
            {"added", done.added},
            {"edges_still_too_coarse", done.left}};
}

} // namespace

void add_fit_flags(CLI::App& verb, FitFlags& flags) {
    static const std::map<std::string, FitMethod> methods{{"paper", FitMethod::paper}, {"surface", FitMethod::surface}};
    verb.add_option("--fit", flags.options.method,
                    "How to fit: surface (a thin shell posed by the markers, then drawn onto the "
                    "surface from coarse to fine) or paper (warp, then smooth and project)")
        ->transform(CLI::CheckedTransformer(methods))
        ->option_text("surface|paper [surface]");
    verb.add_option("--marker-weight", flags.options.marker_weight,
                    "How hard markers pull in the surface fit beside the usual 1: they yield where it is under 0.0001 "
                    "or so; 0 lets them say the pose only")
        ->check(a_number_in(0, 10))
        ->capture_default_str();
    verb.add_flag("--markers-exact", flags.options.markers_exact,
                  "Meet every marker to 1e-9 of the diagonal, also where that leaves the surface a little");
    verb.add_flag_callback(
        "--no-symmetry", [&flags] { flags.options.symmetry = false; },
        "Do not give markers twins on the other side where source and target are their own mirror images");
    static const std::map<std::string, PartsMode> modes{
        {"auto", PartsMode::automatic}, {"follow", PartsMode::follow}, {"fit", PartsMode::fit}};
    verb.add_option("--parts", flags.options.parts,
                    "Of the source's loose parts without a marker: auto carries small ones along with the surface "
                    "around them, follow all but the largest, fit none")
        ->transform(CLI::CheckedTransformer(modes))
        ->option_text("auto|follow|fit [auto]");
    static const std::map<std::string, TargetLayer> layers{
        {"outer", TargetLayer::outer}, {"inner", TargetLayer::inner}, {"both", TargetLayer::both}};
    verb.add_option("--layer", flags.options.layer,
                    "Which to fit to where the target has one surface over another, as cloth over skin")
        ->transform(CLI::CheckedTransformer(layers))
        ->option_text("outer|inner|both [outer]");
    verb.add_flag("--keep-parts", flags.options.keep_parts,
                  "Fit to small parts of the target without a marker as well, which are left out as clutter otherwise");
    verb.add_flag("--on-surface", flags.options.on_surface,
                  "Leave every vertex exactly on the target; else each is lifted by so much that the triangles between "
                  "them lie on it in the mean");
    verb.add_option("--kernel", flags.kernel, "Of the paper's marker warp: thin-plate (r^2 log r) or linear (r)")
        ->check(CLI::IsMember({"thin-plate", "linear"}))
        ->capture_default_str();
    verb.add_option("--smoothing", flags.options.warp.smoothing,
                    "Let the paper's warp miss markers a little; 0 meets them exactly")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    verb.add_option("--rounds", flags.options.max_rounds, "Rounds of the paper's smoothing and projection at most")
        ->check(CLI::Range(0, 100000))
        ->capture_default_str();
    verb.add_option("--threshold", flags.options.threshold,
                    "Stop the paper's rounds where the RMS distance falls under this part of the target's diagonal")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
}

void add_fit_files(CLI::App& verb, FitFlags& flags) {
    verb.add_option("--map", flags.map,
                    "Write CSV of vertex,triangle,a,b,c,distance: the target's triangle and barycentric point for each "
                    "vertex");
    verb.add_option("--refine", flags.refine,
                    "Cut the source's triangles where they are too coarse for the target, and write the finer source "
                    "here: x.ply, .obj, .off or .glb");
    verb.add_option("--weights", flags.weights,
                    "Write how far each vertex can be trusted: CSV, or a .ply, .obj, .off or .glb of the fitted mesh "
                    "coloured by it");
}

void check_fit_files(const FitFlags& flags) {
    if (!flags.refine.empty() && (!names_a_mesh(flags.refine) || flags.refine.ends_with(".stl")))
        throw Error(ErrorKind::argument, fmt::format("--refine {}: name a mesh that keeps the order of vertices: .ply, "
                                                     ".obj, .off or .glb",
                                                     flags.refine));
}

void write_fit_files(const Fitted& fitted, const FitFlags& flags, const WriteOptions& writing, Console& console,
                     Json& report) {
    const auto tell = [&](const std::string& file, std::vector<std::string> notes = {}) {
        tell_written({{file}, std::move(notes)}, console, report);
    };
    if (!flags.refine.empty()) {
        tell(flags.refine, write_mesh(fitted.source, flags.refine, writing));
    }
    if (!flags.map.empty()) {
        write_map(fitted.map, flags.map);
        tell(flags.map);
    }
    if (!flags.weights.empty()) {
        if (names_a_mesh(flags.weights)) {
            Mesh coloured = fitted.mesh;
            coloured.colors = trust_colors(fitted.map);
            tell(flags.weights, write_mesh(coloured, flags.weights, writing));
        } else {
            write_weights(fitted.map, flags.weights);
            tell(flags.weights);
        }
    }
}

Fitted run_fit(const Mesh& source, const Mesh& target, const MarkerPairs& markers, const FitFlags& flags,
               std::uint32_t seed, const Progress& progress, Console& console) {
    const auto start = std::chrono::steady_clock::now();
    FitOptions options = flags.options;
    if (options.method == FitMethod::paper && markers.pairs.size() < 3)
        throw Error(ErrorKind::argument,
                    fmt::format("--fit paper needs 3 pairs of markers at least, here {} {}; add some, or use --fit "
                                "surface, which does with any number",
                                markers.pairs.size() == 1 ? "is" : "are", markers.pairs.size()));
    options.warp.kernel = flags.kernel == "linear" ? Kernel::linear : Kernel::thin_plate;
    std::vector<Marker> placed = place_markers(markers.pairs, source);
    const Progress fitting = part_of(progress, 0, 0.8);
    const RefinedFit done = flags.refine.empty()
                                ? RefinedFit{source, fit(source, target, placed, options, fitting), {}, 0}
                                : refined_fit(source, target, placed, options, {}, fitting);
    const FitResult& result = done.fit;
    stop_if_interrupted();
    const double seconds = seconds_since(start);
    console.warn("", result.notes);

    Fitted fitted{done.source, done.source, {}, to_json(result)};
    if (!flags.refine.empty()) {
        fitted.report["refined"] = refined_report(done, source);
        placed = place_markers(markers.pairs, fitted.source);
        console.note(done.added.empty()
                         ? "refine: the source is fine enough as it is"
                         : fmt::format("refine: {} vertices became {} in {} rounds", source.positions.rows(),
                                       done.source.positions.rows(), done.added.size()));
    }
    fitted.mesh.positions = result.positions;
    fitted.report["seconds"] = seconds;
    keep_going(progress, 0.8, "measuring");
    const Comparison both(fitted.mesh, target, options.weld);
    const Quality quality = measure(fitted.source, both, {}, placed, seed);
    keep_going(progress, 0.9, "finding places");
    fitted.map = correspondence(both);
    set_aside(fitted.map, result.carried);
    const AnsweredQuality answered =
        answered_quality(fitted.source, both, quality, fitted.map.border, result.left_out, seed);
    fitted.report["answered"] = to_json(answered);
    fitted.report.update(fit_places(fitted.source, fitted.mesh, target, result, fitted.map, quality, placed));
    fitted.report["quality"] = to_json(quality);
    stop_if_interrupted();
    if (result.twins > 0)
        console.note(fmt::format("symmetry: both shapes are their own mirror images, {} marker{} drew on the other "
                                 "side as well (--no-symmetry leaves that out)",
                                 result.twins, result.twins == 1 ? "" : "s"));
    const auto copies = [](const Weld& seams) { return std::ssize(seams.vertex) - std::ssize(seams.first); };
    if (quality.copies > 0 || both.target_seams.any())
        console.note(
            fmt::format("seams: {} vertices of the source and {} of the target repeat others where their files "
                        "are cut; each counts once (--no-weld leaves the cuts open)",
                        quality.copies, copies(both.target_seams)));
    const auto beyond = std::ranges::count(fitted.map.border, 1);
    if (100 * beyond > fitted.mesh.positions.rows())
        console.note(fmt::format("beyond: the target ends before {} of {} vertices: nothing on it answers to them, and "
                                 "they follow the rest (--weights says which)",
                                 beyond, fitted.mesh.positions.rows()));
    console.note(fmt::format("fit: {:.4f} % to the target, {:.4f} % back, {} flipped of {} faces, {} cuts, {:.2f} s",
                             answered.fitted_to_target.mean, answered.target_to_fitted.mean, answered.flipped.size(),
                             answered.faces, answered.cuts, seconds));
    if (1000 * std::ssize(answered.flipped) > answered.faces)
        console.warn(placed.empty()
                         ? "the mesh is folded in places (guards and worst in --report say where); a few markers "
                           "around them unfold it"
                         : "the mesh is folded in places (guards and worst in --report say where); a marker "
                           "that disagrees with its neighbours folds it, a few more around the place unfold "
                           "it");
    return fitted;
}
