// A surface is brought over its own mirror image by closest points, from the best of many planes through its centre;
// far points count little, so that a raised leg does not tilt the plane.
//
// Chen, Medioni: Object modelling by registration of multiple range images. IVC 1992 (distance to the tangent plane).
// Mitra, Guibas, Pauly: Partial and approximate symmetry detection for 3D geometry. SIGGRAPH 2006 (a symmetry refined
// by registration of the shape with its image).
#include "meshtween/fit/symmetry.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace meshtween {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double reach = 0.1;         // diagonals: an image further off has no counterpart
constexpr double least_cosine = 0.5;  // between the normals of an image and of the surface there
constexpr double alike = 0.01;        // diagonals: symmetric to the eye
constexpr double first_scale = 0.03;  // diagonals: misfits well above count little; it falls to `alike`
constexpr double least_share = 0.6;   // of a surface that is symmetric
constexpr double least_apart = 0.9;   // cosine: planes nearer than this to one that was tried end there
constexpr double worth_trying = 0.7;  // of the best plane's fitness
constexpr double least_hold = 0.0025; // squared: turned by an angle, images move by a twentieth of it times the size

std::size_t idx(std::ptrdiff_t i) {
    return static_cast<std::size_t>(i);
}

struct Samples {
    Points places, normals;
    Point centre{0, 0, 0};
    double size = 0;                      // root of the mean squared distance from the centre
    Matrix3d axes = Matrix3d::Identity(); // principal, as columns
};

// The k-th lies where the k-th part of the area ends, inside its triangle by a sequence that fills it evenly (Roberts
// 2018).
Samples even_samples(const Points& positions, const Triangles& triangles, const Points& normals, Index count) {
    Samples s{Points(count, 3), Points(count, 3)};
    const double area = surface_area(positions, triangles);
    double passed = 0;
    Index k = 0;
    for (Index t = 0; t < triangles.rows(); ++t) {
        passed += triangle_area(positions, triangles, t);
        for (; k < count && (static_cast<double>(k) + 0.5) * area < passed * static_cast<double>(count); ++k) {
            double u = std::fmod(0.7548776662466927 * static_cast<double>(k), 1.0);
            double v = std::fmod(0.5698402909980532 * static_cast<double>(k), 1.0);
            if (u + v > 1) u = 1 - u, v = 1 - v;
            s.places.row(k) = position(positions, triangles, {static_cast<int>(t), {1 - u - v, u, v}});
            s.normals.row(k) = normals.row(t);
        }
    }
    s.places.conservativeResize(k, 3), s.normals.conservativeResize(k, 3);
    s.centre = s.places.colwise().mean();
    const Points around = s.places.rowwise() - s.centre;
    const Matrix3d spread = around.transpose() * around / static_cast<double>(std::max<Index>(1, k));
    s.size = std::sqrt(spread.trace());
    s.axes = Eigen::SelfAdjointEigenSolver<Matrix3d>(spread).eigenvectors();
    return s;
}

// Every `step`-th sample's image on the surface.
struct Images {
    Index step = 1;
    std::vector<ClosestPoint> found;

    void find(const Samples& samples, const MirrorPlane& plane, const ClosestPointIndex& index) {
        found.resize(idx((samples.places.rows() + step - 1) / step));
        parallel_for(
            std::ssize(found),
            [&](std::ptrdiff_t k) {
                const Point place = samples.places.row(k * step), normal = samples.normals.row(k * step);
                const Compatible like{plane.image_of_direction(normal), least_cosine};
                ClosestPoint& c = found[idx(k)];
                c = index.closest(plane.image(place), c.where.triangle);
                // The closest of all mostly serves; to look for others is slow where there is none.
                if (index.normals().row(c.where.triangle).dot(like.normal) < least_cosine)
                    c = index.closest(plane.image(place), like, first_scale, c.where.triangle);
                else if (c.squared_distance > reach * reach)
                    c = {};
            },
            32);
    }
};

// 1 for none, falling to 0 (Geman and McClure 1987).
double trust(double squared_misfit, double scale) {
    const double d = 1 + squared_misfit / (scale * scale);
    return 1 / (d * d);
}

double fitness(const Images& images, double scale) {
    double sum = 0;
    for (const ClosestPoint& c : images.found)
        if (c.found()) sum += trust(c.squared_distance, scale);
    return sum / static_cast<double>(std::max<std::size_t>(1, images.found.size()));
}

