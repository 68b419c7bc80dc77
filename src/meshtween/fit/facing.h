// Whether a triangle looks along the surface under it, and if not, how much is wanting.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/refine.h"

#include <limits>
#include <vector>

namespace meshtween {

struct Facing {
    double squared_distance = 0; // from the triangle's centre to the target
    double cosine = 1;           // between the triangle's normal and the target's there
    double detour = 0;           // how much further it is to the nearest place that looks the same way
    int place = -1;              // the target's triangle there
    bool into() const { return cosine < 0; }
};

// On an edge or a corner of the target, more than one of its triangles is closest, and which of them answers hangs on a
// rounding: the least cosine of all counts. `hint` is a triangle of the target that is probably near, or -1. Of a
// detour of more than `most` it is only said that it is infinite, and sooner.
Facing facing(const Point& centre, const Point& area_normal, const FitTarget& target, int hint = -1,
              double most = std::numeric_limits<double>::infinity());

// What counts where a triangle is closest to an edge of the target: the side that happens to answer, or both.
enum class EdgeSides { one, both };

// Which triangles of a mesh look into the target, kept up to date while its vertices move: only those that moved are
// asked again.
class FacingWatch {
public:
    // Both must outlive it. `places` has a triangle of the target that is probably near for each of the mesh's, or
    // nothing.
    FacingWatch(const Triangles& triangles, const FitTarget& target, EdgeSides sides, std::vector<int> places = {});
    std::vector<int> into(const Points& positions); // ascending

private:
    void ask(const Points& positions, std::ptrdiff_t t);

    const Triangles& triangles_;
    const FitTarget& target_;
    EdgeSides sides_;
    std::vector<int> places_; // the target's triangle closest to each centre, or -1
    std::vector<char> flags_;
    Points last_;
};

// Triangles of the mesh that look into the target where both sides of edges count, ascending: those of
// flipped_triangles, and those that are closest to an edge of the target and agree with one side of it alone.
std::vector<int> facing_into(const Points& positions, const Triangles& triangles, const FitTarget& target);

// For each triangle what `of_vertices` says for its first corner; nothing for nothing.
std::vector<int> at_first_corners(const Triangles& triangles, const std::vector<int>& of_vertices);

} // namespace meshtween
