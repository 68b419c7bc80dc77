// Where a fitted mesh is turned over or cuts itself, though neither of the two shapes does there.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/refine.h"
#include "meshtween/fit/shell.h"

#include <array>
#include <optional>
#include <vector>

namespace meshtween {

// Cuts of the shapes themselves: no fit has to mend them.
struct KnownCuts {
    std::vector<std::array<int, 2>> source; // pairs of triangles, ascending
    std::vector<char> target;               // a flag a triangle: it touches one that cuts another
};

// What is looked at; both must outlive it. `known` is found when first needed: most fits have no cuts to ask about.
struct TangleSearch {
    const Shell& shell;
    const FitTarget& target;
    std::optional<KnownCuts> known;
};

// Pairs of triangles that cut each other, ascending, without those that do so in the source and those that lie where
// the target does. With `chosen`, a flag a triangle, only pairs with a chosen triangle are looked for.
std::vector<std::array<int, 2>> new_cuts(TangleSearch& search, const Points& positions);
std::vector<std::array<int, 2>> new_cuts(TangleSearch& search, const Points& positions,
                                         const std::vector<char>& chosen);

struct Tangles {
    std::vector<int> flips;               // triangles that look into the target, ascending, without those at its cuts
    std::vector<std::array<int, 2>> cuts; // new_cuts
    std::size_t count() const { return flips.size() + cuts.size(); }
};
Tangles tangles(TangleSearch& search, const Points& positions);
// Where the triangles that look into the target are known already, ascending.
Tangles tangles(TangleSearch& search, const Points& positions, std::vector<int> flipped);

// The same after the vertices of the `moved` triangles, a flag each, have moved.
Tangles tangles(TangleSearch& search, const Points& positions, const Tangles& before, const std::vector<char>& moved);

// `now`, but the vertices of new cuts that were none `before` stay as they were. After a small move these are looked
// for beside places where the shapes cut themselves, if that is known: sheets that touch lie there. `places`: the
// target's triangle at each vertex, or -1.
Points without_new_cuts(TangleSearch& search, const Points& before, const Tangles& left, const Points& now,
                        const std::vector<int>& places);

// A flag a triangle: a vertex of it is elsewhere.
std::vector<char> touched(const Shell& shell, const Points& from, const Points& to);

// A flag a vertex: it belongs to a triangle that is turned over or cut `now` and was not so `before`.
std::vector<char> newly_tangled(const Shell& shell, const Tangles& before, const Tangles& now);

} // namespace meshtween
