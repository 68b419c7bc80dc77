#include "meshtween/fit/ground.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/geometry/sound_faces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

namespace meshtween {
namespace {

constexpr double alike = 0.94;        // cosine of normals of one plane, 20 degrees: scans are rough
constexpr double thickness = 0.01;    // of the plane, parts of the diagonal
constexpr double least_area = 0.05;   // of the whole
constexpr double most_below = 0.02;   // of the rest's area: what lies beyond the plane
constexpr double least_outside = 0.3; // of the plane's area, beside what stands on it
constexpr double wider = 0.1;         // of the footprint, on each side: what stands on the plane may spread at its foot
constexpr int tries = 4;              // directions in which most area looks

std::size_t idx(auto i) {
    return static_cast<std::size_t>(i);
}

struct Faces {
    Points centres, normals;
    Eigen::VectorXd area;
};

Faces faces_of(const Points& positions, const Triangles& triangles) {
    Faces faces{Points(triangles.rows(), 3), triangle_normals(positions, triangles), Eigen::VectorXd(triangles.rows())};
    for (Eigen::Index t = 0; t < triangles.rows(); ++t) {
        faces.centres.row(t) =
            (positions.row(triangles(t, 0)) + positions.row(triangles(t, 1)) + positions.row(triangles(t, 2))) / 3;
        faces.area[t] = triangle_area(positions, triangles, t);
    }
    return faces;
}

// Where most of the area looks, the most first: directions of a fine ball, then the mean of what looks alike.
std::vector<Point> main_directions(const Faces& faces) {
    const Points looks = sphere(2).positions.rowwise().normalized();
    std::vector<double> area(idx(looks.rows()), 0.0);
    for (Eigen::Index t = 0; t < faces.area.size(); ++t) {
        Eigen::Index nearest = 0;
        (looks * faces.normals.row(t).transpose()).maxCoeff(&nearest);
        area[idx(nearest)] += faces.area[t];
    }
    std::vector<std::size_t> order(area.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return area[i]; });
    std::vector<Point> result;
    for (std::size_t k = 0; k < std::min<std::size_t>(tries, order.size()); ++k) {
        Point mean(0, 0, 0);
        for (Eigen::Index t = 0; t < faces.area.size(); ++t)
            if (faces.normals.row(t).dot(looks.row(static_cast<Eigen::Index>(order[k]))) > alike)
                mean += faces.area[t] * faces.normals.row(t);
        if (mean.norm() > 0) result.push_back(mean.normalized());
    }
    return result;
}

// The height of the slab in which most of the area that looks upwards lies.
double main_height(const Faces& faces, const Eigen::VectorXd& heights, const Point& up, double slab) {
    std::vector<std::pair<double, double>> parts; // height, area
    for (Eigen::Index t = 0; t < heights.size(); ++t)
        if (faces.normals.row(t).dot(up) > alike) parts.emplace_back(heights[t], faces.area[t]);
    std::sort(parts.begin(), parts.end());
    double best = 0, inside = 0, most = -1;
    for (std::size_t low = 0, high = 0; high < parts.size(); ++high) {
        inside += parts[high].second;
        while (parts[high].first - parts[low].first > slab) inside -= parts[low++].second;
        if (inside > most) most = inside, best = (parts[low].first + parts[high].first) / 2;
    }
    return best;
}

// The box around what stands on the plane, seen from above.
struct Footprint {
    Point u, v;
    Eigen::AlignedBox2d box;
    Eigen::Vector2d seen(const Point& p) const { return {p.dot(u), p.dot(v)}; }
};

// Between which values nearly all of the area lies: bits in the air take no part.
std::array<double, 2> range(std::vector<std::pair<double, double>> places) { // value, area
    constexpr double nearly = 0.005;                                         // of the area, on each side
    std::sort(places.begin(), places.end());
    double whole = 0, below = 0;
    for (const auto& [value, area] : places) whole += area;
    std::array<double, 2> ends{places.front().first, places.back().first};
    for (const auto& [value, area] : places) {
        if (below <= nearly * whole) ends[0] = value;
        below += area;
        if (below >= (1 - nearly) * whole) {
            ends[1] = value;
            break;
        }
    }
    return ends;
}

Footprint footprint(const Faces& faces, const std::vector<char>& near, const Point& up) {
    const Point u = up.unitOrthogonal();
    Footprint result{u, up.cross(u), {}};
    std::vector<std::pair<double, double>> along, across;
    for (Eigen::Index t = 0; t < faces.area.size(); ++t) {
        if (near[idx(t)] != 0) continue;
        const Eigen::Vector2d at = result.seen(faces.centres.row(t));
        along.emplace_back(at[0], faces.area[t]), across.emplace_back(at[1], faces.area[t]);
    }
    const auto [left, right] = range(std::move(along));
    const auto [front, back] = range(std::move(across));
    const Eigen::Vector2d low(left, front), high(right, back), margin = wider * (high - low);
    result.box = {low - margin, high + margin};
    return result;
}

// Only connected pieces of which something lies outside: the flat bottom of a bust on a table is the bust's.
void keep_reaching(const Points& positions, const Triangles& triangles, const std::vector<char>& out,
                   std::vector<char>& flags) {
    std::vector<int> all;
    for (std::size_t t = 0; t < flags.size(); ++t)
        if (flags[t] != 0) all.push_back(static_cast<int>(t));
    const std::vector<int> piece = parts_of(positions.rows(), triangles, all);
    std::set<int> reaching;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (out[idx(all[i])] != 0) reaching.insert(piece[i]);
    for (std::size_t i = 0; i < all.size(); ++i)
        if (!reaching.contains(piece[i])) flags[idx(all[i])] = 0;
}

} // namespace

std::vector<char> ground_faces(const Points& positions, const Triangles& triangles) {
    const Faces faces = faces_of(positions, triangles);
    const double whole = faces.area.sum(), slab = thickness * diagonal(positions, triangles);
    std::vector<char> flags(idx(triangles.rows()), 0), near = flags;
    for (const Point& up : main_directions(faces)) {
        const Eigen::VectorXd heights = faces.centres * up.transpose();
        const double height = main_height(faces, heights, up, slab);
        double rest = 0, below = 0;
        for (Eigen::Index t = 0; t < heights.size(); ++t) {
            near[idx(t)] = std::abs(heights[t] - height) <= slab ? 1 : 0;
            rest += near[idx(t)] == 0 ? faces.area[t] : 0;
            below += heights[t] < height - slab ? faces.area[t] : 0;
        }
        if (rest == 0 || whole - rest < least_area * whole || below > most_below * rest) continue;
        const Footprint under = footprint(faces, near, up);
        std::vector<char> out(flags.size(), 0);
        for (Eigen::Index t = 0; t < heights.size(); ++t) {
            out[idx(t)] = under.box.contains(under.seen(faces.centres.row(t))) ? 0 : 1;
            const bool flat = std::abs(faces.normals.row(t).dot(up)) > alike;
            flags[idx(t)] = near[idx(t)] != 0 && (out[idx(t)] != 0 || flat) ? 1 : 0;
        }
        keep_reaching(positions, triangles, out, flags);
        double plane = 0, outside = 0;
        for (Eigen::Index t = 0; t < heights.size(); ++t) {
            plane += flags[idx(t)] != 0 ? faces.area[t] : 0;
            outside += flags[idx(t)] != 0 && out[idx(t)] != 0 ? faces.area[t] : 0;
        }
        if (outside > least_outside * plane) return flags;
    }
    std::fill(flags.begin(), flags.end(), 0);
    return flags;
}

} // namespace meshtween
