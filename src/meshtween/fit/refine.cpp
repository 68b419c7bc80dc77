// Closest points pull the shell onto the surface along its normal and let it slide along it, so that what lies where
// is left to the shell's own shape.
//
// Chen, Medioni: Object modelling by registration of multiple range images. IVC 1992 (distance to the tangent plane).
// Allen, Curless, Popovic: The space of human body shapes. SIGGRAPH 2003; Amberg, Romdhani, Vetter: Optimal step
// nonrigid ICP algorithms for surface registration. CVPR 2007 (falling stiffness, borders that do not pull).
// Li, Sumner, Pauly: Global correspondence optimization for non-rigid registration of depth scans. SGP 2008.
#include "meshtween/fit/refine.h"

#include "meshtween/core/parallel.h"
#include "meshtween/fit/back_pulls.h"
#include "meshtween/fit/centre_pulls.h"
#include "meshtween/fit/counterpart.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/place_on_triangle.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace meshtween {
namespace {

using Eigen::Matrix3d;

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

// The closest place of the target that looks the way each vertex does. `places` are the target's triangles of the last
// answers, or nothing, and become those of this one.
std::vector<ClosestPoint> closest_alike(const FitTarget& target, const Points& positions, const Points& normals,
                                        double least_cosine, double reach, std::vector<int>& places) {
    std::vector<ClosestPoint> result(idx(positions.rows()));
    places.resize(result.size(), -1);
    parallel_for(
        positions.rows(),
        [&](std::ptrdiff_t i) {
            int& place = places[idx(i)];
            result[idx(i)] =
                target.index.closest(Point(positions.row(i)), Compatible{normals.row(i), least_cosine}, reach, place);
            if (result[idx(i)].found()) place = result[idx(i)].where.triangle;
        },
        256);
    return result;
}

std::vector<double> counterparts_on(const FitTarget& target, const Topology& topology, const Points& positions,
                                    const std::vector<ClosestPoint>& places, const ClosestPointIndex& mesh,
                                    double reach) {
    if (!target.border_index) return std::vector<double>(places.size(), 1.0);
    return counterparts(positions, topology.neighbours, places,
                        {target.triangles, target.topology.on_boundary, target.index}, mesh, reach);
}

struct Pull {
    Matrix3d block = Matrix3d::Zero();
    Point right{0, 0, 0};
};

Pull pull(const FitTarget& target, const ClosestPoint& closest, const Point& normal, bool own_border, double weight,
          const RelaxWeights& weights) {
    Pull result;
    if (!closest.found()) return result;
    if (!own_border && on_border(target, closest.where)) return result;
    const Point n = normal_at(target, closest.where);
    result.block = weight * std::max(0.0, n.dot(normal)) *
                   ((1 - weights.slide) * n.transpose() * n + weights.slide * Matrix3d::Identity());
    result.right = closest.position * result.block;
    return result;
}

// Where the mesh's border runs along the target's, it is drawn onto it and slides along it. The pull fades with the
// distance, so that a mesh that ends elsewhere than the target does is not stretched to its border.
void add_border_pulls(const Shell& shell, const Points& positions, const FitTarget& target, const RelaxWeights& weights,
                      std::vector<Matrix3d>& blocks, Points& right) {
    constexpr double near = 0.04; // diagonals: where the pull has faded to nothing
    const Points directions = border_directions(positions, shell.border);
    parallel_for(positions.rows(), [&](std::ptrdiff_t i) {
        if (!has_border(shell, i)) return;
        const ClosestPoint closest =
            closest_on_border(target, positions.row(i), directions.row(i), shell.border_size[idx(i)]);
        if (!closest.found()) return;
        const auto edge = target.border.row(closest.where.triangle);
        const Point along = (target.positions.row(edge[1]) - target.positions.row(edge[0])).normalized();
        const double trust = std::max(0.0, 1 - closest.squared_distance / (near * near));
        const Matrix3d block = weights.border * weights.closeness * shell.area[idx(i)] * trust * trust *
                               (Matrix3d::Identity() - (1 - weights.slide) * along.transpose() * along);
        blocks[idx(i)] += block;
        right.row(i) += closest.position * block;
    });
}

SurfacePoint coarser_place(const ShellLevels& all, std::size_t finer, const SurfacePoint& place, const Point& query) {
    const Level& coarse = all.levels[finer + 1];
    const Topology& topology = all.shells[finer + 1].topology;
    int corner = 0;
    place.barycentric.maxCoeff(&corner);
    const int vertex = all.levels[finer].triangles(place.triangle, corner);
    const SurfacePoint& start = coarse.place[idx(vertex)];
    SurfacePoint best;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k)
        for (const int t : topology.vertex_triangles[coarse.triangles(start.triangle, k)]) {
            const auto f = coarse.triangles.row(t);
            const auto p = place_on_triangle(query, coarse.positions.row(f[0]), coarse.positions.row(f[1]),
                                             coarse.positions.row(f[2]));
            if (p.squared_distance < least) least = p.squared_distance, best = {t, {1 - p.v - p.w, p.v, p.w}};
        }
    return best;
}

