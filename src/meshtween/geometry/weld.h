// Which vertices of a file are one vertex of its surface. Formats that keep one texture coordinate and one normal a
// vertex split it where these jump, and flat-shaded files give each triangle three of its own: that cuts the numbering,
// not the surface.
//
// Corners are joined along edges alone. An edge of one triangle that no other has, from p to q, is paired with the one
// such edge from q to p at the same places: their ends are one vertex each. Places are the same within a millionth of
// the diagonal, in every shape, for programs compute both ends of a circle and round. Where
// more edges could be the partner, those count that belong to triangles with another third corner, and what others have
// paired meanwhile no longer counts. What is left without exactly one partner stays a border: layers that lie on each
// other, three sheets at one edge, the staggered sides of a zip, parts that touch in a point.
//
// A border whose two sides touch, such as closed lips, may pair up as well. What the file says beside the places tells
// it from a seam, in a mesh with texture coordinates. A line of paired edges is left open where nothing in the file
// gives a reason for the split along all of it:
// - texture coordinates go on from one side to the other, without being mirrored, and are not all the same;
// - so do colours and all else that is asked for by CornerAttributes;
// - the two sides hang together in the file's numbering: what is taken apart whole (pieces of a few thousand vertices,
//   a material, single triangles) is how programs write;
// - normals do not tell of one surface: either there are none; or they differ and the surface is not folded there,
//   where a sharp edge would be; or they are equal and each side alone would have them too.
// Without texture coordinates pairing decides.
#pragma once

#include "meshtween/core/mesh.h"

#include <functional>
#include <vector>

namespace meshtween {

// What the file has at corner k of triangle t, beside the mesh's own texture coordinates and colours.
struct CornerAttributes {
    std::function<bool(int t, int k, int other_t, int other_k)> agree; // empty: there is nothing else
    std::function<Point(int t, int k)> normal;                         // any length; nought or empty: there is none
};

struct Weld {
    std::vector<int> vertex;    // n: the welded vertex of each of the file's; empty where each is its own
    std::vector<int> first;     // a welded vertex: the first of the file's; welded ones are in their order
    Triangles triangles;        // m x 3: welded vertices, the file's order and corners
    long seam_edges = 0;        // pairs of edges that were joined
    std::vector<int> on_seam;   // the file's vertices that have others in them, ascending
    std::vector<int> touching;  // the file's vertices that lie on others but are not one with them, ascending
    std::vector<int> left_open; // the file's vertices along lines that pair up but were taken for a border, ascending

    bool any() const { return !vertex.empty(); }
    Points reduced(const Points& x) const;  // the file's rows to welded ones
    Points expanded(const Points& x) const; // and back: equal bits for vertices that are one
    Triangles
    by_first() const; // the file's triangles, each corner the first of its vertices: others are of no triangle
    // What was worked out by_first for each of the file's vertices, given to the others as well.
    template <typename Values>
    void share(Values& values) const {
        for (std::size_t i = 0; i < vertex.size(); ++i)
            values[i] = values[static_cast<std::size_t>(first[static_cast<std::size_t>(vertex[i])])];
    }
    // The file's vertices of these welded ones, ascending.
    std::vector<int> files_vertices(const std::vector<int>& welded) const;
};

// `shapes`: of the mesh's connectivity, in all of which places must be the same; none: the mesh as it is. O(n log n).
// The same classes whatever the order of vertices and triangles, but for heaps of hundreds of vertices. Nothing is
// welded where a triangle names a vertex that does not exist.
Weld weld(const Mesh& mesh, const std::vector<const Points*>& shapes = {}, const CornerAttributes& file = {});

// The mesh with welded vertices; all its attributes go along, vertex colours from the first of the file's.
Mesh welded(const Mesh& mesh, const Weld& weld);

// n x 3 unit normals of the file's vertices, as vertex_normals, smooth across seams.
Points vertex_normals(const Points& positions, const Triangles& triangles, const Weld& weld);

} // namespace meshtween
