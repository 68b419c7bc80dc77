// Where a fitted mesh is turned over or cuts itself, though neither of the two shapes does there.
#pragma once

#include "meshtween/core/mesh.h"
#include "meshtween/fit/facing.h"
#include "meshtween/fit/refine.h"
#include "meshtween/fit/shell.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace meshtween {

// Cuts of the shapes themselves: no fit has to mend them.
struct KnownCuts {
    std::vector<std::array<int, 2>> source; // pairs of triangles, ascending
    std::vector<char> target;               // a flag a triangle: it touches one that cuts another
};

// What mending may cost beside the fit itself, in vertices of patches that are laid out anew: one costs about as much
// as two vertices of the fit. Some ten seconds are always there: small meshes of unlike shapes need many tries. Nudges
// may go over the whole mesh twenty times.
struct MendingEffort {
    double left = 0;   // falls
    double nudges = 0; // vertices that are still nudged, counted once a round; falls
    double large = 0;  // vertices of a patch: where such a one is in vain, a wider one is not tried
};
inline MendingEffort mending_effort(Eigen::Index vertices) {
    const auto count = static_cast<double>(vertices);
    return {count + 60000, 20 * count, std::max(count / 20, 2000.0)};
}

// What is looked at; both must outlive it. What else it has is made when first needed: most fits have no cuts to ask
// about.
struct TangleSearch {
    const Shell& shell;
    const FitTarget& target;
    std::optional<KnownCuts> known;
    std::vector<char> beyond = {};          // without_counterpart
    std::optional<FacingWatch> facing = {}; // with both sides of edges
    MendingEffort* effort = nullptr;        // of the whole fit; null: as much as it takes
};

inline bool is_beyond(const TangleSearch& search, int vertex) {
    return !search.beyond.empty() && search.beyond[static_cast<std::size_t>(vertex)] != 0;
}

// Of the triangles that look into the target those that count: neither beyond its border nor where it cuts itself.
std::vector<int> new_flips(TangleSearch& search, const Points& positions, std::vector<int> flipped);

// Pairs of triangles that cut each other, ascending, or come so near that they may do so in a file of floats.
std::vector<std::array<int, 2>> all_cuts(const Points& positions, const Triangles& triangles);
std::vector<std::array<int, 2>> all_cuts(const Points& positions, const Triangles& triangles,
                                         const std::vector<char>& chosen);

// Pairs of triangles that cut each other, ascending, without those that do so in the source and those that lie where
// the target does. With `chosen`, a flag a triangle, only pairs with a chosen triangle are looked for.
std::vector<std::array<int, 2>> new_cuts(TangleSearch& search, const Points& positions);
std::vector<std::array<int, 2>> new_cuts(TangleSearch& search, const Points& positions,
                                         const std::vector<char>& chosen);

// Of those pairs, which lie at `positions`, the ones that count.
std::vector<std::array<int, 2>> without_known(TangleSearch& search, const Points& positions,
                                              const std::vector<std::array<int, 2>>& cuts);

struct Tangles {
    std::vector<int> flips;               // new_flips, ascending
    std::vector<std::array<int, 2>> cuts; // new_cuts
    std::size_t count() const { return flips.size() + cuts.size(); }
};
Tangles tangles(TangleSearch& search, const Points& positions);
// Where the triangles that look into the target are known already, ascending.
Tangles tangles(TangleSearch& search, const Points& positions, std::vector<int> flipped);

// The same after the vertices of the `moved` triangles, a flag each, have moved; and the cuts alone.
std::vector<std::array<int, 2>> new_cuts(TangleSearch& search, const Points& positions,
                                         const std::vector<std::array<int, 2>>& before, const std::vector<char>& moved);
Tangles tangles(TangleSearch& search, const Points& positions, const Tangles& before, const std::vector<char>& moved);

// `now`, a small move away, but the vertices of new cuts that were none `before` stay as they were. They are looked for
// only if the shapes or the fit had cuts before (`known`): elsewhere no sheets lie so near to each other.
Points without_new_cuts(TangleSearch& search, const Points& before, const Tangles& left, const Points& now);

// A flag a triangle: a vertex of it is elsewhere.
std::vector<char> touched(const Shell& shell, const Points& from, const Points& to);

// A flag a vertex: it belongs to a triangle that is turned over or cut `now` and was not so `before`.
std::vector<char> newly_tangled(const Shell& shell, const Tangles& before, const Tangles& now);

} // namespace meshtween
