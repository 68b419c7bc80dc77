// What the verbs that fit share: their options, the fit itself with its messages, and its part of the report.
#pragma once

#include "inputs.h"

#include "meshtween/fit/correspondence.h"
#include "meshtween/fit/fit.h"

#include <cstdint>
#include <string>

struct FitFlags {
    meshtween::FitOptions options;
    std::string kernel = "thin-plate";
    std::string map, weights, refine; // files to write, or empty
};
void add_fit_flags(CLI::App& verb, FitFlags& flags);
// Options that tell of one fit and its files.
void add_fit_files(CLI::App& verb, FitFlags& flags);
// Throws Error(argument) where --refine names no mesh that keeps the order of vertices.
void check_fit_files(const FitFlags& flags);

struct Fitted {
    meshtween::Mesh source; // as given, or cut finer where --refine asked for it
    meshtween::Mesh mesh;   // this source's mesh on the target's surface
    meshtween::Correspondence map;
    meshtween::Json report;
};
void write_fit_files(const Fitted& fitted, const FitFlags& flags, const meshtween::WriteOptions& writing,
                     Console& console, meshtween::Json& report);

// `seed` is that of the points with which distances are measured. Throws Error(argument) for the paper's fit with
// fewer than 3 markers, and as fit().
Fitted run_fit(const meshtween::Mesh& source, const meshtween::Mesh& target, const meshtween::MarkerPairs& markers,
               const FitFlags& flags, std::uint32_t seed, const meshtween::Progress& progress, Console& console);
