#include "path_inputs.h"

#include "meshtween/core/error.h"
#include "meshtween/fit/faded_look.h"
#include "meshtween/morph/path_quality.h"

#include <fmt/format.h>

using namespace meshtween;

namespace {

// A range check alone lets nan through.
CLI::Validator number_between(double low, double high, const std::string& name) {
    return CLI::Validator(
        [=](const std::string& text) {
            double value = 0;
            return CLI::detail::lexical_cast(text, value) && value >= low && value <= high
                       ? std::string()
                       : fmt::format("{} is not a number from {} to {}", text, low, high);
        },
        name);
}

void add_play_flags(CLI::App& verb, PathFlags& flags) {
    verb.add_option("--ease", flags.ease, "Slow at the start (in), at the end (out) or both (in-out); or linear")
        ->check(CLI::IsMember({"linear", "in", "out", "in-out"}))
        ->capture_default_str();
    verb.add_option("--seconds", flags.seconds, "How long GLB and HTML play from the first shape to the last")
        ->check(number_between(0.01, 100000, "0.01..100000"))
        ->capture_default_str();
    auto* once = verb.add_flag("--once", flags.once, "GLB and HTML play from the first shape to the last only");
    auto* back = verb.add_flag("--ping-pong", flags.ping_pong,
                               "Sequences go back again too, without showing an end twice (GLB and HTML do anyway)");
    verb.add_flag("--loop", flags.loop, "The last shape goes on to the first, with one speed all the way round")
        ->excludes(once)
        ->excludes(back);
    once->excludes(back);
    verb.add_option("--regions", flags.regions,
                    "When each part moves: CSV of name,x,y,z,start,end or vertex,start,end (0 to 1), or the mesh with "
                    "vertex colours, dark first, bright last");
    verb.add_option("--region-span", flags.region.span, "Of painted regions: the part of the time that each moves")
        ->check(number_between(0.01, 1, "0.01..1"))
        ->capture_default_str();
    verb.add_option("--region-width", flags.region.width,
                    "Regions pass smoothly into each other over this part of the diagonal")
        ->check(number_between(0, 1, "0..1"))
        ->capture_default_str();
}

KeyOptions key_options(const PathWork& work, const PathFlags& flags) {
    KeyOptions keys;
    keys.morph = flags.options;
    keys.morph.method = morph_method(flags.method);
    keys.curve.tolerance = curve_part * flags.tolerance;
    keys.closed = flags.loop;
    keys.times = flags.times;
    if (flags.targets > 0) {
        const int pieces = static_cast<int>(work.shapes.size()) - (flags.loop ? 0 : 1);
        const int least = pieces == 1 ? 1 : 3 * pieces; // where pieces meet, cubics join them
        if (flags.targets < least)
            throw Error(ErrorKind::argument, fmt::format("--targets {} is too few for a path of {} pieces; it takes {}",
                                                         flags.targets, pieces, least));
        keys.curve.max_nodes = flags.targets / pieces + 1;
    }
    if (!flags.no_repair) keys.repair = flags.repair;
    if (!flags.regions.empty()) keys.timing = read_regions(flags.regions, work.mesh, flags.region);
    return keys;
}

FrameOrder frame_order(const PathFlags& flags) {
    if (flags.loop) return FrameOrder::around;
    return flags.ping_pong ? FrameOrder::and_back : FrameOrder::there;
}

void tell_solve(const SolveReport& solve, Console& console, Json& row) {
    row["solve"] = {{"sweeps", solve.sweeps}, {"residual", solve.residual}, {"converged", solve.converged}};
    if (!solve.converged)
        console.warn(
            fmt::format("the path's solve stopped after {} sweeps with a residual of {:.2g}; set --c1 and --c2 "
                        "further from 1, or use another --method",
                        solve.sweeps, solve.residual));
}

// How far what is written lies from the path: the curve itself, and what playing it adds.
void tell_curve(const Curve& curve, const std::optional<WeightKeys>& keys, const PathFlags& flags, Console& console,
                Json& row) {
    const double deviation = curve.deviation + (keys ? keys->chords + keys->floats : 0);
    row["curve"] = {{"meshes", curve.nodes.size()},
                    {"degree", curve.basis.degree},
                    {"deviation", deviation},
                    {"tolerance", flags.tolerance}};
    if (keys)
        row["curve"]["animation"] = {{"keys", keys->times.size()}, {"chords", keys->chords}, {"floats", keys->floats}};
    const std::string found =
        fmt::format("{} morph targets play the path to {:.2g} of the diagonal", curve.nodes.size() - 1, deviation);
    if (deviation <= flags.tolerance)
        console.note("path: " + found);
    else
        console.warn(fmt::format("{}, not to the tolerance of {:.2g}{}", found, flags.tolerance,
                                 flags.targets > 0 ? "; that is what --targets costs" : ""));
}

void tell_repair(const RepairReport& repair, Console& console, Json& row) {
    row["repair"] = {
        {"cuts_before", repair.cuts_before}, {"cuts_after", repair.cuts_after}, {"places_bent", repair.contacts},
        {"places_left", repair.left},        {"moved", repair.moved},           {"shapes_tried", repair.trials}};
    if (repair.contacts > 0)
        console.note(fmt::format("repair: {} place{} bent by up to {:.2g} of the diagonal where the path cut itself",
                                 repair.contacts, repair.contacts == 1 ? "" : "s", repair.moved));
    if (repair.left > 0)
        console.warn(fmt::format("the path cuts itself in {} place{} on the way; --report says where", repair.left,
                                 repair.left == 1 ? "" : "s"));
}

// One shape of a plain path needs no curve: one solve gives it. Only the whole path tells what is to be repaired.
void write_one_shape(const PathWork& work, const PathFlags& flags, const KeyOptions& keys, const Progress& progress,
                     Console& console, Json& row, Written& written) {
    const double u = flags.at.front();
    Mesh shape = work.mesh;
    SolveReport solve;
    if (work.shapes.size() == 2 && !keys.closed && !keys.repair) {
        Morph path = morph(work.mesh, work.shapes[1], keys.morph, progress);
        stop_if_interrupted();
        if (keys.timing) path = retimed(path, *keys.timing);
        shape.positions = path.at(u);
        if (path.report) solve = path.report();
    } else {
        const KeyPath path = key_path(work.mesh, work.shapes, keys, progress);
        stop_if_interrupted();
        tell_curve(path.curve, {}, flags, console, row);
        tell_repair(path.repair, console, row);
        shape.positions = path.curve.at(u);
        solve = path.report;
    }
    if (work.other) {
        if (u > 0 && u < 1 && (shows_materials(shape) || shows_materials(*work.other)))
            console.warn(fmt::format("a picture cannot fade in one file: at u = {:.3g} it is the {} look", u,
                                     u < 0.5 ? "first" : "second"));
        shape = faded_look(shape, *work.other, u);
    }
    tell_solve(solve, console, row);
    row["shapes"] = Json::array({{{"u", u}, {"shape", describe(shape)}}});
    written = write_still(shape, fmt::format("u = {:.3g}", u), work.before, work.outputs, progress, flags.writing);
}

void write_whole_path(const PathWork& work, const PathFlags& flags, const KeyOptions& keys, const Progress& progress,
                      Console& console, Json& row, Written& written) {
    Playable playable;
    KeyPath path = key_path(work.mesh, work.shapes, keys, part_of(progress, 0, 0.6));
    stop_if_interrupted();
    tell_solve(path.report, console, row);
    playable.play = {flags.seconds, !flags.once && !flags.loop, ease_named(flags.ease), work.title,
                     chord_part * flags.tolerance};
    if (any_played(work.outputs)) playable.keys = weight_keys(path.curve, playable.play);
    tell_curve(path.curve, playable.keys, flags, console, row);
    if (keys.repair) tell_repair(path.repair, console, row);
    playable.path = std::move(path.curve);
    const auto at = [&](double u) { return playable.path.at(u); };
    const bool plotted = std::any_of(work.outputs.begin(), work.outputs.end(),
                                     [](const Output& out) { return out.kind == OutputKind::plot; });
    if (work.measured || plotted)
        playable.quality = path_quality(work.mesh, at, {.keys = playable.path.keys, .weld = keys.morph.weld},
                                        part_of(progress, 0.6, 0.8));
    stop_if_interrupted();
    if (work.measured) row["shapes"] = to_json(playable.quality, work.mesh.triangles, at);
    playable.mesh = work.mesh;
    playable.mesh.positions = playable.path.nodes.front();
    playable.other = work.other;
    playable.frames = flags.frames;
    playable.order = frame_order(flags);
    playable.before = work.before;
    playable.ends_before = work.ends_before;
    playable.writing = flags.writing;
    written = write_outputs(playable, work.outputs, part_of(progress, 0.8, 1));
}

} // namespace

