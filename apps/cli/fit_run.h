// What the verbs that fit share: their options, the fit itself with its messages, and its part of the report.
#pragma once

#include "inputs.h"

#include "meshtween/fit/fit.h"

#include <cstdint>
#include <string>

struct FitFlags {
    meshtween::FitOptions options;
    std::string kernel = "thin-plate";
};
void add_fit_flags(CLI::App& verb, FitFlags& flags);

struct Fitted {
    meshtween::Mesh mesh; // the source's mesh on the target's surface
    meshtween::Json report;
};

// `seed` is that of the points with which distances are measured. Throws Error(argument) for the paper's fit with
// fewer than 3 markers, and as fit().
Fitted run_fit(const meshtween::Mesh& source, const meshtween::Mesh& target, const meshtween::MarkerPairs& markers,
               const FitFlags& flags, std::uint32_t seed, const meshtween::Progress& progress, Console& console);
