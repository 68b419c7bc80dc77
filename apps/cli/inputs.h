// What several verbs take and how it is read: meshes with their warnings, markers, options of the fit and of the path.
#pragma once

#include "console.h"

#include "meshtween/app/outputs.h"
#include "meshtween/app/report.h"
#include "meshtween/io/markers.h"
#include "meshtween/morph/morph.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

// Options that every verb has.
struct Common {
    int threads = 0;
    std::uint32_t seed = 12345;
    bool quiet = false;
};

meshtween::Mesh load_mesh(const std::string& path, Console& console); // with warnings about what is unusual
// None where no file is named. Throws Error(file) for a file without a usable pair.
meshtween::MarkerPairs load_markers(const std::vector<std::string>& files, const meshtween::Mesh& source,
                                    const meshtween::Mesh& target, Console& console);
std::vector<meshtween::Output> load_outputs(const std::vector<std::string>& names);

struct PathFlags {
    meshtween::MorphOptions options;
    std::string method = std::string(meshtween::name_of(meshtween::MorphOptions{}.method));
    int frames = 11;
    std::vector<double> at;
};
void add_path_flags(CLI::App& verb, PathFlags& flags);

// Writes the path, or one shape of it with --at, and adds to the report.
void write_path(const meshtween::Mesh& from, const meshtween::Points& to, PathFlags flags,
                const std::vector<meshtween::Output>& outputs, const std::vector<meshtween::Tile>& before,
                const std::string& title, const meshtween::Progress& progress, Console& console,
                meshtween::Json& report);

// The report's first lines; and its last, with the file written where one is named.
meshtween::Json new_report(const std::string& verb);
void finish_report(meshtween::Json& report, const std::string& file, std::chrono::steady_clock::time_point start);

double seconds_since(std::chrono::steady_clock::time_point start);

// A verb registers itself: its options, its help with an example, and what it runs.
void add_check(CLI::App& app, const Common& common);
void add_fit(CLI::App& app, const Common& common);
void add_measure(CLI::App& app, const Common& common);
void add_morph(CLI::App& app, const Common& common);
void add_rotate(CLI::App& app, const Common& common);
void add_sample(CLI::App& app, const Common& common);
void add_studio(CLI::App& app, const Common& common);
void add_tween(CLI::App& app, const Common& common);
