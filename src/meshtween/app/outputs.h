// What -o can name, and how a morph is written there.
#pragma once

#include "meshtween/app/preview.h"
#include "meshtween/core/progress.h"
#include "meshtween/morph/curve.h"

#include <filesystem>
#include <string>
#include <vector>

namespace meshtween {

enum class OutputKind {
    glb,      // x.glb: a playable glTF, or one mesh where a single shape is asked for
    html,     // x.html: a page that plays the morph
    sheet,    // x.png: a contact sheet
    sequence, // frame_####.obj (.ply .stl .off .glb .png): one numbered file a frame
    mesh,     // x.obj (.ply .stl .off): one mesh
};

struct Output {
    OutputKind kind = OutputKind::mesh;
    std::filesystem::path path;
};

// Tells the kind by the name. Throws Error(argument) listing what there is, Error(file) where the folder does not
// exist.
Output output(const std::string& name);

// The file's name for one frame of a sequence: the run of #s becomes the number with leading zeros.
std::filesystem::path numbered(const std::filesystem::path& pattern, int number);

// A morph ready to be written.
struct Playable {
    Mesh mesh; // triangles and attributes; positions are those at u = 0
    Morph morph;
    CurveOptions curve; // how many meshes play it
    int frames = 11;    // of a sequence, both ends included
    std::string title;
    std::vector<Tile> before; // tiles that a contact sheet shows before the in-betweens
};

// What the writing found out, for the report.
struct Written {
    std::vector<std::filesystem::path> files;
    int nodes = 0;        // meshes of the curve; 0 where none was needed
    double deviation = 0; // of the curve from the path, parts of the diagonal
    bool cancelled = false;
};

// Writes every output; each file appears whole or not at all. Cancelling leaves the files already finished.
// Throws Error(argument) for a single mesh, which needs one u.
Written write_outputs(const Playable& playable, const std::vector<Output>& outputs, const Progress& progress = {});

// One shape of it: meshes and still GLBs, a picture for .png. Throws Error(argument) for a page or a sequence.
Written write_still(const Mesh& mesh, const std::string& caption, const std::vector<Tile>& before,
                    const std::vector<Output>& outputs, const Progress& progress = {});

} // namespace meshtween
