#include "meshtween/fit/cut_guard.h"

#include <algorithm>
#include <iterator>

namespace meshtween {
namespace {

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// Which part each vertex belongs to, or -1.
struct PartOf {
    const Triangles& triangles;
    std::vector<int> vertex;
    std::size_t count = 0; // of parts

    std::vector<int> at(const std::array<int, 2>& pair) const {
        std::vector<int> result;
        for (const int t : pair)
            for (int k = 0; k < 3; ++k)
                if (const int own = vertex[idx(triangles(t, k))]; own >= 0) result.push_back(own);
        std::sort(result.begin(), result.end());
        result.erase(std::unique(result.begin(), result.end()), result.end());
        return result;
    }
    std::vector<long> counted(const CutPairs& pairs) const {
        std::vector<long> result(count, 0);
        for (const auto& pair : pairs)
            for (const int own : at(pair)) ++result[idx(own)];
        return result;
    }
};

// The vertices of the pairs that have come to parts with more pairs than before go back; says whether any did.
bool take_back(const PartOf& parts, const CutPairs& before, const CutPairs& after, const Points& x, Points& now) {
    const std::vector<long> count_before = parts.counted(before), count = parts.counted(after);
    bool any = false;
    for (const auto& pair : after) {
        if (std::binary_search(before.begin(), before.end(), pair)) continue;
        for (const int t : pair)
            for (int k = 0; k < 3; ++k) {
                const int i = parts.triangles(t, k), own = parts.vertex[idx(i)];
                if (own < 0 || count[idx(own)] <= count_before[idx(own)] || now.row(i) == x.row(i)) continue;
                now.row(i) = x.row(i);
                any = true;
            }
    }
    return any;
}

CutPairs chosen_of(const CutPairs& pairs, const std::vector<char>& chosen, bool which) {
    CutPairs result;
    std::ranges::copy_if(pairs, std::back_inserter(result),
                         [&](const auto& pair) { return (chosen[idx(pair[0])] || chosen[idx(pair[1])]) == which; });
    return result;
}

} // namespace

Cuts cuts_of(TangleSearch& search, const Points& positions) {
    Cuts cuts{all_cuts(positions, search.shell.triangles), {}};
    cuts.fresh = without_known(search, positions, cuts.all);
    return cuts;
}

Cuts take_back_cuts(TangleSearch& search, const std::vector<std::vector<int>>& parts, const Points& from,
                    const Cuts& before, Points& to) {
    const Triangles& triangles = search.shell.triangles;
    PartOf part{triangles, std::vector<int>(idx(from.rows()), -1), parts.size()};
    for (std::size_t k = 0; k < parts.size(); ++k)
        for (const int i : parts[k]) part.vertex[idx(i)] = static_cast<int>(k);
    const std::vector<char> moved = touched(search.shell, from, to);
    const Cuts then{chosen_of(before.all, moved, true), chosen_of(before.fresh, moved, true)};
    Cuts now;
    do {
        now.all = all_cuts(to, triangles, moved);
        now.fresh = without_known(search, to, now.all);
    } while (take_back(part, then.all, now.all, from, to) || take_back(part, then.fresh, now.fresh, from, to));
    const auto joined = [&moved](const CutPairs& still, const CutPairs& anew) {
        CutPairs result = chosen_of(still, moved, false);
        const auto middle = std::ssize(result);
        result.insert(result.end(), anew.begin(), anew.end());
        std::inplace_merge(result.begin(), result.begin() + middle, result.end());
        return result;
    };
    return {joined(before.all, now.all), joined(before.fresh, now.fresh)};
}

} // namespace meshtween
