// The path's options and outputs: what `morph` and `tween` share.
#pragma once

#include "inputs.h"

#include "meshtween/app/outputs.h"
#include "meshtween/app/regions.h"
#include "meshtween/morph/keys.h"

struct PathFlags {
    meshtween::MorphOptions options;
    std::string method = std::string(meshtween::name_of(meshtween::MorphOptions{}.method));
    int frames = 11;
    std::vector<double> at; // one number, or none
    double tolerance = meshtween::CurveOptions{}.tolerance;
    int targets = 0; // morph targets of the whole path at most; 0: as many as the tolerance needs
    std::string ease = "linear";
    double seconds = meshtween::PlayOptions{}.seconds;
    bool once = false, ping_pong = false, loop = false;
    std::string regions;
    meshtween::RegionOptions region;
    std::vector<double> times; // of several shapes
    bool no_repair = false;
    meshtween::RepairOptions repair;
    meshtween::WriteOptions writing;
};
void add_method_flags(CLI::App& verb, PathFlags& flags); // the method and its constants alone
void add_path_flags(CLI::App& verb, PathFlags& flags);

// A path to write: two shapes of one mesh or more.
struct PathWork {
    meshtween::Mesh mesh; // triangles and attributes, the first shape's positions
    std::vector<meshtween::Points> shapes;
    std::vector<meshtween::Output> outputs;
    std::vector<meshtween::Tile> before; // on a contact sheet
    std::string title;
    bool measured = false;                             // a report is wanted: measure the path frame by frame
    bool ends_before = false;                          // the tiles before show both ends
    std::shared_ptr<const meshtween::Mesh> other = {}; // the mesh with another look, to which its own fades; or none
};

// Writes the path, or one shape of it with --at, and adds to the report.
void write_path(const PathWork& work, const PathFlags& flags, const meshtween::Progress& progress, Console& console,
                meshtween::Json& report);
