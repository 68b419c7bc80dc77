// What a run found out, as JSON: one object that scripts and people can read.
#pragma once

#include "meshtween/fit/fit.h"
#include "meshtween/fit/quality.h"
#include "meshtween/fit/worst_places.h"
#include "meshtween/geometry/check.h"
#include "meshtween/morph/path_quality.h"

#include <nlohmann/json.hpp>

#include <span>
#include <string_view>

namespace meshtween {

using Json = nlohmann::ordered_json;

std::string_view name_of(Severity severity); // "note", "warning" or "error"

Json to_json(const Statistics& s);
Json to_json(const Quality& quality);
Json to_json(const AnsweredQuality& quality);
Json to_json(const FitResult& result);
Json to_json(const std::vector<Finding>& findings);
// Counts, extent, area, volume and findings, which are those of check().
Json describe(const Mesh& mesh, const std::vector<Finding>& findings);
inline Json describe(const Mesh& mesh) {
    return describe(mesh, check(mesh));
}

// What a fit's guards did and where, its worst places, and where the next markers should go: "guards", "worst" and
// "next_markers". Lengths are percent of the target's diagonal, points in the meshes' own units; `most`: entries of a
// list of triangles or vertices.
Json fit_places(const Mesh& source, const Mesh& fitted, const Mesh& target, const FitResult& result,
                const Correspondence& map, const Quality& quality, std::span<const Marker> markers,
                std::size_t most = 20);

// A row a frame: volume and area, also against the straight line between the ends; edge strain, the relative difference
// between an edge's length and the blend of its lengths at both ends, in percent; how many triangles are flipped and
// which, how many pairs cut each other and where (twenty of each at most).
Json to_json(const PathQuality& quality, const Triangles& triangles, const std::function<Points(double u)>& at);

// The largest resident size of this process so far, in MiB.
double peak_memory_mib();

} // namespace meshtween
