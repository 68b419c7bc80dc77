// Markers from files: pairs, one side alone, or a file a side in either order.
#pragma once

#include "meshes.h"

#include "meshtween/io/marker_write.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace meshtween::studio {

struct ImportedMarkers {
    std::vector<PartialPair> markers; // those with a place on one side only too
    std::vector<std::string> notes;   // the library's own, and what was decided here
    bool ask_side = false;            // one side alone, and nothing tells which: ask again with a side
};

// `second` is empty for one file. Throws as read_marker_pairs.
ImportedMarkers import_markers(const std::filesystem::path& file, const std::filesystem::path& second,
                               std::optional<Side> side, const OpenMesh& source, const OpenMesh& target);

} // namespace meshtween::studio
