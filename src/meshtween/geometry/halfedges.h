// A closed triangle mesh whose edges can be turned, split and collapsed. Half-edge h runs from vertex from[h] to
// from[next(h)]; triangle t has the half-edges 3t, 3t + 1 and 3t + 2.
#pragma once

#include "meshtween/core/mesh.h"

#include <vector>

namespace meshtween {

struct Halfedges {
    std::vector<Point> points;
    std::vector<int> from; // a half-edge: the vertex it leaves; -1 where its triangle is gone
    std::vector<int> twin; // a half-edge: the same edge the other way
    std::vector<int> out;  // a vertex: a half-edge that leaves it; -1 where it is gone

    static int next(int h) { return h % 3 == 2 ? h - 2 : h + 1; }
    static int previous(int h) { return h % 3 == 0 ? h + 2 : h - 1; }
    int to(int h) const { return from[static_cast<std::size_t>(next(h))]; }
    int origin(int h) const { return from[static_cast<std::size_t>(h)]; }
    int opposite(int h) const { return from[static_cast<std::size_t>(previous(h))]; } // the triangle's third vertex
    int other(int h) const { return twin[static_cast<std::size_t>(h)]; }
    const Point& at(int vertex) const { return points[static_cast<std::size_t>(vertex)]; }
    bool alive(int h) const { return from[static_cast<std::size_t>(h)] >= 0; }
    int count() const { return static_cast<int>(from.size()); }

    // Calls visit(h) for each half-edge that leaves the vertex, in order around it.
    template <typename Visit>
    void around(int vertex, const Visit& visit) const {
        const int start = out[static_cast<std::size_t>(vertex)];
        int h = start;
        do {
            visit(h);
            h = other(previous(h));
        } while (h != start);
    }
    int valence(int vertex) const;
    bool neighbours(int a, int b) const;

    void flip(int h);                      // the edge now joins the two vertices that were opposite it
    int split(int h, const Point& middle); // returns the new vertex
    bool may_collapse(int h) const;        // the surface stays a manifold of the same genus
    void collapse(int h);                  // from[h] goes, to(h) stays where it is
};

// The mesh must be closed and manifold.
Halfedges halfedges(const Mesh& mesh);

// What is left, renumbered in order.
Mesh compact(const Halfedges& surface);

} // namespace meshtween
