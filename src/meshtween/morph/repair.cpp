// A search instead of a simulation: which side a contact should be resolved to cannot be told where parts pass right
// through each other, so a set of directions is tried, the one across the relative motion among them.
#include "meshtween/morph/repair.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/morph/contacts.h"
#include "meshtween/search/self_intersections.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <unordered_map>

namespace meshtween {
namespace {

// The frames at which cuts are sought, and what the ends have of them.
struct Film {
    const Triangles& triangles;
    std::vector<double> times;
    std::vector<Points> shapes;
    std::vector<Eigen::Matrix3d> turns; // of the whole, from the first shape to each frame
    std::vector<CutPairs> cuts;         // without those of the ends
    CutPairs ends;
};

CutPairs without(const CutPairs& pairs, const CutPairs& others) {
    CutPairs rest;
    std::set_difference(pairs.begin(), pairs.end(), others.begin(), others.end(), std::back_inserter(rest));
    return rest;
}

// How the triangles have turned in the mean. A shape that turns as a whole is bent in a frame that turns with it: what
// comes out does not depend on how an end is turned.
Eigen::Matrix3d turn_of(const Film& film, const Interpolant& path, const Points& shape) {
    const std::vector<int> all(static_cast<std::size_t>(film.triangles.rows()), 0);
    return mean_rotations(face_field(path.nodes.front(), shape, film.triangles), all, 1)[0].toRotationMatrix();
}

bool look(Film& film, const Interpolant& path, const Progress& progress) {
    for (std::size_t f = 0; f < film.times.size(); ++f) {
        if (!keep_going(progress, static_cast<double>(f) / static_cast<double>(film.times.size()), "looking for cuts"))
            return false;
        film.shapes[f] = path.at(film.times[f]);
        film.turns[f] = turn_of(film, path, film.shapes[f]);
        film.cuts[f] = without(self_intersections(film.shapes[f], film.triangles), film.ends);
    }
    return true;
}

std::size_t total(const std::vector<CutPairs>& cuts) {
    std::size_t sum = 0;
    for (const CutPairs& pairs : cuts) sum += pairs.size();
    return sum;
}

// A polynomial with double noughts at 0 and 1, and 1 where it is largest: u^p (1 - u)^q, or a plateau (1 - x^2m)^2 with
// x = 2 u - 1.
struct Bump {
    int p = 2, q = 2, m = 0; // m > 0: the plateau
    double operator()(double u) const {
        if (m > 0) return std::pow(1 - std::pow(2 * u - 1, 2 * m), 2);
        const double peak = static_cast<double>(p) / (p + q);
        return std::pow(u / peak, p) * std::pow((1 - u) / (1 - peak), q);
    }
    int degree() const { return m > 0 ? 4 * m : p + q; }
};

// The one that is highest over all of [a, b]; a later one only where that is worth its degree.
Bump bump_over(double a, double b) {
    Bump best;
    const auto height = [&](const Bump& bump) { return std::min(bump(a), bump(b)); };
    for (int p = 2; p <= 6; ++p)
        for (int q = 2; p + q <= 8; ++q)
            if (height({p, q, 0}) > 1.05 * height(best)) best = {p, q, 0};
    for (int m = 2; m <= 3; ++m)
        if (height({0, 0, m}) > 1.05 * height(best)) best = {0, 0, m};
    return best;
}

// Distances along edges from the triangles' vertices, as far as `most`; vertices beyond are absent.
std::unordered_map<int, double> distances(const Points& shape, const Triangles& triangles, const Lists& neighbours,
                                          const std::vector<int>& seeds, double most) {
    std::unordered_map<int, double> distance;
    using Entry = std::pair<double, int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (const int t : seeds)
        for (int k = 0; k < 3; ++k)
            if (distance.emplace(triangles(t, k), 0).second) queue.emplace(0, triangles(t, k));
    while (!queue.empty()) {
        const auto [d, i] = queue.top();
        queue.pop();
        if (d > distance.at(i)) continue;
        for (const int j : neighbours[i]) {
            const double way = d + (shape.row(i) - shape.row(j)).norm();
            if (way > most) continue;
            const auto [it, fresh] = distance.emplace(j, way);
            if (!fresh && way >= it->second) continue;
            it->second = way;
            queue.emplace(way, j);
        }
    }
    return distance;
}

// What a contact's two sides may be moved by: a vertex each, and how far from the cuts it lies.
struct Movable {
    std::vector<int> vertices;
    std::vector<double> distance[2]; // from either side; infinite where the other is nearer to none
    double plateau[2] = {0, 0};      // up to here a side moves as one
    std::vector<int> triangles;      // those of the vertices
};

// Of a disk of the triangles' area: a long thin contact, such as lips over teeth, is no wider than it is thick.
double radius(const Points& shape, const Triangles& triangles, const std::vector<int>& which) {
    double area = 0;
    for (const int t : which) area += triangle_area(shape, triangles, t);
    return std::sqrt(area / std::numbers::pi);
}

constexpr int patience = 4;  // contacts, the deepest first: where all are too deep, the others are as well
constexpr double gentle = 4; // a side fades out over so many times the way that it is moved

Movable movable(const Film& film, const Contact& contact, const Topology& top, double reach) {
    const Points& shape = film.shapes[static_cast<std::size_t>(contact.worst_frame)];
    Movable result;
    std::unordered_map<int, double> from[2];
    for (int side = 0; side < 2; ++side) {
        result.plateau[side] = radius(shape, film.triangles, contact.sides[side]);
        const double most = result.plateau[side] + std::max(result.plateau[side], gentle * reach);
        from[side] = distances(shape, film.triangles, top.neighbours, contact.sides[side], most);
        for (const auto& [i, d] : from[side]) result.vertices.push_back(i);
    }
    std::sort(result.vertices.begin(), result.vertices.end()); // the maps' order is nobody's promise
    result.vertices.erase(std::unique(result.vertices.begin(), result.vertices.end()), result.vertices.end());
    for (const int i : result.vertices)
        for (int side = 0; side < 2; ++side) {
            const auto it = from[side].find(i);
            result.distance[side].push_back(it == from[side].end() ? std::numeric_limits<double>::infinity()
                                                                   : it->second);
        }
    for (const int i : result.vertices)
        for (const int t : top.vertex_triangles[i]) result.triangles.push_back(t);
    std::sort(result.triangles.begin(), result.triangles.end());
    result.triangles.erase(std::unique(result.triangles.begin(), result.triangles.end()), result.triangles.end());
    return result;
}

// How far each vertex goes along the direction where sides are moved by `size` apart, half of it each: n(vertices).
std::vector<double> field(const Movable& part, double size) {
    const auto fades = [&](int side, double distance) {
        const double width = std::max(part.plateau[side], gentle * size / 2);
        const double t = std::clamp(1 - (distance - part.plateau[side]) / width, 0.0, 1.0);
        return t * t * (3 - 2 * t);
    };
    std::vector<double> way;
    for (std::size_t k = 0; k < part.vertices.size(); ++k)
        way.push_back(size / 2 * (fades(0, part.distance[0][k]) - fades(1, part.distance[1][k])));
    return way;
}

// A displacement of some vertices at the bump's peak.
struct Bend {
    std::vector<double> way;  // a vertex of the movable part
    Point direction{0, 0, 0}; // in the first shape's frame
    Bump bump;
};

// The part of a frame that a contact can reach, as a mesh of its own: what is moved, and what might be touched by it.
struct Neighbourhood {
    std::vector<int> triangle; // its triangles' numbers in the whole mesh
    std::vector<char> movable; // a flag a triangle
    Points positions;
    Triangles triangles;
    std::vector<int> moved; // the movable part's vertices here
};

Neighbourhood neighbourhood(const Film& film, const Points& shape, const Movable& part, double reach) {
    Eigen::AlignedBox3d box;
    for (const int i : part.vertices) box.extend(shape.row(i).transpose());
    box.min().array() -= reach;
    box.max().array() += reach;
    Neighbourhood near;
    std::unordered_map<int, int> local;
    std::vector<int> corners, vertices;
    for (Eigen::Index t = 0; t < film.triangles.rows(); ++t) {
        const bool own = std::binary_search(part.triangles.begin(), part.triangles.end(), static_cast<int>(t));
        Eigen::AlignedBox3d around;
        for (int k = 0; k < 3; ++k) around.extend(shape.row(film.triangles(t, k)).transpose());
        if (!own && !box.intersects(around)) continue;
        near.triangle.push_back(static_cast<int>(t));
        near.movable.push_back(own);
        for (int k = 0; k < 3; ++k) {
            const auto [it, fresh] = local.emplace(film.triangles(t, k), static_cast<int>(vertices.size()));
            if (fresh) vertices.push_back(it->first);
            corners.push_back(it->second);
        }
    }
    near.triangles = Eigen::Map<const Triangles>(corners.data(), std::ssize(near.triangle), 3);
    near.positions.resize(std::ssize(vertices), 3);
    for (std::size_t v = 0; v < vertices.size(); ++v)
        near.positions.row(static_cast<Eigen::Index>(v)) = shape.row(vertices[v]);
    for (const int i : part.vertices) near.moved.push_back(local.at(i));
    return near;
}

// A contact's neighbourhoods in all frames.
struct Place {
    const Film& film;
    const Movable& part;
    std::vector<Neighbourhood> frames;
    int trials = 0;