// One Gauss-Newton step on the distances of images from the tangent planes of what they lie on. The unknowns: turns
// about two axes through the centre, and the height. Returns how firmly the surface holds the plane against the turn
// that it resists least: mean square of the images' way along the normals, an angle of one, in squared sizes.
double improve(MirrorPlane& plane, const Samples& samples, const Images& images, const ClosestPointIndex& index,
               double scale) {
    const Point n = plane.normal, a = Vector3d(n.transpose()).unitOrthogonal().transpose(), b = n.cross(a);
    Matrix3d h = Matrix3d::Zero();
    Vector3d g = Vector3d::Zero();
    double sum = 0;
    for (std::size_t k = 0; k < images.found.size(); ++k) {
        const ClosestPoint& image = images.found[k];
        if (!image.found()) continue;
        const Point x = samples.places.row(static_cast<Index>(k) * images.step), from = x - samples.centre;
        const Point normal = index.normals().row(image.where.triangle);
        const double w = trust(image.squared_distance, scale), height = plane.height(x), across = normal.dot(n);
        const Vector3d j(-2 * (from.dot(a) * across + height * normal.dot(a)),
                         -2 * (from.dot(b) * across + height * normal.dot(b)), 2 * across * samples.size);
        h += w * j * j.transpose();
        g += w * normal.dot(plane.image(x) - image.position) * j;
        sum += w;
    }
    if (!(sum > 0)) return 0;
    h /= sum * samples.size * samples.size, g /= sum * samples.size * samples.size;
    const Vector3d by = -(h + 1e-9 * Matrix3d::Identity()).ldlt().solve(g);
    const double level = plane.height(samples.centre);
    plane.normal = (n + by[0] * a + by[1] * b).normalized();
    plane.offset = plane.normal.dot(samples.centre) - level + by[2] * samples.size;
    const Eigen::Matrix2d turns =
        h.topLeftCorner<2, 2>() - h.topRightCorner<2, 1>() * h.bottomLeftCorner<1, 2>() / std::max(h(2, 2), 1e-12);
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(turns, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

struct Start {
    double fitness = 0;
    MirrorPlane plane;
};

// Planes through the centre, across the principal axes and evenly over all directions (a Fibonacci lattice on half a
// sphere), the best first.
std::vector<Start> starts(const Samples& samples, const ClosestPointIndex& index) {
    constexpr int directions = 60;
    std::vector<Start> result;
    const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
    for (int k = -3; k < directions; ++k) {
        const double z = (k + 0.5) / directions, r = std::sqrt(1 - z * z);
        const Vector3d d =
            k < 0 ? Vector3d::Unit(k + 3) : Vector3d(r * std::cos(golden * k), r * std::sin(golden * k), z);
        const Point normal = (samples.axes * d).transpose();
        const MirrorPlane plane{normal, normal.dot(samples.centre)};
        Images images{15, {}};
        images.find(samples, plane, index);
        result.push_back({fitness(images, first_scale), plane});
    }
    std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.fitness > b.fitness; });
    return result;
}

// The plane from where it is to where the surface fits its image best, and the misfits there. Returns how firmly it is
// held (improve).
double refine(Symmetry& symmetry, const Samples& samples, const ClosestPointIndex& index) {
    Images few{5, {}}, all;
    double scale = first_scale, hold = 0;
    for (int round = 0; round < 8; ++round, scale = std::max(alike, 0.8 * scale)) {
        few.find(samples, symmetry.plane, index);
        improve(symmetry.plane, samples, few, index, scale);
    }
    for (int round = 0; round < 2; ++round) {
        all.find(samples, symmetry.plane, index);
        hold = improve(symmetry.plane, samples, all, index, alike);
    }
    all.find(samples, symmetry.plane, index);
    for (const ClosestPoint& image : all.found) {
        symmetry.misfits.push_back(image.found() ? std::sqrt(image.squared_distance) : reach);
        if (symmetry.misfits.back() < alike) symmetry.share += 1 / static_cast<double>(all.found.size());
    }
    return hold;
}

} // namespace

std::vector<Symmetry> symmetries(const Points& positions, const Triangles& triangles, const ClosestPointIndex& index) {
    constexpr Index sample_count = 1000;
    constexpr std::size_t tries = 3;
    const Samples samples = even_samples(positions, triangles, index.normals(), sample_count);
    const std::vector<Start> from = starts(samples, index);
    std::vector<Symmetry> result;
    std::vector<MirrorPlane> tried;
    const double worst = worth_trying * from.front().fitness;
    for (std::size_t s = 0; s < from.size() && tried.size() < tries && from[s].fitness > worst; ++s) {
        const Point& normal = from[s].plane.normal;
        if (std::any_of(tried.begin(), tried.end(),
                        [&](const MirrorPlane& p) { return std::abs(p.normal.dot(normal)) > least_apart; }))
            continue;
        Symmetry symmetry{from[s].plane, samples.places, {}, 0};
        const double hold = refine(symmetry, samples, index);
        tried.push_back(symmetry.plane);
        if (hold >= least_hold && symmetry.share >= least_share) result.push_back(std::move(symmetry));
    }
    std::stable_sort(result.begin(), result.end(), [](const auto& a, const auto& b) { return a.share > b.share; });
    return result;
}

double asymmetry(const Symmetry& symmetry, const Point& place) {
    constexpr double around = 0.03;
    double squares = 0, count = 0, least = std::numeric_limits<double>::infinity(), nearest = 0;
    for (Index k = 0; k < symmetry.places.rows(); ++k) {
        const double d = (symmetry.places.row(k) - place).squaredNorm(), misfit = symmetry.misfits[idx(k)];
        if (d < around * around) squares += misfit * misfit, ++count;
        if (d < least) least = d, nearest = misfit;
    }
    return count > 0 ? std::sqrt(squares / count) : nearest;
}

} // namespace meshtween
