#include "inputs.h"

#include "meshtween/core/error.h"
#include "meshtween/geometry/samples.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

using namespace meshtween;

namespace {

struct Arguments {
    std::string name, folder;
    int subdivisions = 0;
};

std::string csv(const Points& points) {
    std::string text = "x,y,z\n";
    for (Eigen::Index i = 0; i < points.rows(); ++i)
        text += fmt::format("{},{},{}\n", points(i, 0), points(i, 1), points(i, 2));
    return text;
}

std::vector<std::filesystem::path> write_sample(const Sample& sample, const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    const auto next = [&](const std::string& what) { return files.emplace_back(folder / (sample.name + "_" + what)); };
    write_mesh(sample.source, next("source.ply"));
    write_mesh(sample.target, next("target.ply"));
    if (!sample.marker_names.empty()) {
        std::vector<MarkerPair> pairs;
        for (std::size_t i = 0; i < sample.marker_names.size(); ++i)
            pairs.push_back({sample.marker_names[i], sample.marker_source.row(std::ptrdiff_t(i)),
                             sample.marker_target.row(std::ptrdiff_t(i))});
        write_marker_pairs(pairs, next("markers.csv"));
    }
    if (sample.truth.rows() > 0) write_whole(next("truth.csv"), csv(sample.truth));
    if (sample.middle.rows() > 0) {
        Mesh middle = sample.source;
        middle.positions = sample.middle;
        write_mesh(middle, next("middle.ply"));
    }
    return files;
}

} // namespace

void add_sample(CLI::App& app, const Common& common) {
    auto* verb = app.add_subcommand("sample", "Write an embedded sample: source, target, markers, truth");
    std::string list = "Samples:\n";
    for (const SampleInfo& info : samples()) list += fmt::format("  {:<12} {}\n", info.name, info.description);
    verb->footer(list + "Examples:\n  meshtween sample bow -o samples\n  meshtween sample bow --subdivide 2 -o large");
    const auto a = std::make_shared<Arguments>();
    verb->add_option("NAME", a->name, "Which sample")->required();
    verb->add_option("-o,--output", a->folder, "Folder to write to; made where it does not exist")->required();
    verb->add_option("--subdivide", a->subdivisions,
                     "Make it larger: each triangle becomes four, so many times (0 to 4)");
    verb->callback([a, &common] {
        Console console(common.quiet);
        const Sample made = sample(a->name, a->subdivisions);
        std::error_code failure;
        std::filesystem::create_directories(a->folder, failure);
        if (failure && !std::filesystem::is_directory(a->folder))
            throw Error(ErrorKind::file, fmt::format("{}: cannot make this folder: {}", a->folder, failure.message()));
        for (const auto& file : write_sample(made, a->folder)) console.note("wrote " + file.string());
    });
}
