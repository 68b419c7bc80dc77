// Rounds of finding the surface under a patch and laying the patch out against it. At first only the surface's normals
// count, so that layers slide apart; then the parts of the surface that are uncovered pull as well, as in back_pulls.
#include "meshtween/fit/unfold.h"

#include "meshtween/fit/fold_energy.h"
#include "meshtween/fit/membrane.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/solve/lbfgs.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace meshtween {
namespace {

constexpr int rounds_without_pulls = 3, rounds_with_pulls = 5;
constexpr int rounds_drawn_out = 20; // with pulls, of a membrane: an ear that it has taken along comes back
constexpr int smoothing = 10;        // rounds, of the normals by which a vertex tells the sheet it belongs to
constexpr double least_cosine = 0.3; // between a vertex's look and the surface's, where it is asked for
constexpr double near = 0.05;        // diagonals: the surface is looked for no further away
constexpr double softest = 1e-2, hardest = 1e-3;
constexpr double settled = 0.9; // of the normals under a membrane stays from round to round
constexpr double stay = 0.3, cover = 0.2, hold_marker = 100; // weights beside closeness

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// A patch with numbers of its own, the vertices that move first.
struct Piece {
    std::vector<int> vertices;        // their numbers in the mesh
    std::vector<double> vertex_share; // of the patch's area
    double edge = 0, area = 0;        // a typical length of it now, and its area
    FoldEnergy energy;
    Points x;
    std::vector<int> places;                  // a vertex: the target's triangle of the last answer
    std::optional<ClosestPointIndex> surface; // of the piece, where the last round found it
};

// Rest shapes are scaled as the patch's rim is: what lies between grew or shrank with it.
void add_rest(const Shell& shell, const Points& positions, const std::vector<int>& triangles,
              const std::vector<char>& calm, Piece& piece) {
    double before = 0, now = 0;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        const double area = piece.energy.inverse[k].determinant();
        piece.energy.share[k] = 0.5 / area;
        if (!calm[k]) continue;
        before += piece.energy.share[k];
        now += triangle_area(positions, shell.triangles, triangles[k]);
    }
    const double scale = before > 0 && now > 0 ? std::sqrt(now / before) : 1;
    for (std::size_t k = 0; k < triangles.size(); ++k) {
        piece.energy.inverse[k] /= scale;
        piece.energy.share[k] *= scale * scale;
        piece.area += piece.energy.share[k];
    }
    for (double& share : piece.energy.share) share /= piece.area;
    piece.edge = std::sqrt(piece.area / static_cast<double>(triangles.size()));
}

Piece piece_of(const Shell& shell, const Points& positions, const FoldedPatch& patch) {
    Piece piece;
    std::vector<int> number(idx(positions.rows()), -1);
    const auto take = [&](int vertex) {
        if (number[idx(vertex)] >= 0) return;
        number[idx(vertex)] = static_cast<int>(piece.vertices.size());
        piece.vertices.push_back(vertex);
    };
    for (const int i : patch.vertices) take(i);
    piece.energy.free = std::ssize(piece.vertices);
    std::vector<int> triangles;
    for (const int i : patch.vertices)
        for (const int t : shell.topology.vertex_triangles[i]) triangles.push_back(t);
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
    std::erase_if(triangles, [&](int t) {
        Eigen::Matrix2d edges;
        if (!planar_edges(shell.rest, shell.triangles, t, edges)) return true;
        piece.energy.inverse.emplace_back(edges.inverse());
        return false;
    });
    piece.energy.triangles.resize(std::ssize(triangles), 3);
    piece.energy.share.resize(triangles.size());
    std::vector<char> calm(triangles.size(), 1);
    for (std::size_t k = 0; k < triangles.size(); ++k)
        for (int c = 0; c < 3; ++c) {
            const int vertex = shell.triangles(triangles[k], c);
            take(vertex);
            const int own = number[idx(vertex)];
            piece.energy.triangles(static_cast<Eigen::Index>(k), c) = own;
            if (own < piece.energy.free && patch.remote[idx(own)] == 0) calm[k] = 0;
        }
    add_rest(shell, positions, triangles, calm, piece);
    piece.vertex_share.assign(piece.vertices.size(), 0);
    for (Eigen::Index t = 0; t < piece.energy.triangles.rows(); ++t)
        for (int c = 0; c < 3; ++c)
            piece.vertex_share[idx(piece.energy.triangles(t, c))] += piece.energy.share[idx(t)] / 3;
    piece.x.resize(std::ssize(piece.vertices), 3);
    for (std::size_t i = 0; i < piece.vertices.size(); ++i)
        piece.x.row(static_cast<Eigen::Index>(i)) = positions.row(piece.vertices[i]);
    return piece;
}

