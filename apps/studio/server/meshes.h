// A mesh that is open in the studio, with what is prepared for it once; and what there is to see on a fitted one.
#pragma once

#include "frame.h"
#include "project.h"

#include "meshtween/fit/correspondence.h"
#include "meshtween/fit/fit.h"
#include "meshtween/fit/quality.h"
#include "meshtween/geometry/check.h"
#include "meshtween/io/markers.h"
#include "meshtween/search/closest_point.h"

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace meshtween::studio {

struct OpenMesh {
    std::filesystem::path path;
    std::string hash;
    std::filesystem::file_time_type time; // when the file was last written, and its size: cheap signs of a change
    std::uintmax_t size = 0;
    Mesh mesh;
    Frame frame;
    std::vector<Finding> findings;
    ClosestPointIndex index;
};

// Throws Error(file) for what cannot be read or worked with.
std::shared_ptr<const OpenMesh> open_mesh(const std::filesystem::path& path);
// The same; messages name the file as the person knows it, not where it is kept.
std::shared_ptr<const OpenMesh> open_as(const std::filesystem::path& path, const std::string& name);
Json to_json(const OpenMesh& open);
bool changed_on_disk(const OpenMesh& open); // reads the file again only where its time or size differ

// A fit with what the page shows on it.
struct Fitted {
    std::string of;           // the hashes of source and target
    Mesh mesh;                // the source's mesh on the target's surface
    Eigen::VectorXd distance; // a value a vertex: to the target, percent of its diagonal
    Eigen::VectorXd stretch;  // a value a vertex: of the map source -> fitted, 1 where nothing is stretched
    Correspondence map;
    Json summary; // as a fit's report: quality, guards, worst, next_markers; and marker_errors by id
};

// All but the summary.
Fitted shown(const OpenMesh& source, const OpenMesh& target, Points positions);
// All of it. Lists hold 200 entries at most.
Fitted examined(const OpenMesh& source, const OpenMesh& target, const FitResult& result,
                const std::vector<PlacedMarker>& markers, const Progress& progress);

// The markers that have both sides, as the fit takes them; unnamed ones get their number.
std::vector<MarkerPair> complete_pairs(const std::vector<PlacedMarker>& markers);
Points side_of_pairs(const std::vector<MarkerPair>& pairs, Side side); // a row a pair
// Differs where their places differ: tells whether a fit is of today's markers.
std::string mark_of(const std::vector<PlacedMarker>& markers);

} // namespace meshtween::studio
