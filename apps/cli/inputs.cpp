#include "inputs.h"

#include "meshtween/core/version.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/check.h"
#include "meshtween/io/mesh_file.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/io/output.h"
#include "meshtween/io/seams.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

using namespace meshtween;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

namespace {

std::vector<Finding> require_usable(const Mesh& mesh, const std::string& path, Console& console) {
    if (mesh.file) console.warn(path + ": ", mesh.file->notes);
    std::vector<Finding> findings = check(mesh, seams(mesh));
    for (const Finding& finding : findings) {
        if (finding.severity == Severity::error)
            throw Error(ErrorKind::file, fmt::format("{}: {}", path, finding.what));
        if (finding.severity == Severity::warning) console.warn(fmt::format("{}: {}", path, finding.what));
    }
    stop_if_interrupted();
    return findings;
}

} // namespace

Mesh load_mesh(const std::string& path, Console& console) {
    Mesh mesh = read_mesh(path);
    require_usable(mesh, path, console);
    return mesh;
}

Mesh load_mesh(const std::string& path, Console& console, Json& described) {
    Mesh mesh = read_mesh(path);
    described = describe(mesh, require_usable(mesh, path, console));
    return mesh;
}

std::vector<Mesh> load_alike(const std::vector<std::string>& paths, Console& console) {
    std::vector<Mesh> meshes = read_meshes({paths.begin(), paths.end()});
    for (std::size_t k = 0; k < meshes.size(); ++k) require_usable(meshes[k], paths[k], console);
    return meshes;
}

std::vector<Mesh> load_one_connectivity(const std::vector<std::string>& paths, Console& console) {
    std::vector<Mesh> meshes = read_meshes({paths.begin(), paths.end()});
    const Mesh& first = meshes.front();
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        const Mesh& mesh = meshes[k];
        require_usable(mesh, paths[k], console);
        if (mesh.positions.rows() != first.positions.rows() || mesh.triangles.rows() != first.triangles.rows() ||
            mesh.triangles != first.triangles)
            throw Error(ErrorKind::file,
                        fmt::format("{} ({} vertices, {} triangles) and {} ({}, {}) are not of one connectivity; bring "
                                    "the first onto the second with meshtween fit",
                                    paths[0], first.positions.rows(), first.triangles.rows(), paths[k],
                                    mesh.positions.rows(), mesh.triangles.rows()));
    }
    return meshes;
}

MarkerReading marker_reading(const std::string& systems) {
    MarkerReading reading;
    if (systems.empty()) return reading;
    const std::size_t comma = std::min(systems.find(','), systems.size());
    reading.systems = {space_named(systems.substr(0, comma)),
                       space_named(comma < systems.size() ? systems.substr(comma + 1) : systems)};
    return reading;
}

void add_markers_system(CLI::App& verb, std::string& systems) {
    const auto check = [](const std::string& given) {
        const auto [source, target] = marker_reading(given).systems;
        return source != Space::unknown && target != Space::unknown
                   ? std::string()
                   : given + " is neither RAS nor LPS, nor two of them";
    };
    verb.add_option("--markers-system", systems,
                    "The system of the markers' coordinates, whatever their files say: RAS or LPS, or two with a comma "
                    "for the source's and the target's; beside it a mesh that names none is taken to be in LPS")
        ->check(check);
}

MarkerPairs load_markers(const std::vector<std::string>& files, const Mesh& source, const Mesh& target,
                         Console& console, const std::string& systems) {
    if (files.empty()) return {};
    const MarkerReading reading = marker_reading(systems);
    MarkerPairs markers = files.size() == 2 ? read_marker_pairs(files[0], files[1], source, target, reading)
                                            : read_marker_pairs(files[0], source, target, reading);
    console.warn("", markers.notes);
    if (markers.pairs.empty())
        throw Error(ErrorKind::file,
                    fmt::format("{}: no usable pair of markers; correct the file, or leave --markers out", files[0]));
    return markers;
}

std::vector<Output> load_outputs(const std::vector<std::string>& names) {
    std::vector<Output> outputs;
    outputs.reserve(names.size());
    for (const std::string& name : names) {
        if (std::find(names.begin(), names.end(), name) - names.begin() != std::ssize(outputs))
            throw Error(ErrorKind::argument, fmt::format("-o {} is given twice", name));
        outputs.push_back(output(name));
    }
    return outputs;
}

void add_write_flags(CLI::App& verb, WriteOptions& options) {
    verb.add_option_function<std::string>(
            "--textures",
            [&options](const std::string& way) {
                options.textures = way == "refer" ? Textures::refer : Textures::copy;
            },
            "Material libraries and pictures that a mesh names: copy them beside it, or refer to where they are")
        ->check(CLI::IsMember({"copy", "refer"}))
        ->default_str("copy");
}

void tell_written(const Written& written, Console& console) {
    for (const auto& file : written.files) console.note("wrote " + file.string());
    for (const auto& note : written.notes) console.note(note);
}

void tell_written(const Written& written, Console& console, Json& report) {
    for (const auto& file : written.files) report["outputs"].push_back(file.string());
    tell_written(written, console);
}

void add_weld_flag(CLI::App& verb, const std::vector<bool*>& weld) {
    verb.add_flag_callback(
        "--no-weld",
        [weld] {
            for (bool* one : weld) *one = false;
        },
        "Leave meshes cut where their files split vertices because texture coordinates or normals jump");
}

std::string title_of(const std::vector<std::string>& meshes) {
    std::string title;
    for (const std::string& mesh : meshes)
        title += (title.empty() ? "" : " to ") + std::filesystem::path(mesh).stem().string();
    return title;
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
