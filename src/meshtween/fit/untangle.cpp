// First comes prevention: most folds begin small, late, and unfold by themselves once what surrounds them has settled.
// What is left is laid out anew, since moving vertices one by one cannot turn several layers back into one.
#include "meshtween/fit/untangle.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/fold_patches.h"
#include "meshtween/fit/nudge.h"
#include "meshtween/fit/unfold.h"
#include "meshtween/geometry/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace meshtween {
namespace {

constexpr int tries = 6;                       // sizes of a patch
constexpr int patience = 2;                    // sizes that mend nothing, in a row
constexpr double hardly = 0.95;                // of its faults left: a patch was in vain
constexpr int least_rings = 3;                 // around a fault
constexpr double widening = 1.4;               // from one size to the next
constexpr std::array flattened_rings{3, 5, 8}; // around what no size of patch mended

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// Values spread to neighbours, less `loss` for each ring.
void spread(const Lists& neighbours, std::vector<double>& values, double loss) {
    std::vector<double> wider = values;
    for (std::size_t i = 0; i < values.size(); ++i)
        for (const int j : neighbours[static_cast<std::ptrdiff_t>(i)])
            wider[i] = std::max(wider[i], values[idx(j)] - loss);
    values.swap(wider);
}

// The triangle of the mesh that answers for each sample, or -1.
std::vector<int> answering(const Shell& shell, const Points& positions, const std::vector<TargetSample>& samples) {
    constexpr double reach = 0.3;
    const ClosestPointIndex index(positions, shell.triangles, MeshIs::moving); // sooner made: no hints
    std::vector<int> triangle(samples.size());
    parallel_for(std::ssize(samples), [&](std::ptrdiff_t k) {
        const TargetSample& sample = samples[idx(k)];
        triangle[idx(k)] = index.closest(sample.position, Compatible{sample.normal, 0}, reach).where.triangle;
    });
    return triangle;
}

// The target as the patches share it.
struct Cover {
    std::vector<TargetSample> samples;
    std::vector<int> triangles; // of the mesh, that answer for them
};

// Swaps the patch's places in x.
void put(const FoldedPatch& patch, Points& places, Points& x) {
    for (std::size_t i = 0; i < patch.vertices.size(); ++i)
        x.row(patch.vertices[i]).swap(places.row(static_cast<Eigen::Index>(i)));
}

struct Mended : Untangled {
    bool stuck = false;     // nudging it moves nothing
    bool hopeless = false;  // many faults, of which the last patches mended hardly any
    std::vector<char> vain; // a flag a vertex: of a large patch that lost hardly a fault
};

bool in_vain(const Mended& result, const FoldedPatch& patch) {
    const auto vain = std::ranges::count_if(patch.vertices, [&](int v) { return result.vain[idx(v)] != 0; });
    return 2 * vain > std::ssize(patch.vertices);
}

// What the effort that is left allows, small patches first; no large ones where one was in vain.
void afford(TangleSearch& search, const Mended& result, FoldedPatches& patches) {
    if (search.effort == nullptr) return;
    constexpr double membranes = 3; // cost of one beside others: it takes more rounds
    std::vector<std::size_t> order(patches.list.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto size = [&](std::size_t k) { return static_cast<double>(patches.list[k].vertices.size()); };
    std::ranges::stable_sort(order, {}, size);
    std::vector<char> kept(order.size(), 0);
    for (const std::size_t k : order) {
        const double cost = size(k) * (patches.list[k].membrane ? membranes : 1);
        if (cost > search.effort->left || (size(k) > search.effort->large && in_vain(result, patches.list[k]))) break;
        kept[k] = 1;
        search.effort->left -= cost;
    }
    keep_patches(patches, kept);
}

// Every patch laid out anew, then those taken back that are no better.
void mend(TangleSearch& search, FoldedPatches& patches, const Cover& cover, std::span<const Pin> pins, Mended& result) {
    if (patches.list.empty()) return;
    const Shell& shell = search.shell;
    for (std::size_t k = 0; k < cover.samples.size(); ++k)
        if (cover.triangles[k] >= 0)
            if (const int patch = patches.of_triangle(shell.triangles, cover.triangles[k]); patch >= 0)
                patches.list[idx(patch)].samples.push_back(static_cast<int>(k));
    std::vector<Points> places(patches.list.size());
    parallel_for(
        std::ssize(places),
        [&](std::ptrdiff_t k) {
            places[idx(k)] =
                unfolded(shell, result.positions, patches.list[idx(k)], search.target, cover.samples, pins);
        },
        1);
    std::vector<char> moved(idx(shell.triangles.rows()));
    for (Eigen::Index t = 0; t < shell.triangles.rows(); ++t)
        moved[idx(t)] = patches.of_triangle(shell.triangles, static_cast<int>(t)) >= 0;
    Points trial = result.positions;
    for (std::size_t k = 0; k < places.size(); ++k) put(patches.list[k], places[k], trial);
    Tangles left = tangles(search, trial, result.left, moved);
    const auto before = faults_of(patches, shell.triangles, result.left),
               after = faults_of(patches, shell.triangles, left);
    int better = 0;
    bool all = true;
    for (std::size_t k = 0; k < places.size(); ++k) {
        if (static_cast<double>(after[k]) > hardly * static_cast<double>(before[k]))
            for (const int v : patches.list[k].vertices) result.vain[idx(v)] = 1;
        if (after[k] < before[k]) {
            ++better;
            continue;
        }
        put(patches.list[k], places[k], trial);
        all = false;
    }
    if (better == 0) return;
    if (!all) left = tangles(search, trial, result.left, moved);
    if (left.count() >= result.left.count()) return; // patches beside each other may spoil each other
    result.positions = std::move(trial);
    result.left = std::move(left);
    result.patches += better;
    result.stuck = false;
}

// What is left, where it is little, by moves of single vertices: sooner done than a wider patch.
void nudge_rest(TangleSearch& search, std::span<const Pin> pins, const Progress& progress, Mended& result) {
    if (result.stuck || result.left.count() == 0 || result.left.count() > few_faults) return;
    Nudged nudged = nudge(search, result.positions, result.left, pins, false, {}, progress);
    result.cancelled = nudged.cancelled;
    result.stuck = !nudged.cancelled && nudged.left.count() >= result.left.count();
    if (nudged.left.count() >= result.left.count()) return;
    result.positions = std::move(nudged.positions);
    result.left = std::move(nudged.left);
}

// Of many faults that one size of a patch leaves nearly all, a wider one mends next to none, too: the shapes do not
// answer to each other there.
bool gained_little(std::size_t before, std::size_t after) {
    return after >= before ||
           (after > many_faults && static_cast<double>(after) > hardly * static_cast<double>(before));
}

// Patches of growing size, as long as they mend anything.
void laid_out(TangleSearch& search, const Cover& cover, std::span<const Pin> pins, const Progress& progress,
              Mended& result) {
    double rings = least_rings;
    for (int k = 0, idle = 0; k < tries && idle < patience && result.left.count() > 0; ++k, rings *= widening) {
        const double part = static_cast<double>(k) / tries;
        result.cancelled = !keep_going(progress, part, "untangling");
        if (result.cancelled) return;
        FoldedPatches patches = patches_around(search, result.left, static_cast<int>(rings));
        for (FoldedPatch& patch : patches.list) patch.any_sheet = k % 2 == 0; // each way mends what the other does not
        afford(search, result, patches);
        const std::size_t before = result.left.count();
        mend(search, patches, cover, pins, result);
        nudge_rest(search, pins, part_of(progress, part + 0.5 / tries, part + 1.0 / tries), result);
        if (result.cancelled) return;
        idle = gained_little(before, result.left.count()) ? idle + 1 : 0;
        result.hopeless = idle > 0 && result.left.count() > many_faults;
    }
}

// What stands up far beside its width, such as a horse's tail on a cow, leaves no place for its layers to slide apart,
// at any size of a patch. As a membrane it has one layer from the start, and what was small there grows.
void flattened(TangleSearch& search, const Cover& cover, std::span<const Pin> pins, const Progress& progress,
               Mended& result) {
    for (std::size_t k = 0; k < flattened_rings.size(); ++k)
        for (const bool any_sheet : {true, false}) {
            if (result.left.count() == 0 || result.cancelled || result.hopeless) return;
            const double part = static_cast<double>(2 * k + (any_sheet ? 0 : 1)) / (2 * flattened_rings.size());
            result.cancelled = !keep_going(progress, part, "untangling");
            if (result.cancelled) return;
            FoldedPatches patches = patches_around(search, result.left, flattened_rings[k]);
            fill_holes(search, patches);
            if (std::ranges::any_of(patches.list, [&](const FoldedPatch& patch) {
                    return 2 * patch.vertices.size() > search.shell.area.size();
                }))
                return; // what stands up is a part of the mesh
            const std::size_t before = result.left.count();
            for (FoldedPatch& patch : patches.list) {
                patch.membrane = true;
                patch.any_sheet = any_sheet;
            }
            afford(search, result, patches);
            mend(search, patches, cover, pins, result);
            nudge_rest(search, pins, part_of(progress, part, part), result);
            result.hopeless = result.left.count() > many_faults && gained_little(before, result.left.count());
        }
}

// The triangles around edges where the mesh is folded by more than a right angle.
std::vector<char> folded(const Shell& shell, const Points& x) {
    std::vector<char> corner(shell.area.size(), 0), result(idx(shell.triangles.rows()), 0);
    const Points normals = triangle_normals(x, shell.triangles);
    for (const Edge& edge : shell.topology.edges) {
        if (edge.count != 2) continue;
        const auto [s, t] = edge.triangles;
        if (normals.row(s).dot(normals.row(t)) >= 0) continue;
        for (int k = 0; k < 3; ++k) corner[idx(shell.triangles(s, k))] = corner[idx(shell.triangles(t, k))] = 1;
    }
    for (Eigen::Index t = 0; t < shell.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) result[idx(t)] |= corner[idx(shell.triangles(t, k))];
    return result;
}

template <typename Flag>
void mark_corners(const Triangles& triangles, const std::array<int, 2>& pair, std::vector<Flag>& corners) {
    for (const int t : pair)
        for (int k = 0; k < 3; ++k) corners[idx(triangles(t, k))] = 1;
}

} // namespace

Points held_back(TangleSearch& search, const Points& before, const Points& now) {
    constexpr int rounds = 3;
    constexpr int faded = 4; // rings
    constexpr double fading = 1.0 / faded;
    const Triangles& triangles = search.shell.triangles;
    const Lists& neighbours = search.shell.topology.neighbours;
    Points result = now;
    std::vector<char> cut_before(search.shell.area.size(), 0);
    std::vector<char> seen = folded(search.shell, result);
    for (int round = 0; round < rounds; ++round) {
        const auto cuts = new_cuts(search, result, seen);
        if (cuts.empty()) break;
        if (round == 0)
            for (const auto& pair : new_cuts(search, before, seen)) mark_corners(triangles, pair, cut_before);
        std::vector<double> share(search.shell.area.size(), 0.0);
        const auto lost = [&](int t) {
            return cut_before[idx(triangles(t, 0))] || cut_before[idx(triangles(t, 1))] ||
                   cut_before[idx(triangles(t, 2))];
        };
        for (const auto& pair : cuts)
            if (!lost(pair[0]) && !lost(pair[1])) mark_corners(triangles, pair, share);
        spread(neighbours, share, 0);
        for (int ring = 1; ring < faded; ++ring) spread(neighbours, share, fading);
        const Points last = result;
        for (Eigen::Index i = 0; i < result.rows(); ++i)
            if (share[idx(i)] > 0) result.row(i) += share[idx(i)] * (before.row(i) - result.row(i));
        seen = touched(search.shell, last, result);
    }
    return result;
}

Points eased(TangleSearch& search, const Points& positions) {
    constexpr int rounds = 12;
    const Lists& neighbours = search.shell.topology.neighbours;
    Points best = positions, trial = positions;
    std::size_t fewest = 0;
    for (int round = 0; round <= rounds; ++round) {
        const auto cuts = new_cuts(search, trial, folded(search.shell, trial));
        if (round == 0) fewest = cuts.size();
        if (cuts.size() < fewest) fewest = cuts.size(), best = trial;
        if (cuts.empty()) break;
        std::vector<double> near(search.shell.area.size(), 0.0);
        for (const auto& pair : cuts) mark_corners(search.shell.triangles, pair, near);
        spread(neighbours, near, 0);
        const Points last = trial;
        for (Eigen::Index i = 0; i < trial.rows(); ++i) {
            if (near[idx(i)] == 0 || search.shell.topology.on_boundary[idx(i)]) continue;
            Point mean(0, 0, 0);
            for (const int j : neighbours[i]) mean += last.row(j);
            trial.row(i) = 0.5 * (last.row(i) + mean / static_cast<double>(neighbours[i].size()));
        }
    }
    return best;
}

Untangled untangle(TangleSearch& search, const Points& positions, const Tangles& faults, std::span<const Pin> pins,
                   const Progress& progress) {
    Mended result{{positions, faults}, false, false, std::vector<char>(search.shell.area.size(), 0)};
    if (result.left.count() == 0) return result;
    Cover cover{target_samples(search.target), {}};
    cover.triangles = answering(search.shell, positions, cover.samples);
    laid_out(search, cover, pins, part_of(progress, 0, 0.5), result);
    if (!result.cancelled) flattened(search, cover, pins, part_of(progress, 0.5, 1), result);
    return result;
}

} // namespace meshtween
