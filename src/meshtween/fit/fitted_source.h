// What of a source is fitted: its faces without those that are none, without loose parts. The rest goes along.
#pragma once

#include "meshtween/fit/fit.h"
#include "meshtween/fit/loose_parts.h"
#include "meshtween/geometry/sound_faces.h"

#include <span>
#include <string>
#include <vector>

namespace meshtween {

struct FittedSource {
    // `free`: a flag a triangle of the source that nothing draws, unless a marker lies there; empty for none.
    FittedSource(const Mesh& source, const SoundFaces& faces, std::span<const Marker> markers,
                 const FitOptions& options, const std::vector<char>& free);

    const Mesh& mesh() const { return all ? *source : own; }

    // Positions of the whole source where the fitted mesh has these.
    Points whole(const Points& now) const;
    // What a fit says of the fitted mesh's vertices and triangles, in the source's numbers; its positions become those
    // of the whole.
    void give_back(FitResult& result) const;

    const Mesh* source = nullptr; // must outlive this
    bool all = true;              // nothing was left out
    Mesh own;                     // positions and triangles of what is fitted; empty where all is
    Portion fitted;
    std::vector<int> cut_off;  // of the fitted mesh's vertices: those where the free region follows
    std::vector<int> stand_in; // of each of the source's vertices: the one that it goes with
    Carried carried;
    std::vector<Marker> markers;
    std::vector<std::string> notes; // what was left out
};

} // namespace meshtween