// What a pin asks of the point of the triangle where it is.
struct PinPull {
    double weight = 0;
    Point goal{0, 0, 0};
};

std::vector<PinPull> pin_pulls(const Shell& shell, const std::vector<Pin>& pins, const Points& positions,
                               const std::vector<Matrix3d>& frames, const RelaxWeights& weights) {
    double all = 0;
    for (const Pin& pin : pins) all += pin.weight;
    std::vector<PinPull> pulls;
    for (const Pin& pin : pins) {
        Matrix3d frame = Matrix3d::Zero();
        for (int k = 0; k < 3; ++k)
            frame += pin.where.barycentric[k] * frames[idx(shell.triangles(pin.where.triangle, k))];
        PinPull pull{weights.pins * pin.weight / all, pin.target - pin.offset * frame.transpose()};
        if (pin.slack > 0 && weights.closeness > 0) {
            const Point way = position(positions, shell.triangles, pin.where) - pull.goal;
            const double away = way.norm();
            if (away <= pin.slack)
                pull.weight = 0;
            else
                pull.goal += pin.slack / away * way;
        }
        pulls.push_back(pull);
    }
    return pulls;
}

// Pulls from the target's side and, where they have a share, of the triangles' centres. With these, what is near acts
// on points within triangles; what is further off would tear at them.
void add_sample_pulls(const Shell& shell, const Points& positions, const FitTarget& target, const RelaxWeights& weights,
                      RelaxMemory& memory, BlockSystem& system, Points& right) {
    constexpr double near = 0.05; // of a triangle's size
    const double back = weights.back * weights.closeness;
    std::vector<SamplePull> pulls = back_pulls(shell, positions, target, back, weights.reach, weights.round, memory);
    const std::vector<double> shares = bearable(pulls, shell.triangles, shell.area, back);
    if (weights.centres > 0)
        add_centre_pulls(shell, positions, target, weights.centres * weights.closeness, weights.least_cosine,
                         weights.reach, memory, pulls);
    add_pulls(pulls, shares, weights.centres > 0 ? near : 0, shell, positions, system, right);
}

// The forms of one level with their weights; blocks are still nought, pins are in.
BlockSystem level_system(const ShellLevels& shells, std::size_t level, const RelaxWeights& weights,
                         const std::vector<PinPull>& pulls) {
    const Shell& shell = shells.shells[level];
    const double bending = std::pow(weights.length, 4), membrane = weights.membrane * weights.length * weights.length;
    BlockSystem system;
    system.pattern = shell.pattern;
    system.values.resize(shell.bending.size());
    parallel_for(std::ssize(system.values), [&](std::ptrdiff_t e) {
        system.values[idx(e)] = bending * shell.bending[idx(e)] + membrane * shell.membrane[idx(e)];
    });
    system.blocks.assign(shell.area.size(), Matrix3d::Zero());
    const auto& pins = shells.pins[level];
    for (std::size_t k = 0; k < pins.size(); ++k)
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b) {
                const SurfacePoint& at = pins[k].where;
                const int i = shell.triangles(at.triangle, a), j = shell.triangles(at.triangle, b);
                system.values[shell.pattern->at(i, j)] += pulls[k].weight * at.barycentric[a] * at.barycentric[b];
            }
    return system;
}

void add_pins(const Shell& shell, const std::vector<Pin>& pins, const std::vector<PinPull>& pulls, Points& right) {
    for (std::size_t p = 0; p < pins.size(); ++p)
        for (int k = 0; k < 3; ++k)
            right.row(shell.triangles(pins[p].where.triangle, k)) +=
                pulls[p].weight * pins[p].where.barycentric[k] * pulls[p].goal;
}

} // namespace

