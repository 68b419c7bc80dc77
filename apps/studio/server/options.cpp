#include "options.h"

#include "meshtween/core/error.h"

#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

namespace meshtween::studio {
namespace {

// One line of the form. A choice's value is the index of its name.
template <typename Options>
struct Row {
    std::string name, label, help;
    double least = 0, most = 0;
    std::vector<std::string> choices; // empty for a number
    std::function<double(const Options&)> get;
    std::function<void(Options&, double)> set;
    std::pair<std::string, std::string> when{}; // another option and its choice without which this one says nothing
};

template <typename Options>
Json schema(const std::vector<Row<Options>>& rows, const Options& defaults) {
    Json all = Json::array();
    for (const auto& row : rows) {
        Json line{{"name", row.name}, {"label", row.label}, {"help", row.help}};
        if (!row.when.first.empty()) line["when"] = {row.when.first, row.when.second};
        const double value = row.get(defaults);
        if (row.choices.empty()) {
            line.update({{"type", "number"}, {"default", value}, {"min", row.least}, {"max", row.most}});
        } else {
            line.update({{"type", "choice"}, {"default", row.choices[std::size_t(value)]}, {"choices", row.choices}});
        }
        all.push_back(std::move(line));
    }
    return all;
}

template <typename Options>
double number_in(const Row<Options>& row, const Json& value) {
    if (row.choices.empty()) {
        if (!value.is_number()) throw Error(ErrorKind::argument, fmt::format("option {} must be a number", row.name));
        const auto number = value.get<double>();
        if (!(number >= row.least && number <= row.most))
            throw Error(ErrorKind::argument,
                        fmt::format("option {} must lie between {} and {}", row.name, row.least, row.most));
        return number;
    }
    for (std::size_t i = 0; value.is_string() && i < row.choices.size(); ++i)
        if (row.choices[i] == value.get<std::string>()) return double(i);
    throw Error(ErrorKind::argument,
                fmt::format("option {} must be one of: {}", row.name, fmt::join(row.choices, ", ")));
}

template <typename Options>
Options read(const std::vector<Row<Options>>& rows, const Json& values, Options options) {
    if (values.is_null()) return options;
    if (!values.is_object()) throw Error(ErrorKind::argument, "options must be an object of names and values");
    for (const auto& [name, value] : values.items()) {
        const auto row =
            std::find_if(rows.begin(), rows.end(), [&name = name](const auto& r) { return r.name == name; });
        if (row == rows.end()) throw Error(ErrorKind::argument, fmt::format("there is no option {}", name));
        row->set(options, number_in(*row, value));
    }
    return options;
}

const std::vector<Row<FitOptions>>& fit_rows() {
    static const std::vector<Row<FitOptions>> rows{
        {"method",
         "Method",
         "surface poses a thin shell by its markers and draws it on from coarse to fine; paper warps by the markers, "
         "then "
         "smooths and projects.",
         0,
         0,
         {"surface", "paper"},
         [](const FitOptions& o) { return o.method == FitMethod::paper ? 1.0 : 0.0; },
         [](FitOptions& o, double v) { o.method = v == 1 ? FitMethod::paper : FitMethod::surface; }},
        {"markers",
         "Markers",
         "near: met as well as the surface allows, mostly to a hundredth of a percent. exact: met to the last digit, "
         "even "
         "where that leaves the surface a little.",
         0,
         0,
         {"near", "exact"},
         [](const FitOptions& o) { return o.markers_exact ? 1.0 : 0.0; },
         [](FitOptions& o, double v) { o.markers_exact = v == 1; }},
        {"vertices",
         "Vertices",
         "lifted: off the target by so much that the triangles between them lie on it in the mean. on it: each one "
         "exactly.",
         0,
         0,
         {"lifted", "on it"},
         [](const FitOptions& o) { return o.on_surface ? 1.0 : 0.0; },
         [](FitOptions& o, double v) { o.on_surface = v == 1; },
         {"method", "surface"}},
        {"symmetry",
         "Symmetry",
         "used: where both shapes are their own mirror images, each marker draws on the other side as well. not used: "
         "markers draw where they are.",
         0,
         0,
         {"used", "not used"},
         [](const FitOptions& o) { return o.symmetry ? 0.0 : 1.0; },
         [](FitOptions& o, double v) { o.symmetry = v == 0; },
         {"method", "surface"}},
        {"marker_weight",
         "Marker pull",
         "Beside the usual 1. Markers begin to yield to the shapes under 0.0001 or so; with 0 they say the pose only.",
         0,
         10,
         {},
         [](const FitOptions& o) { return o.marker_weight; },
         [](FitOptions& o, double v) { o.marker_weight = v; },
         {"method", "surface"}},
        {"kernel",
         "Warp",
         "How the markers pull on what lies between them. thin-plate bends more locally, linear is stiffer.",
         0,
         0,
         {"thin-plate", "linear"},
         [](const FitOptions& o) { return o.warp.kernel == Kernel::linear ? 1.0 : 0.0; },
         [](FitOptions& o, double v) { o.warp.kernel = v == 1 ? Kernel::linear : Kernel::thin_plate; },
         {"method", "paper"}},
        {"smoothing",
         "Marker slack",
         "Lets the warp miss markers a little, for markers placed by a shaky hand. 0 meets them exactly.",
         0,
         1,
         {},
         [](const FitOptions& o) { return o.warp.smoothing; },
         [](FitOptions& o, double v) { o.warp.smoothing = v; },
         {"method", "paper"}},
        {"rounds",
         "Rounds",
         "Rounds of smoothing and projection at most. More follow the target more closely and take longer.",
         0,
         1000,
         {},
         [](const FitOptions& o) { return double(o.max_rounds); },
         [](FitOptions& o, double v) { o.max_rounds = int(v); },
         {"method", "paper"}},
        {"threshold",
         "Close enough",
         "Stops where the root mean square distance falls under this part of the target's size.",
         1e-9,
         1,
         {},
         [](const FitOptions& o) { return o.threshold; },
         [](FitOptions& o, double v) { o.threshold = v; },
         {"method", "paper"}},
    };
    return rows;
}

std::vector<std::string> method_names() {
    std::vector<std::string> names;
    for (const MorphMethod method : morph_methods()) names.emplace_back(name_of(method));
    return names;
}

const std::vector<Row<KeyOptions>>& morph_rows() {
    static const std::vector<Row<KeyOptions>> rows{
        {"method", "Method",
         "How shapes travel. linear moves every vertex on a straight line; the others keep shapes through turns.", 0, 0,
         method_names(),
         [](const KeyOptions& o) {
             const auto& all = morph_methods();
             return double(std::find(all.begin(), all.end(), o.morph.method) - all.begin());
         },
         [](KeyOptions& o, double v) { o.morph.method = morph_methods()[std::size_t(v)]; }},
        {"repair",
         "Cuts on the way",
         "bend moves parts aside where the path would cut itself though its ends do not; leave plays it as it is.",
         0,
         0,
         {"bend", "leave"},
         [](const KeyOptions& o) { return o.repair ? 0.0 : 1.0; },
         [](KeyOptions& o, double v) { o.repair = v == 0 ? std::optional(RepairOptions()) : std::nullopt; }},
        {"c1",
         "C1",
         "Of the dual method's Eq. 12, over 1: further from 1 solves faster, nearer keeps shapes better.",
         1 + 1e-6,
         10,
         {},
         [](const KeyOptions& o) { return o.morph.c1; },
         [](KeyOptions& o, double v) { o.morph.c1 = v; },
         {"method", "dual"}},
        {"c2",
         "C2",
         "Of the dual method's Eq. 12, under 1: further from 1 solves faster, nearer keeps shapes better.",
         1e-6,
         1 - 1e-6,
         {},
         [](const KeyOptions& o) { return o.morph.c2; },
         [](KeyOptions& o, double v) { o.morph.c2 = v; },
         {"method", "dual"}},
    };
    return rows;
}

// Cuts are mended unless one says otherwise, as on the command line.
KeyOptions path_defaults() {
    KeyOptions options;
    options.repair = RepairOptions();
    return options;
}

} // namespace

Json fit_schema() {
    return schema(fit_rows(), FitOptions());
}

Json morph_schema() {
    return schema(morph_rows(), path_defaults());
}

FitOptions fit_options(const Json& values) {
    return read(fit_rows(), values, FitOptions());
}

KeyOptions path_options(const Json& values) {
    return read(morph_rows(), values, path_defaults());
}

} // namespace meshtween::studio
