// What on the target answers to each vertex of a fitted mesh, and how far that can be trusted.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/comparison.h"

#include <filesystem>
#include <vector>

namespace meshtween {

// For each vertex of `mesh` a place on `surface`, which lies on or near it: the closest one that looks the same way,
// where there is one nearly as close as the closest of all, so that a vertex between two near sheets finds its own;
// else the closest. Throws Error(computation) where the surface has no triangles.
std::vector<SurfacePoint> places_on(const Mesh& mesh, const Mesh& surface);

// An entry a vertex of the fitted mesh; lengths are parts of the target's diagonal.
struct Correspondence {
    std::vector<SurfacePoint> places; // on the target
    std::vector<double> distance;     // from the vertex to its place
    std::vector<double> agreement;    // cosine between the vertex's normal and the target's triangle's: 1 the same way
    // 1: the target ends before the vertex, so that nothing there answers to it. Its place is on the target's border
    // and the vertex not on its own, or it lies off an open target and has no counterpart (counterpart.h).
    // 2: it belongs to a loose part, which was carried along (set_aside).
    std::vector<char> border;
    std::vector<double> uncovered; // furthest of the target's vertices and triangle centres for which this vertex
                                   // would have to answer (those closest to its triangles)
    Points uncovered_at;           // n x 3: that point of the target; the vertex itself where there is none
    std::vector<double> trust; // 0..1: nought where `border` is not, or where the normals oppose, else the agreement
                               // times exp(-(d / 0.005)^2), for the distance and for the uncovered
};
Correspondence correspondence(const Comparison& both);
void set_aside(Correspondence& map, const std::vector<int>& vertices);
inline Correspondence correspondence(const Mesh& fitted, const Mesh& target) {
    return correspondence(Comparison(fitted, target));
}

// CSV with the header vertex,triangle,a,b,c,distance: a row a vertex; a, b and c belong to the triangle's corners. All
// counted from 0, distance in parts of the diagonal. As write_whole.
void write_map(const Correspondence& map, const std::filesystem::path& path);

// CSV with the header vertex,trust,distance,agreement,border,uncovered: a row a vertex.
void write_weights(const Correspondence& map, const std::filesystem::path& path);

// n x 4: red where the trust is nought, over yellow to green where it is 1.
Colors trust_colors(const Correspondence& map);

} // namespace meshtween
