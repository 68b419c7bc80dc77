#include "meshtween/fit/tangles.h"

#include "meshtween/fit/counterpart.h"
#include "meshtween/fit/settle.h"
#include "meshtween/search/self_intersections.h"

#include <algorithm>
#include <iterator>

namespace meshtween {
namespace {

constexpr double least_gap = 1e-7; // diagonals, between sheets: about what a float rounds off

using Pairs = std::vector<std::array<int, 2>>;

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

std::vector<char> cut_places(const FitTarget& target) {
    std::vector<char> corner(idx(target.positions.rows()), 0), flag(idx(target.triangles.rows()), 0);
    for (const auto& pair : all_cuts(target.positions, target.triangles))
        for (const int t : pair)
            for (int k = 0; k < 3; ++k) corner[idx(target.triangles(t, k))] = 1;
    for (Eigen::Index t = 0; t < target.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) flag[idx(t)] |= corner[idx(target.triangles(t, k))];
    return flag;
}

const KnownCuts& known(TangleSearch& search) {
    if (!search.known)
        search.known = KnownCuts{all_cuts(search.shell.rest, search.shell.triangles), cut_places(search.target)};
    return *search.known;
}

// The triangle lies where the target cuts itself.
bool at_cut(TangleSearch& search, const Points& positions, int t) {
    const Triangles& triangles = search.shell.triangles;
    const Point centre =
        (positions.row(triangles(t, 0)) + positions.row(triangles(t, 1)) + positions.row(triangles(t, 2))) / 3;
    return known(search).target[idx(search.target.index.closest(centre).where.triangle)] != 0;
}

} // namespace

std::vector<int> new_flips(TangleSearch& search, const Points& positions, std::vector<int> flipped) {
    std::vector<int> flips = without_beyond(search.shell.triangles, search.beyond, std::move(flipped));
    std::erase_if(flips, [&](int t) { return at_cut(search, positions, t); });
    return flips;
}

Pairs all_cuts(const Points& positions, const Triangles& triangles) {
    return self_intersections(positions, triangles, least_gap);
}

Pairs all_cuts(const Points& positions, const Triangles& triangles, const std::vector<char>& chosen) {
    return self_intersections(positions, triangles, chosen, least_gap);
}

Pairs without_known(TangleSearch& search, const Points& positions, const Pairs& cuts) {
    if (cuts.empty()) return {};
    const Pairs& own = known(search).source;
    Pairs fresh;
    std::set_difference(cuts.begin(), cuts.end(), own.begin(), own.end(), std::back_inserter(fresh));
    std::erase_if(fresh, [&](const std::array<int, 2>& pair) {
        return at_cut(search, positions, pair[0]) || at_cut(search, positions, pair[1]);
    });
    return fresh;
}

Pairs new_cuts(TangleSearch& search, const Points& positions) {
    return without_known(search, positions, all_cuts(positions, search.shell.triangles));
}

Pairs new_cuts(TangleSearch& search, const Points& positions, const std::vector<char>& chosen) {
    return without_known(search, positions, all_cuts(positions, search.shell.triangles, chosen));
}

Tangles tangles(TangleSearch& search, const Points& positions) {
    return tangles(search, positions, flipped_triangles(positions, search.shell.triangles, search.target));
}

Tangles tangles(TangleSearch& search, const Points& positions, std::vector<int> flipped) {
    return {new_flips(search, positions, std::move(flipped)), new_cuts(search, positions)};
}

Pairs new_cuts(TangleSearch& search, const Points& positions, const Pairs& before, const std::vector<char>& moved) {
    Pairs result = new_cuts(search, positions, moved);
    std::copy_if(before.begin(), before.end(), std::back_inserter(result),
                 [&](const auto& pair) { return !moved[idx(pair[0])] && !moved[idx(pair[1])]; });
    std::sort(result.begin(), result.end());
    return result;
}

Tangles tangles(TangleSearch& search, const Points& positions, const Tangles& before, const std::vector<char>& moved) {
    std::vector<int> numbers;
    for (std::size_t t = 0; t < moved.size(); ++t)
        if (moved[t]) numbers.push_back(static_cast<int>(t));
    Tangles fresh{flipped_triangles(positions, search.shell.triangles(numbers, Eigen::all), search.target),
                  new_cuts(search, positions, before.cuts, moved)};
    for (int& t : fresh.flips) t = numbers[idx(t)];
    fresh.flips = new_flips(search, positions, std::move(fresh.flips));
    std::copy_if(before.flips.begin(), before.flips.end(), std::back_inserter(fresh.flips),
                 [&](int t) { return !moved[idx(t)]; });
    std::sort(fresh.flips.begin(), fresh.flips.end());
    return fresh;
}

Points without_new_cuts(TangleSearch& search, const Points& before, const Tangles& left, const Points& now) {
    if (!search.known) return now;
    const Triangles& triangles = search.shell.triangles;
    Points result = now;
    Pairs cuts = new_cuts(search, result);
    while (true) {
        const Points last = result;
        for (const auto& pair : cuts) {
            if (std::binary_search(left.cuts.begin(), left.cuts.end(), pair)) continue;
            for (const int t : pair)
                for (int k = 0; k < 3; ++k) result.row(triangles(t, k)) = before.row(triangles(t, k));
        }
        if (result == last) return result;
        cuts = new_cuts(search, result, touched(search.shell, last, result)); // what has not moved cuts no more
    }
}

std::vector<char> touched(const Shell& shell, const Points& from, const Points& to) {
    std::vector<char> result(idx(shell.triangles.rows()), 0);
    for (Eigen::Index i = 0; i < from.rows(); ++i)
        if (from.row(i) != to.row(i))
            for (const int t : shell.topology.vertex_triangles[i]) result[idx(t)] = 1;
    return result;
}

std::vector<char> newly_tangled(const Shell& shell, const Tangles& before, const Tangles& now) {
    std::vector<char> result(idx(shell.rest.rows()), 0);
    const auto flag = [&](int t) {
        for (int k = 0; k < 3; ++k) result[idx(shell.triangles(t, k))] = 1;
    };
    for (const int t : now.flips)
        if (!std::binary_search(before.flips.begin(), before.flips.end(), t)) flag(t);
    for (const auto& pair : now.cuts)
        if (!std::binary_search(before.cuts.begin(), before.cuts.end(), pair)) flag(pair[0]), flag(pair[1]);
    return result;
}

} // namespace meshtween
