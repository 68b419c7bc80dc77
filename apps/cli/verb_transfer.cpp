#include "inputs.h"
#include "look_run.h"

#include "meshtween/core/error.h"
#include "meshtween/fit/correspondence.h"
#include "meshtween/fit/transfer.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/io/marker_write.h"
#include "meshtween/io/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

using namespace meshtween;

namespace {

struct Arguments {
    std::string fitted, target, to = "template", template_mesh;
    std::vector<std::string> outputs;
    WriteOptions writing;
    LookFlags look;
    std::string values, values_out, points, points_out, markers_system;
};

// The two sides, each as its file is named.
struct Sides {
    TwoShapes giver, receiver;
    std::string giver_file, receiver_file;
};

Sides load_sides(const Arguments& a, Console& console) {
    TwoShapes fitted, target;
    if (a.template_mesh.empty()) {
        fitted.fitted = fitted.rest = load_mesh(a.fitted, console);
    } else {
        std::vector<Mesh> both = load_alike({a.template_mesh, a.fitted}, console);
        fitted.rest = std::move(both[0]), fitted.fitted = std::move(both[1]);
    }
    target.fitted = target.rest = load_mesh(a.target, console);
    if (fitted.rest.positions.rows() != fitted.fitted.positions.rows() ||
        fitted.rest.triangles.rows() != fitted.fitted.triangles.rows() ||
        fitted.rest.triangles != fitted.fitted.triangles)
        throw Error(ErrorKind::file, fmt::format("{} and {} are not of one connectivity; give the template that was "
                                                 "fitted",
                                                 a.template_mesh, a.fitted));
    // Attributes live on either file of the template.
    if (fitted.fitted.colors.rows() == 0) fitted.fitted.colors = fitted.rest.colors;
    if (fitted.fitted.texcoords.rows() == 0) {
        fitted.fitted.texcoords = fitted.rest.texcoords;
        fitted.fitted.texcoord_triangles = fitted.rest.texcoord_triangles;
        fitted.fitted.file = fitted.rest.file;
    }
    if (a.to == "template") return {std::move(target), std::move(fitted), a.target, a.fitted};
    return {std::move(fitted), std::move(target), a.fitted, a.target};
}

void warn_if_apart(const Sides& sides, const std::vector<SurfacePoint>& places, Console& console) {
    constexpr double apart = 0.01; // of the diagonal: fits end well under it
    const Mesh &giver = sides.giver.fitted, &receiver = sides.receiver.fitted;
    std::vector<double> distances;
    for (std::size_t i = 0; i < places.size(); ++i)
        distances.push_back((position(giver.positions, giver.triangles, places[i]) -
                             receiver.positions.row(static_cast<Eigen::Index>(i)))
                                .norm());
    const auto middle = distances.begin() + std::ssize(distances) / 2;
    std::nth_element(distances.begin(), middle, distances.end());
    if (*middle > apart * diagonal(giver))
        console.warn(
            fmt::format("half of the vertices of {} lie more than {:.2g} % of the diagonal from {}: is the one "
                        "fitted to the other?",
                        sides.receiver_file, 100 * *middle / diagonal(giver), sides.giver_file));
}

void transfer_values(const Arguments& a, const Sides& sides, const std::vector<SurfacePoint>& places,
                     Console& console) {
    Table table = read_table(a.values);
    if (table.values.rows() != sides.giver.fitted.positions.rows())
        throw Error(ErrorKind::file,
                    fmt::format("{}: {} rows; it needs one for each of the {} vertices of {}", a.values,
                                table.values.rows(), sides.giver.fitted.positions.rows(), sides.giver_file));
    table.values = carried(table.values, sides.giver.fitted.triangles, places);
    write_table(table, a.values_out);
    console.note("wrote " + a.values_out);
}

void transfer_points(const Arguments& a, const Sides& sides, Console& console) {
    LandmarkList given = read_landmarks(a.points, sides.giver.rest, marker_reading(a.markers_system));
    console.warn("", given.notes);
    // Names say which are gone; without names their order does, so they stay.
    if (holds_names(a.points_out)) std::erase_if(given.points, [](const Landmark& point) { return !point.position; });
    Points points(std::ssize(given.points), 3);
    std::vector<std::size_t> there;
    for (std::size_t i = 0; i < given.points.size(); ++i)
        if (given.points[i].position) {
            points.row(std::ssize(there)) = *given.points[i].position;
            there.push_back(i);
        }
    LandmarkNumbers moved{"distance", {}};
    const Points carried =
        carried_points(points.topRows(std::ssize(there)), sides.giver, sides.receiver, &moved.values);
    for (std::size_t i = 0; i < there.size(); ++i)
        given.points[there[i]].position = carried.row(static_cast<Eigen::Index>(i));
    console.warn("", write_landmarks(given.points, a.points_out, &sides.receiver.rest, moved));
    console.note("wrote " + a.points_out);
}

// Colours and pictures go by carried_look. Texture coordinates go too where the receiver's own are of no use for that.
void transfer_mesh(const Arguments& a, const std::vector<Output>& outputs, const Sides& sides,
                   const std::vector<SurfacePoint>& places, const Progress& progress, Console& console) {
    const Mesh &giver = sides.giver.fitted, &receiver = sides.receiver.fitted;
    const bool looks = has_look(giver);
    if (!looks && giver.texcoords.rows() == 0)
        throw Error(ErrorKind::file,
                    fmt::format("{} has neither colours nor texture coordinates to carry; leave -o out, or use --to",
                                sides.giver_file));
    Mesh result = receiver;
    Json described; // of no report
    if (looks)
        result = run_look(receiver, giver, {sides.receiver_file, sides.giver_file, a.outputs}, a.look, progress,
                          console, described);
    if (result.file == receiver.file || result.file->images.empty()) {
        Mesh carried = with_attributes(receiver, giver, places);
        if (looks) carried.colors = result.colors, carried.file = result.file;
        result = std::move(carried);
    }
    result.positions = sides.receiver.rest.positions;
    if (result.file == receiver.file) result.file = sides.receiver.rest.file;
    tell_written(write_still(result, "what was carried over", {}, outputs, {}, a.writing), console);
}

void transfer(const Arguments& a, Console& console) {
    if (a.outputs.empty() && a.values.empty() && a.points.empty())
        throw Error(ErrorKind::argument, "transfer needs something to carry: -o for colours and texture coordinates, "
                                         "--values with --values-out, --points with --points-out");
    const auto outputs = load_outputs(a.outputs);
    if (!a.points_out.empty()) holds_names(a.points_out); // or it says which names it knows
    const Sides sides = load_sides(a, console);
    const Progress progress = console.progress();
    keep_going(progress, 0.2, "finding places");
    const std::vector<SurfacePoint> places = places_on(sides.receiver.fitted, sides.giver.fitted);
    stop_if_interrupted();
    warn_if_apart(sides, places, console);
    keep_going(progress, 0.4, "carrying over");
    if (!outputs.empty()) transfer_mesh(a, outputs, sides, places, part_of(progress, 0.4, 1), console);
    if (!a.values.empty()) transfer_values(a, sides, places, console);
    if (!a.points.empty()) transfer_points(a, sides, console);
}

} // namespace