// Which way the mesh looks around each vertex. Area vectors of neighbouring triangles are added up: over a fold they
// cancel but for the sheet that is left when it is undone.
Points looks(const Shell& shell, Points& positions, const Piece& piece, int smoothing_rounds) {
    const auto count = std::ssize(piece.vertices);
    for (Eigen::Index i = 0; i < piece.energy.free; ++i) positions.row(piece.vertices[idx(i)]) = piece.x.row(i);
    Points sums(count, 3), next;
    std::vector<int> number(idx(positions.rows()), -1);
    for (Eigen::Index i = 0; i < count; ++i) {
        number[idx(piece.vertices[idx(i)])] = static_cast<int>(i);
        Point sum(0, 0, 0);
        for (const int t : shell.topology.vertex_triangles[piece.vertices[idx(i)]])
            sum += double_area_normal(positions, shell.triangles, t);
        sums.row(i) = sum;
    }
    for (int round = 0; round < smoothing_rounds; ++round) {
        next = sums;
        for (Eigen::Index i = 0; i < piece.energy.free; ++i) {
            const auto list = shell.topology.neighbours[piece.vertices[idx(i)]];
            for (const int j : list) next.row(i) += sums.row(number[idx(j)]);
            next.row(i) /= static_cast<double>(1 + list.size());
        }
        sums.swap(next);
    }
    return sums;
}

Point smooth_normal(const FitTarget& target, const SurfacePoint& where) {
    Point normal(0, 0, 0);
    for (int k = 0; k < 3; ++k)
        normal += where.barycentric[k] * target.normals.row(target.triangles(where.triangle, k));
    return normal.normalized();
}

// The surface under the patch: where each vertex belongs, and which way each triangle has to look. Of what was found
// before, the part `kept` stays.
void find_surface(const FitTarget& target, const Points& look, bool any_sheet, double kept, Piece& piece) {
    FoldEnergy& energy = piece.energy;
    Points normals(look.rows(), 3);
    piece.places.resize(piece.vertices.size(), -1);
    for (Eigen::Index i = 0; i < look.rows(); ++i) {
        int& place = piece.places[idx(i)];
        const Compatible compatible{look.row(i).normalized(), any_sheet ? -1 : least_cosine};
        ClosestPoint closest = target.index.closest(Point(piece.x.row(i)), compatible, near, place);
        if (!closest.found()) closest = target.index.closest(Point(piece.x.row(i)), place);
        place = closest.where.triangle;
        normals.row(i) = smooth_normal(target, closest.where);
        if (i >= energy.free) continue;
        energy.planes[idx(i)] = closest.position;
        energy.normals[idx(i)] = normals.row(i);
    }
    for (Eigen::Index t = 0; t < energy.triangles.rows(); ++t) {
        const auto f = energy.triangles.row(t);
        const Point sum = normals.row(f[0]) + normals.row(f[1]) + normals.row(f[2]);
        const Point now = sum.norm() > 0 ? Point(sum.normalized()) : Point(normals.row(f[0]));
        Point& outward = energy.outward[idx(t)];
        outward = (kept * outward + (1 - kept) * now).normalized();
    }
}

void add_pulls(const FoldedPatch& patch, std::span<const TargetSample> samples, Piece& piece) {
    FoldEnergy& energy = piece.energy;
    if (piece.surface)
        piece.surface->move(piece.x);
    else
        piece.surface.emplace(piece.x, energy.triangles, MeshIs::moving);
    for (const int k : patch.samples) {
        const TargetSample& sample = samples[idx(k)];
        const ClosestPoint place = piece.surface->closest(sample.position, Compatible{sample.normal, 0});
        if (!place.found()) continue;
        const auto f = energy.triangles.row(place.where.triangle);
        energy.pulls.push_back({{f[0], f[1], f[2]},
                                place.where.barycentric,
                                sample.position,
                                cover * sample.area / piece.area / (piece.edge * piece.edge)});
    }
}

std::vector<FoldPull> held_markers(const Shell& shell, Eigen::Index count, const Piece& piece,
                                   std::span<const Pin> pins) {
    std::vector<int> number(idx(count), -1);
    for (std::size_t i = 0; i < piece.vertices.size(); ++i) number[idx(piece.vertices[i])] = static_cast<int>(i);
    std::vector<FoldPull> held;
    for (const Pin& pin : pins) {
        const auto f = shell.triangles.row(pin.where.triangle);
        const std::array<int, 3> own{number[idx(f[0])], number[idx(f[1])], number[idx(f[2])]};
        if (std::any_of(own.begin(), own.end(), [](int i) { return i < 0; })) continue;
        held.push_back({own, pin.where.barycentric, pin.target,
                        hold_marker / (piece.edge * piece.edge) / static_cast<double>(piece.energy.triangles.rows())});
    }
    return held;
}