FitTarget fit_target(const Points& positions, const Triangles& triangles) {
    FitTarget target{positions,
                     triangles,
                     vertex_normals(positions, triangles),
                     vertex_area_shares(positions, triangles),
                     topology(positions.rows(), triangles),
                     ClosestPointIndex(positions, triangles),
                     {},
                     {},
                     nullptr};
    target.border = border_edges(triangles, target.topology);
    target.border_size = border_sizes(positions, target.border);
    if (target.border.rows() > 0)
        target.border_index = std::make_shared<const ClosestPointIndex>(positions, target.border);
    return target;
}

ClosestPoint closest_on_border(const FitTarget& target, const Point& point, const Point& direction, double size) {
    constexpr double least_size = 0.5;   // beside the mesh's border
    constexpr double least_cosine = 0.7; // borders at a right angle, or facing each other, are not the same
    if (!target.border_index) return {};
    const ClosestPoint closest = target.border_index->closest(point);
    const auto edge = target.border.row(closest.where.triangle);
    const Point along = (target.positions.row(edge[1]) - target.positions.row(edge[0])).normalized();
    return along.dot(direction) < least_cosine || target.border_size[idx(edge[0])] < least_size * size ? ClosestPoint{}
                                                                                                       : closest;
}

ShellLevels shell_levels(const Points& rest, const Triangles& triangles, const HierarchyOptions& options) {
    ShellLevels all;
    all.levels = hierarchy(rest, triangles, options);
    for (const Level& level : all.levels) all.shells.push_back(shell(level.positions, level.triangles));
    for (std::size_t k = 1; k < all.levels.size(); ++k) {
        std::vector<std::array<int, 3>> points;
        std::vector<Eigen::RowVector3d> weights;
        for (const SurfacePoint& p : all.levels[k].place) {
            const auto f = all.levels[k].triangles.row(p.triangle);
            points.push_back({f[0], f[1], f[2]});
            weights.push_back(p.barycentric);
        }
        all.up.push_back(interpolation(all.levels[k].positions.rows(), std::move(points), std::move(weights)));
    }
    all.pins.resize(all.levels.size());
    all.coarsest_factor = factor_pattern(all.shells.back().pattern);
    return all;
}

void set_pins(ShellLevels& all, std::span<const Pin> pins) {
    const Level& finest = all.levels[0];
    all.pins[0].assign(pins.begin(), pins.end());
    for (std::size_t k = 1; k < all.levels.size(); ++k) {
        all.pins[k].clear();
        for (std::size_t i = 0; i < pins.size(); ++i) {
            const Point at = position(finest.positions, finest.triangles, pins[i].where) + pins[i].offset;
            Pin pin = pins[i];
            pin.where = coarser_place(all, k - 1, all.pins[k - 1][i].where, at);
            pin.offset = at - position(all.levels[k].positions, all.levels[k].triangles, pin.where);
            all.pins[k].push_back(pin);
        }
    }
}

Point normal_at(const FitTarget& target, const SurfacePoint& p) {
    Point n(0, 0, 0);
    for (int k = 0; k < 3; ++k) n += p.barycentric[k] * target.normals.row(target.triangles(p.triangle, k));
    return n.normalized();
}

bool on_border(const FitTarget& target, const SurfacePoint& p) {
    return at_border(p, target.triangles, target.topology.on_boundary);
}

std::vector<char> without_counterpart(const Shell& shell, const Points& positions, const FitTarget& target) {
    if (!target.border_index) return {};
    const RelaxWeights as_relaxed;
    std::vector<int> places;
    const std::vector<ClosestPoint> closest =
        closest_alike(target, positions, vertex_normals(positions, shell.triangles), as_relaxed.least_cosine,
                      as_relaxed.reach, places);
    std::vector<char> flags;
    const ClosestPointIndex mesh(positions, shell.triangles, MeshIs::moving);
    for (const double trust : counterparts_on(target, shell.topology, positions, closest, mesh, as_relaxed.reach))
        flags.push_back(trust < 0.5);
    return flags;
}