void add_method_flags(CLI::App& verb, PathFlags& flags) {
    std::vector<std::string> methods;
    for (const MorphMethod method : morph_methods()) methods.emplace_back(name_of(method));
    verb.add_option("--method", flags.method, "Path between the shapes")
        ->check(CLI::IsMember(methods))
        ->capture_default_str();
    verb.add_option("--c1", flags.options.c1, "C1 of the dual method's Eq. 12, over 1")->capture_default_str();
    verb.add_option("--c2", flags.options.c2, "C2 of the dual method's Eq. 12, under 1")->capture_default_str();
    add_write_flags(verb, flags.writing);
}

void add_path_flags(CLI::App& verb, PathFlags& flags) {
    add_method_flags(verb, flags);
    verb.add_option("--frames", flags.frames, "Frames of a numbered sequence, both ends included")
        ->check(CLI::Range(2, 100000))
        ->capture_default_str();
    verb.add_option("--at", flags.at, "Write only the shape at this u, 0 (the first) to 1 (the last)")
        ->check(number_between(0, 1, "0..1"))
        ->expected(1);
    verb.add_option("--tolerance", flags.tolerance,
                    "How far the morph targets' weighted sums may lie beside the path, in parts of the diagonal")
        ->check(number_between(1e-9, 1, "1e-9..1"))
        ->capture_default_str();
    verb.add_option("--targets", flags.targets, "Morph targets at most, for viewers that play few; tells what it costs")
        ->check(CLI::Range(1, 10000));
    verb.add_flag("--no-repair", flags.no_repair,
                  "Leave the path as it is where it cuts itself though its ends do not");
    verb.add_option("--repair-reach", flags.repair.reach,
                    "How far such a place may be bent out of the way, in parts of the diagonal")
        ->check(number_between(1e-6, 1, "1e-6..1"))
        ->capture_default_str();
    add_play_flags(verb, flags);
}

void write_path(const PathWork& work, const PathFlags& flags, const Progress& progress, Console& console,
                Json& report) {
    const auto start = std::chrono::steady_clock::now();
    const KeyOptions keys = key_options(work, flags);
    Json& row = report["path"] = {{"method", flags.method}, {"seconds", 0}};
    Written written;
    if (flags.at.empty())
        write_whole_path(work, flags, keys, progress, console, row, written);
    else
        write_one_shape(work, flags, keys, progress, console, row, written);
    stop_if_interrupted();
    row["seconds"] = seconds_since(start);
    tell_written(written, console, report);
}