void add_transfer(CLI::App& app, const Common& common) {
    auto* verb = app.add_subcommand("transfer", "Carry colours, texture coordinates, values and points between a "
                                                "fitted mesh and its target");
    verb->footer("Example: meshtween transfer fitted.ply scan.ply --template template.ply -o coloured.ply\n"
                 "Example: meshtween transfer fitted.ply scan.ply --to target --values weights.csv --values-out "
                 "scan_weights.csv\n"
                 "Example: meshtween transfer fitted.obj scan.glb --template template.obj -o textured.glb");
    const auto a = std::make_shared<Arguments>();
    verb->add_option("FITTED", a->fitted, "The template on the target's surface, as fit wrote it")->required();
    verb->add_option("TARGET", a->target, "The mesh that it was fitted to")->required();
    verb->add_option("--to", a->to, "Which way: to the template (what the target has) or to the target")
        ->check(CLI::IsMember({"template", "target"}))
        ->capture_default_str();
    verb->add_option("--template", a->template_mesh,
                     "The template before its fit: -o is written in its shape, and points are read or written on it");
    verb->add_option(
            "-o,--output", a->outputs,
            "The receiving mesh with the other's colours, pictures and texture coordinates: x.obj, .glb, .ply, "
            ".off, .png; may be given several times")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    add_texture_flag(*verb, a->look);
    auto* values = verb->add_option("--values", a->values,
                                    "CSV of numbers, a row for each vertex of the giving mesh (skin weights, a map)");
    values->needs(verb->add_option("--values-out", a->values_out, "The same for the receiving mesh")->needs(values));
    auto* points =
        verb->add_option("--points", a->points, "Points on the giving mesh: any file of markers of one side");
    points->needs(verb->add_option("--points-out", a->points_out,
                                   "The same on the receiving mesh: x.csv (with how far each was moved to the "
                                   "surface), .pp, .fcsv, .mrk.json, .json, .pts, .dta, .tps, .txt, .landmarkAscii")
                      ->needs(points));
    add_markers_system(*verb, a->markers_system);
    verb->callback([a, &common] {
        Console console(common.quiet);
        transfer(*a, console);
    });
}
