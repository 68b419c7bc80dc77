// What several verbs take and how it is read: meshes with their warnings, markers, options of the fit.
#pragma once

#include "console.h"

#include "meshtween/app/outputs.h"
#include "meshtween/app/report.h"
#include "meshtween/io/markers.h"

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
meshtween::Mesh load_mesh(const std::string& path, Console& console, meshtween::Json& described);
// Meshes that are meant to be one mesh in several shapes: polygons are cut alike where they can be.
std::vector<meshtween::Mesh> load_alike(const std::vector<std::string>& paths, Console& console);
// Meshes of one connectivity, polygons cut alike; throws Error(file) naming the two that differ.
std::vector<meshtween::Mesh> load_one_connectivity(const std::vector<std::string>& paths, Console& console);
// None where no file is named. Throws Error(file) for a file without a usable pair.
meshtween::MarkerPairs load_markers(const std::vector<std::string>& files, const meshtween::Mesh& source,
                                    const meshtween::Mesh& target, Console& console, const std::string& systems = {});
// --markers-system, and what was given with it: a word for all files, or two for the source's and the target's.
void add_markers_system(CLI::App& verb, std::string& systems);
meshtween::MarkerReading marker_reading(const std::string& systems);
std::vector<meshtween::Output> load_outputs(const std::vector<std::string>& names);
// How meshes are written.
void add_write_flags(CLI::App& verb, meshtween::WriteOptions& options);
// Says what was written and what the files could not hold.
void tell_written(const meshtween::Written& written, Console& console);
void tell_written(const meshtween::Written& written, Console& console, meshtween::Json& report);
// --no-weld: vertices that seams of a file split are not one vertex (weld.h).
void add_weld_flag(CLI::App& verb, const std::vector<bool*>& weld);

std::string title_of(const std::vector<std::string>& meshes); // the files' names without folders: "a to b"

// The report's first lines; and its last, with the file written where one is named.
meshtween::Json new_report(const std::string& verb);
void finish_report(meshtween::Json& report, const std::string& file, std::chrono::steady_clock::time_point start);

double seconds_since(std::chrono::steady_clock::time_point start);

// A verb registers itself: its options, its help with an example, and what it runs.
void add_blend(CLI::App& app, const Common& common);
void add_check(CLI::App& app, const Common& common);
void add_fit(CLI::App& app, const Common& common);
void add_measure(CLI::App& app, const Common& common);
void add_morph(CLI::App& app, const Common& common);
void add_rotate(CLI::App& app, const Common& common);
void add_sample(CLI::App& app, const Common& common);
void add_studio(CLI::App& app, const Common& common);
void add_transfer(CLI::App& app, const Common& common);
void add_tween(CLI::App& app, const Common& common);