    Place(const Film& of, const Movable& movable_part, double reach) : film(of), part(movable_part) {
        for (const Points& shape : film.shapes) frames.push_back(neighbourhood(film, shape, part, reach));
    }

    // How many pairs, other than the ends', have a movable triangle in a frame.
    std::size_t cuts(std::size_t frame, const Bend& bend) {
        ++trials;
        const Neighbourhood& near = frames[frame];
        Points positions = near.positions;
        const Point way = bend.bump(film.times[frame]) * bend.direction * film.turns[frame].transpose();
        for (std::size_t k = 0; k < near.moved.size(); ++k) positions.row(near.moved[k]) += bend.way[k] * way;
        std::size_t count = 0;
        for (const auto& [a, b] : self_intersections(positions, near.triangles)) {
            const auto ia = static_cast<std::size_t>(a), ib = static_cast<std::size_t>(b);
            const std::array<int, 2> pair{near.triangle[ia], near.triangle[ib]};
            count +=
                (near.movable[ia] || near.movable[ib]) && !std::binary_search(film.ends.begin(), film.ends.end(), pair);
        }
        return count;
    }

    std::size_t cuts_in_all(const Bend& bend) {
        std::size_t sum = 0;
        for (std::size_t f = 0; f < frames.size(); ++f) sum += cuts(f, bend);
        return sum;
    }
};

Point mean_of(const Points& shape, const Triangles& triangles, const std::vector<int>& which) {
    Point sum = Point::Zero();
    for (const int t : which)
        for (int k = 0; k < 3; ++k) sum += shape.row(triangles(t, k));
    return sum / (3.0 * static_cast<double>(std::max<std::size_t>(1, which.size())));
}

Point normal_of(const Points& shape, const Triangles& triangles, const std::vector<int>& which) {
    Point sum = Point::Zero();
    for (const int t : which) sum += double_area_normal(shape, triangles, t);
    return sum;
}

// The way out that the surfaces' own normals show, then the axes and diagonals of a frame along the relative motion.
std::vector<Point> directions(const Film& film, const Contact& contact) {
    const auto at = [&](int frame) -> const Points& { return film.shapes[static_cast<std::size_t>(frame)]; };
    const auto unturned = [&](const Point& v, int frame) -> Point {
        return v * film.turns[static_cast<std::size_t>(frame)];
    };
    const auto gap = [&](int frame) -> Point {
        return unturned(mean_of(at(frame), film.triangles, contact.sides[0]) -
                            mean_of(at(frame), film.triangles, contact.sides[1]),
                        frame);
    };
    const int last = static_cast<int>(film.shapes.size()) - 1;
    const auto unit = [](const Point& v, const Point& otherwise) -> Point {
        return v.norm() > 0 ? Point(v.normalized()) : otherwise;
    };
    const Point along =
        unit(gap(std::min(contact.last_frame + 1, last)) - gap(std::max(contact.first_frame - 1, 0)), {1, 0, 0});
    const Points& worst = at(contact.worst_frame);
    const Point out = unturned(normal_of(worst, film.triangles, contact.sides[1]) -
                                   normal_of(worst, film.triangles, contact.sides[0]),
                               contact.worst_frame);
    const Point any = std::abs(along[0]) < 0.6 ? Point(1, 0, 0) : Point(0, 1, 0);
    const Point across = unit(along.cross(unit(out, any)), unit(along.cross(any), {0, 1, 0}));
    const Point third = along.cross(across);
    std::vector<Point> all;
    if (out.norm() > 0) all.push_back(out.normalized());
    for (const int c : {0, 1, -1}) // those without a part along the motion come first
        for (const int a : {0, 1, -1})
            for (const int b : {0, 1, -1})
                if (a != 0 || b != 0 || c != 0) all.push_back(Point(a * across + b * third + c * along).normalized());
    return all;
}

struct Found {
    Bend bend;
    double size = 0;
    std::size_t cuts = 0; // in all frames
};

// Halves the size while that leaves no more cuts.
void shrink(Found& found, Place& place) {
    double low = found.size / 8;
    for (int step = 0; step < 3; ++step) {
        Bend bend = found.bend;
        const double size = (low + found.size) / 2;
        bend.way = field(place.part, size);
        if (place.cuts_in_all(bend) <= found.cuts)
            found.bend = std::move(bend), found.size = size;
        else
            low = size;
    }
}

// A small bend that leaves fewest cuts: all directions in the worst frame, the best of them in all frames.
Found search(Place& place, const Contact& contact, double reach, int most) {
    const Film& film = place.film;
    const double step = 1.0 / static_cast<double>(film.times.size() + 1);
    const auto time = [&](int frame) { return film.times[static_cast<std::size_t>(frame)]; };
    Found best;
    best.bend = {field(place.part, 0),
                 {1, 0, 0},
                 bump_over(time(contact.first_frame) - step / 2, time(contact.last_frame) + step / 2)};
    best.cuts = place.cuts_in_all(best.bend);
    const std::vector<Point> ways = directions(film, contact);
    const std::size_t before = best.cuts, enough = before / 10, bearable = before / 2;
    for (const double share : {1.0 / 16, 0.125, 0.25, 0.5, 1.0}) { // a small one that mends nearly all is the best
        const double size = 2 * reach * share;
        Bend bend{field(place.part, size), {}, best.bend.bump};
        std::vector<std::pair<std::size_t, std::size_t>> order; // cuts in the worst frame, direction
        for (std::size_t w = 0; w < ways.size() && place.trials < most; ++w) {
            bend.direction = ways[w];
            order.emplace_back(place.cuts(static_cast<std::size_t>(contact.worst_frame), bend), w);
        }
        std::sort(order.begin(), order.end());
        for (std::size_t k = 0; k < std::min<std::size_t>(3, order.size()) && place.trials < most; ++k) {
            if (order[k].first >= best.cuts) break;
            bend.direction = ways[order[k].second];
            if (const std::size_t cuts = place.cuts_in_all(bend); cuts < best.cuts) best = {bend, size, cuts};
        }
        if (best.cuts <= enough || place.trials >= most) break;
    }
    if (best.cuts > bearable) best.size = 0; // it would cost more than it mends
    if (best.size > 0 && place.trials < most) shrink(best, place);
    return best;
}

Interpolant bent(const Film& film, const Interpolant& path, const Movable& part, const Bend& bend) {
    Interpolant result = resampled(path, bend.bump.degree() + 1);
    for (std::size_t k = 1; k + 1 < result.nodes.size(); ++k) {
        const Point way =
            bend.bump(result.parameters[k]) * bend.direction * turn_of(film, path, result.nodes[k]).transpose();
        for (std::size_t i = 0; i < part.vertices.size(); ++i)
            result.nodes[k].row(part.vertices[i]) += bend.way[i] * way;
    }
    return result;
}

double largest_move(const Interpolant& a, const Interpolant& b) {
    double most = 0;
    for (std::size_t k = 0; k < a.nodes.size(); ++k)
        most = std::max(most, (a.nodes[k] - b.at(a.parameters[k])).rowwise().norm().maxCoeff());
    return most;
}

// Bends every contact once, the deepest first.
void bend_contacts(Repaired& result, Film& film, const Interpolant& original, const Patches& cells, const Topology& top,
                   const RepairOptions& options, double reach) {
    std::vector<Contact> found = contacts(film.cuts, film.ends, cells);
    const auto deepest = [](const Contact& c) { return c.cuts[static_cast<std::size_t>(c.worst_frame)]; };
    std::stable_sort(found.begin(), found.end(),
                     [&](const Contact& a, const Contact& b) { return deepest(a) > deepest(b); });
    int in_vain = 0; // in a row
    for (const Contact& contact : found) {
        const int left = options.trials - result.report.trials;
        if (in_vain == patience || left <= 0) break;
        if (contact.at_an_end || contact.fold) continue;
        ++in_vain;
        const Movable part = movable(film, contact, top, reach);
        Place place(film, part, reach);
        const Found best = search(place, contact, reach, left);
        result.report.trials += place.trials;
        if (best.size <= 0) continue;
        Interpolant better = bent(film, result.path, part, best.bend);
        const double moved = largest_move(better, original);
        if (moved > reach) continue; // together with what was bent before
        result.path = std::move(better);
        result.report.moved = std::max(result.report.moved, moved);
        for (std::size_t f = 0; f < film.times.size(); ++f) film.shapes[f] = result.path.at(film.times[f]);
        ++result.report.contacts;
        in_vain = 0;
    }
}

} // namespace

Repaired repaired(const Interpolant& path, const Triangles& triangles, const RepairOptions& options,
                  const Progress& progress) {
    if (options.frames < 1 || options.rounds < 0 || !(options.reach > 0))
        throw Error(ErrorKind::argument, "a repair needs at least one frame, a reach above 0 and no negative rounds");
    Repaired result{path, {}, false};
    Film film{triangles, {}, {}, {}, {}, {}};
    for (int f = 1; f <= options.frames; ++f) film.times.push_back(static_cast<double>(f) / (options.frames + 1));
    film.shapes.resize(film.times.size());
    film.turns.resize(film.times.size());
    film.cuts.resize(film.times.size());
    for (const Points* end : {&path.nodes.front(), &path.nodes.back()}) {
        const CutPairs own = self_intersections(*end, triangles);
        film.ends.insert(film.ends.end(), own.begin(), own.end());
    }
    std::sort(film.ends.begin(), film.ends.end());
    const auto stopped = [&] {
        result.cancelled = true;
        return result;
    };
    if (!look(film, path, part_of(progress, 0, 0.4))) return stopped();
    result.report.cuts_before = result.report.cuts_after = total(film.cuts);
    if (result.report.cuts_before == 0) return result;
    const Topology top = topology(path.nodes.front().rows(), triangles);
    const int cell_count = static_cast<int>(std::clamp<Eigen::Index>(triangles.rows() / 8, 1, 2000));
    const Patches cells =
        patches(face_field(path.nodes.front(), path.nodes.back(), triangles), triangles, top, cell_count);
    const double size = path.diagonal;
    for (int round = 0; round < options.rounds && result.report.cuts_after > 0; ++round) {
        const int bent = result.report.contacts;
        bend_contacts(result, film, path, cells, top, options, options.reach * size);
        if (result.report.contacts == bent) break;
        if (!look(film, result.path, part_of(progress, 0.4 + 0.6 * round / options.rounds, 1))) return stopped();
        result.report.cuts_after = total(film.cuts);
    }
    result.report.left = static_cast<int>(contacts(film.cuts, film.ends, cells).size());
    if (size > 0) result.report.moved /= size;
    return result;
}

} // namespace meshtween
