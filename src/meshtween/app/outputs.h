// What -o can name, and how a morph is written there.
#pragma once

#include "meshtween/app/export.h"
#include "meshtween/app/preview.h"
#include "meshtween/core/progress.h"
#include "meshtween/io/mesh_io.h"
#include "meshtween/morph/path_quality.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace meshtween {

enum class OutputKind {
    glb,      // x.glb: a playable glTF, or one mesh where a single shape is asked for
    usd,      // x.usda: a playable USD, or one mesh
    html,     // x.html: a page that plays the morph
    sheet,    // x.png: a contact sheet
    film,     // x.apng: a picture that moves
    sequence, // frame_####.obj (or another mesh, or .png): one numbered file a frame
    plot,     // x.svg: volume, area, strain, flips and self-intersections along the path
    mesh,     // x.obj (.ply .stl .off .vtk .vtp .dae .3mf): one mesh
};

struct Output {
    OutputKind kind = OutputKind::mesh;
    std::filesystem::path path;
};

// Tells the kind by the name. Throws Error(argument) listing what there is, Error(file) where the folder does not
// exist.
Output output(const std::string& name);

// Whether these can show a whole morph, or one shape: so that nobody waits for a fit to hear that they cannot. Throws
// Error(argument) naming the output and what to write instead.
void check_playable(const std::vector<Output>& outputs);
void check_still(const std::vector<Output>& outputs);

// Whether one of them holds morph targets and an animation.
bool any_played(const std::vector<Output>& outputs);

// The file's name for one frame of a sequence: the run of #s becomes the number with leading zeros.
std::filesystem::path numbered(const std::filesystem::path& pattern, int number);

enum class FrameOrder {
    there,    // both ends are frames
    and_back, // the same frames once more, backwards, without the ends: a film that repeats shows none twice
    around,   // for closed paths: the first frame follows the last
};

// A morph ready to be written.
struct Playable {
    Mesh mesh; // triangles and attributes; positions are those at u = 0
    // The same triangles with another look, to which the mesh's own fades with u; or none.
    std::shared_ptr<const Mesh> other = {};
    Curve path; // from which every output takes its shapes
    PlayOptions play;
    int frames = 11; // of a sequence or a film, from the first shape to the last
    FrameOrder order = FrameOrder::there;
    std::vector<Tile> before;       // tiles that a contact sheet shows before the in-betweens
    bool ends_before = false;       // both ends are among them
    std::optional<WeightKeys> keys; // of the GLB's animation; made where there are none and a GLB or a page is wanted
    PathQuality quality;            // for a plot; measured where it is empty and a plot is wanted
    WriteOptions writing;           // of meshes
};

// What the writing found out, for the report.
struct Written {
    std::vector<std::filesystem::path> files;
    std::vector<std::string> notes; // what files could not hold, sentences
    bool cancelled = false;
};

// The moments of a sequence's frames, 0..1.
std::vector<double> frame_times(int frames, FrameOrder order);

// Writes every output; each file appears whole or not at all. Cancelling leaves the files already finished.
// Throws Error(argument) for a single mesh, which needs one u.
Written write_outputs(const Playable& playable, const std::vector<Output>& outputs, const Progress& progress = {});

// One shape of it: meshes and still GLBs, a picture for .png. Throws Error(argument) for a page or a sequence.
Written write_still(const Mesh& mesh, const std::string& caption, const std::vector<Tile>& before,
                    const std::vector<Output>& outputs, const Progress& progress = {},
                    const WriteOptions& writing = {});

} // namespace meshtween
