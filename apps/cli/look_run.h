// What the verbs share that carry a look from one mesh to another.
#pragma once

#include "inputs.h"

#include "meshtween/fit/carried_look.h"

#include <string>

struct LookFlags {
    int texture_size = 0;   // 0: 2048, and pictures only where there are pictures
    std::string appearance; // source, target or both; empty: the mesh's own
};
void add_texture_flag(CLI::App& verb, LookFlags& flags);
void add_appearance_flag(CLI::App& verb, LookFlags& flags, const std::vector<std::string>& choices);
// Throws Error(file) where the mesh has no look to carry, sooner than after a long fit.
void require_look(const meshtween::Mesh& mesh, const std::string& file);

struct LookNames { // the files', for messages, and the outputs, after the first of which a picture is called
    std::string receiver, giver;
    const std::vector<std::string>& outputs;
};

bool has_look(const meshtween::Mesh& mesh);

// The receiver with the giver's look; says how and over how much, and adds it to a report. Throws as carried_look();
// Interrupted where it was cancelled.
meshtween::Mesh run_look(const meshtween::Mesh& receiver, const meshtween::Mesh& giver, const LookNames& names,
                         const LookFlags& flags, const meshtween::Progress& progress, Console& console,
                         meshtween::Json& described);
