// How good a fit is, by measures that do not depend on how it was made.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/comparison.h"
#include "meshtween/io/markers.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace meshtween {

// Of a list of values. p95 and p99 are the values at rank floor(q (n - 1)).
struct Statistics {
    double mean = 0, rms = 0, median = 0, p95 = 0, p99 = 0, max = 0;
};
Statistics statistics(std::vector<double> values);

// Lengths are percent of the target's bounding-box diagonal.
struct Quality {
    long vertices = 0, triangles = 0; // what a seam of the file split counts as one vertex
    long copies = 0;                  // of vertices, which seams made: not counted
    double eq7 = 0;                   // E of Eq. 7 in squared parts of the diagonal
    Statistics vertex_to_target;      // every vertex of the fitted mesh
    Statistics fitted_to_target;      // 100,000 points spread evenly over the fitted surface
    Statistics target_to_fitted;      // and over the target's
    std::vector<int> flipped;         // faces whose normal opposes the target's at the point closest to their centre
    double flipped_area_percent = 0;
    long degenerate = 0;                   // faces with less than 1e-14 of the diagonal squared as double area
    std::vector<std::array<int, 2>> cuts;  // pairs of faces that cut each other
    long cuts_source = 0, cuts_target = 0; // how many there are in the source and in the target itself
    Statistics symmetric_dirichlet; // of each face's map source -> fitted: s1^2 + s2^2 + 1/s1^2 + 1/s2^2, 4 an isometry
    std::optional<Statistics> truth_error, marker_error;
};

// Of the faces to which something on the target answers, and of what of the target was fitted to: a loose part of the
// source, what lies beyond an open target, or a floor under it say nothing of the fit.
struct AnsweredQuality {
    long faces = 0;
    Statistics fitted_to_target; // as in Quality, over these faces
    Statistics target_to_fitted;
    std::vector<int> flipped;
    long cuts = 0; // pairs of these faces that cut each other
};
// `unanswered`: a flag a vertex of the fitted mesh; faces all of whose corners are flagged do not count.
AnsweredQuality answered_quality(const Comparison& both, const Quality& whole, const std::vector<char>& unanswered,
                                 std::uint32_t seed = 12345);
// The same beside a target without its triangles `left_out`, ascending.
AnsweredQuality answered_quality(const Mesh& source, const Comparison& both, const Quality& whole,
                                 const std::vector<char>& unanswered, const std::vector<int>& left_out,
                                 std::uint32_t seed = 12345);

// `truth`: n x 3, where each vertex should be, empty if not known; `markers`: to score, empty for none; `seed`:
// of the sample points. Throws Error(argument) where the meshes do not belong together.
Quality measure(const Mesh& source, const Comparison& both, const Points& truth = {},
                std::span<const Marker> markers = {}, std::uint32_t seed = 12345);
inline Quality measure(const Mesh& source, const Mesh& fitted, const Mesh& target, const Points& truth = {},
                       std::span<const Marker> markers = {}, std::uint32_t seed = 12345) {
    return measure(source, Comparison(fitted, target), truth, markers, seed);
}

} // namespace meshtween