// The patch onto the surface, each step halved, then refused, where it would crush a triangle: outside a sharp corner
// of the surface many vertices are closest to one point.
Points set_down(const FitTarget& target, const Piece& piece) {
    constexpr double reach = 0.01, least_left = 0.1; // diagonals; of a triangle's stretch
    constexpr int halvings = 4;
    const FoldEnergy& energy = piece.energy;
    Points goals = piece.x, now = piece.x;
    for (Eigen::Index i = 0; i < energy.free; ++i) {
        const Compatible compatible{energy.normals[idx(i)], least_cosine};
        const ClosestPoint onto = target.index.closest(Point(piece.x.row(i)), compatible, reach, piece.places[idx(i)]);
        if (onto.found()) goals.row(i) = onto.position;
    }
    std::vector<double> share(piece.vertices.size(), 1.0);
    for (int round = 0; round <= halvings; ++round) {
        for (Eigen::Index i = 0; i < energy.free; ++i)
            now.row(i) = piece.x.row(i) + share[idx(i)] * (goals.row(i) - piece.x.row(i));
        std::vector<char> shorten(share.size(), 0);
        for (Eigen::Index t = 0; t < energy.triangles.rows(); ++t) {
            const double before = stretch(energy, piece.x, t);
            if (before <= 0 || stretch(energy, now, t) >= least_left * before) continue;
            for (int k = 0; k < 3; ++k) shorten[idx(energy.triangles(t, k))] = 1;
        }
        for (std::size_t i = 0; i < share.size(); ++i)
            if (shorten[i]) share[i] = round + 1 >= halvings ? 0 : share[i] / 2;
    }
    return now.topRows(energy.free);
}

} // namespace

std::vector<TargetSample> target_samples(const FitTarget& target) {
    std::vector<TargetSample> samples;
    const double area = surface_area(target.positions, target.triangles);
    for (Eigen::Index i = 0; i < target.positions.rows(); ++i)
        samples.push_back({target.positions.row(i), target.normals.row(i), target.area[idx(i)] * area / 2});
    for (Eigen::Index t = 0; t < target.triangles.rows(); ++t) {
        const auto f = target.triangles.row(t);
        samples.push_back({(target.positions.row(f[0]) + target.positions.row(f[1]) + target.positions.row(f[2])) / 3,
                           target.index.normals().row(t), triangle_area(target.positions, target.triangles, t) / 2});
    }
    return samples;
}

Points unfolded(const Shell& shell, const Points& positions, const FoldedPatch& patch, const FitTarget& target,
                std::span<const TargetSample> samples, std::span<const Pin> pins) {
    Piece piece = piece_of(shell, positions, patch);
    FoldEnergy& energy = piece.energy;
    const double unit = 1 / (piece.edge * piece.edge);
    energy.outward.assign(energy.share.size(), Point(0, 0, 0));
    energy.planes.resize(idx(energy.free)), energy.normals.resize(idx(energy.free));
    for (Eigen::Index i = 0; i < energy.free; ++i) {
        const double remote = patch.remote[idx(i)], share = piece.vertex_share[idx(i)] * unit;
        energy.homes.emplace_back(piece.x.row(i));
        energy.onto.push_back(share);
        energy.home.push_back(stay * remote * remote * share);
    }
    if (patch.membrane) piece.x = membrane(piece.x, energy.triangles, energy.free);
    const std::vector<FoldPull> markers = held_markers(shell, positions.rows(), piece, pins);
    LbfgsOptions options;
    options.first_step = 0.2 * piece.edge;
    options.longest_step = 3 * piece.edge;
    const int rounds = rounds_without_pulls + (patch.membrane ? rounds_drawn_out : rounds_with_pulls);
    // A membrane has one layer, so that what was found under it is right from the start, and need not jump from one
    // side of a thin part of the target to the other.
    const double kept = patch.membrane ? settled : 0;
    Points whole = positions, all = piece.x;
    for (int round = 0; round < rounds; ++round) {
        const int smooth = std::max(1, smoothing * (rounds - round) / rounds);
        energy.sliding = round < rounds_without_pulls;
        find_surface(target, looks(shell, whole, piece, smooth), patch.any_sheet && energy.sliding, kept, piece);
        energy.pulls = markers;
        if (!energy.sliding) add_pulls(patch, samples, piece);
        // What has shrunk to nothing grows only once that costs more than what makes room for it.
        const double least = least_stretch(energy, piece.x), part = static_cast<double>(round) / rounds;
        energy.softness =
            least > 0.05 ? hardest : softest * std::pow(hardest / softest, part) + 0.2 * std::max(0.0, -least);
        piece.x.topRows(energy.free) = lbfgs(
            piece.x.topRows(energy.free),
            [&](const Points& moved, Points& gradient) {
                all.topRows(energy.free) = moved;
                return fold_energy(energy, all, gradient);
            },
            options);
    }
    return set_down(target, piece);
}

} // namespace meshtween