void bring_mesh(RelaxMemory& memory, const Shell& shell, const Points& positions) {
    if (memory.mesh)
        memory.mesh->move(positions);
    else
        memory.mesh = std::make_unique<ClosestPointIndex>(positions, shell.triangles, MeshIs::moving);
}

Points relax(const ShellLevels& shells, std::size_t level, const Points& positions, const FitTarget& target,
             const RelaxWeights& weights, RelaxMemory& memory) {
    const Shell& shell = shells.shells[level];
    const auto n = positions.rows();
    Points result = positions;
    const auto frames =
        calmed(local_frames(shell, positions, weights.smoothing, weights.with_scale), weights.calm_turn);
    const std::vector<PinPull> pulls = pin_pulls(shell, shells.pins[level], positions, frames, weights);
    std::vector<BlockSystem> systems{level_system(shells, level, weights, pulls)};
    Points right =
        rest_force(shell, frames, std::pow(weights.length, 4), weights.membrane * weights.length * weights.length);
    add_pins(shell, shells.pins[level], pulls, right);
    if (weights.closeness > 0) {
        const Points normals = vertex_normals(positions, shell.triangles);
        const double clinging = (1 - weights.centres) * weights.closeness;
        bring_mesh(memory, shell, positions);
        const std::vector<ClosestPoint> closest =
            closest_alike(target, positions, normals, weights.least_cosine, weights.reach, memory.places);
        memory.trust = counterparts_on(target, shell.topology, positions, closest, *memory.mesh, weights.reach);
        parallel_for(
            n,
            [&](std::ptrdiff_t i) {
                const Pull p = pull(target, closest[idx(i)], normals.row(i), has_border(shell, i),
                                    memory.trust[idx(i)] * clinging * shell.area[idx(i)], weights);
                systems[0].blocks[idx(i)] = p.block;
                right.row(i) += p.right;
            },
            256);
        add_sample_pulls(shell, positions, target, weights, memory, systems[0], right);
        if (target.border_index) add_border_pulls(shell, positions, target, weights, systems[0].blocks, right);
    }
    std::unique_ptr<Multigrid> solver = std::move(memory.pose);
    if (!solver) {
        for (std::size_t k = level + 1; k < shells.levels.size(); ++k) {
            systems.push_back(level_system(shells, k, weights, pulls));
            systems.back().blocks = to_coarse(shells.up[k - 1], systems[systems.size() - 2]);
        }
        solver = std::make_unique<Multigrid>(std::move(systems), shells.up, level, shells.coarsest_factor);
    }
    solver->solve(right, result, weights.cycles, 1e-3);
    if (weights.closeness <= 0) memory.pose = std::move(solver);
    return result;
}

Points refine_positions(const ShellLevels& shells, std::size_t level, const Points& positions, bool with_scale,
                        double crushed) {
    const Shell& coarse = shells.shells[level];
    const Points& rest = shells.levels[level - 1].positions;
    const auto frames = local_frames(coarse, positions, 0, with_scale);
    Points finer(rest.rows(), 3);
    parallel_for(rest.rows(), [&](std::ptrdiff_t i) {
        const SurfacePoint& place = shells.levels[level].place[idx(i)];
        const double left = crushed > 0 ? triangle_area(positions, coarse.triangles, place.triangle) /
                                              triangle_area(coarse.rest, coarse.triangles, place.triangle)
                                        : 1;
        if (left < crushed) {
            Point on(0, 0, 0), was(0, 0, 0);
            Eigen::Matrix3d frame = Eigen::Matrix3d::Zero();
            for (int k = 0; k < 3; ++k) {
                const int c = coarse.triangles(place.triangle, k);
                on += place.barycentric[k] * positions.row(c);
                was += place.barycentric[k] * coarse.rest.row(c);
                frame += place.barycentric[k] * frames[idx(c)];
            }
            finer.row(i) = on + std::sqrt(left) * (rest.row(i) - was) * frame.transpose();
            return;
        }
        Point sum(0, 0, 0);
        for (int k = 0; k < 3; ++k) {
            const int c = coarse.triangles(place.triangle, k);
            sum += place.barycentric[k] *
                   (positions.row(c) + (rest.row(i) - coarse.rest.row(c)) * frames[idx(c)].transpose());
        }
        finer.row(i) = sum;
    });
    return finer;
}

} // namespace meshtween
