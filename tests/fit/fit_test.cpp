#include "meshtween/fit/fit.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/search/closest_point.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>

namespace meshtween {
namespace {

const Point radii(1.5, 1, 0.7);

Mesh ellipsoid(int subdivisions) { // its vertices turned, so that they are not the sphere's scaled
    Mesh mesh = sphere(subdivisions);
    mesh.positions = turn(mesh.positions, {1, 2, 3}, 0.4) * radii.asDiagonal();
    return mesh;
}

// Markers at every 16th vertex of the source, where `map` takes them.
std::vector<Marker> markers_at(const Mesh& source, const std::function<Point(const Point&)>& map, int every = 16) {
    const ClosestPointIndex index(source);
    std::vector<Marker> markers;
    for (Eigen::Index i = 0; i < source.positions.rows(); i += every) {
        const Point p = source.positions.row(i);
        markers.push_back({"m" + std::to_string(i), index.closest(p).where, map(p)});
    }
    return markers;
}

struct Pair { // the markers lie on the target's triangles, not on the ellipsoid that these cut short
    Mesh source = sphere(3), target = ellipsoid(4);
    std::vector<Marker> markers =
        markers_at(source, [index = std::make_shared<ClosestPointIndex>(target)](const Point& p) {
            return index->closest(Point(p.cwiseProduct(radii))).position;
        });
};

FitOptions paper() {
    FitOptions options;
    options.method = FitMethod::paper;
    return options;
}

double largest_distance(const Points& points, const Mesh& surface) {
    double largest = 0;
    for (const ClosestPoint& hit : ClosestPointIndex(surface).closest(points))
        largest = std::max(largest, std::sqrt(hit.squared_distance));
    return largest;
}

std::string message_of(const Mesh& source, const Mesh& target, const std::vector<Marker>& markers,
                       const FitOptions& options = paper()) {
    try {
        fit(source, target, markers, options);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(PaperFit, SphereToEllipsoid) {
    const Pair pair;
    FitOptions options = paper();
    options.threshold = 5e-5;
    const FitResult result = fit(pair.source, pair.target, pair.markers, options);
    EXPECT_EQ(result.end, FitEnd::converged);
    EXPECT_LT(result.history.back(), options.threshold);
    EXPECT_GT(result.history.front(), 2 * options.threshold);
    EXPECT_EQ(static_cast<int>(result.history.size()), result.rounds);
    EXPECT_LT(largest_distance(result.positions, pair.target), 1e-9);
    EXPECT_LT(result.error, 1e-18);
    for (Eigen::Index t = 0; t < pair.source.triangles.rows(); ++t) {
        const Point centre =
            (result.positions(pair.source.triangles.row(t), Eigen::all)).colwise().mean().cwiseQuotient(radii);
        EXPECT_GT(double_area_normal(result.positions, pair.source.triangles, t).dot(centre.cwiseQuotient(radii)), 0);
    }
    EXPECT_NEAR(volume(result.positions, pair.source.triangles), volume(pair.target.positions, pair.target.triangles),
                0.02 * volume(pair.target.positions, pair.target.triangles));
    for (const Marker& marker : pair.markers)
        EXPECT_LT((position(result.positions, pair.source.triangles, marker.source) - marker.target).norm(), 0.02);
    EXPECT_TRUE(result.notes.empty());
}

TEST(PaperFit, TurnsAndScalesWithItsInput) {
    const Pair pair;
    const auto moved = [](const Points& p) {
        return Points((1000 * turn(p, {1, -2, 0.5}, 2)).rowwise() + Point(4000, -7000, 100));
    };
    Mesh source = pair.source, target = pair.target;
    source.positions = moved(source.positions);
    target.positions = moved(target.positions);
    std::vector<Marker> markers = pair.markers;
    for (Marker& marker : markers) marker.target = moved(marker.target);
    const Points before = fit(pair.source, pair.target, pair.markers, paper()).positions;
    const Points after = fit(source, target, markers, paper()).positions;
    EXPECT_LT((after - moved(before)).rowwise().norm().maxCoeff(), 1e-6 * diagonal(target));
}

TEST(PaperFit, SameBitsForAnyThreads) {
    const Pair pair;
    set_threads(1);
    const Points one = fit(pair.source, pair.target, pair.markers, paper()).positions;
    set_threads(2);
    EXPECT_EQ(fit(pair.source, pair.target, pair.markers, paper()).positions, one);
    set_threads(0);
}

TEST(PaperFit, CancelledIsTheBestSoFar) {
    const Pair pair;
    double last = 0;
    FitOptions options = paper();
    options.threshold = 0;
    const FitResult result =
        fit(pair.source, pair.target, pair.markers, options, [&](double fraction, std::string_view) {
            EXPECT_GE(fraction, last);
            last = fraction;
            return fraction < 0.06;
        });
    EXPECT_EQ(result.end, FitEnd::cancelled);
    EXPECT_GT(result.rounds, 0);
    EXPECT_LT(result.rounds, 5);
    EXPECT_LT(largest_distance(result.positions, pair.target), 0.01);
    const FitResult at_once =
        fit(pair.source, pair.target, pair.markers, paper(), [](double, std::string_view) { return false; });
    EXPECT_EQ(at_once.end, FitEnd::cancelled);
    EXPECT_EQ(at_once.rounds, 0);
    EXPECT_TRUE(at_once.positions.allFinite());
}

TEST(PaperFit, ATargetInsideOutIsNoted) {
    Pair pair;
    const Points straight = fit(pair.source, pair.target, pair.markers, paper()).positions;
    pair.target.triangles.col(0).swap(pair.target.triangles.col(1));
    const FitResult result = fit(pair.source, pair.target, pair.markers, paper());
    ASSERT_EQ(result.notes.size(), 1u);
    EXPECT_NE(result.notes[0].find("inside out"), std::string::npos);
    EXPECT_LT((result.positions - straight).rowwise().norm().maxCoeff(), 1e-6);
}

TEST(PaperFit, RoundsAndThresholdAreOptions) {
    const Pair pair;
    FitOptions options = paper();
    options.max_rounds = 3;
    options.threshold = 0;
    EXPECT_EQ(fit(pair.source, pair.target, pair.markers, options).rounds, 3);
    options.threshold = 1;
    EXPECT_EQ(fit(pair.source, pair.target, pair.markers, options).rounds, 1);
    options.max_rounds = 0;
    EXPECT_EQ(fit(pair.source, pair.target, pair.markers, options).rounds, 0);
}

// Each spoils one of the two meshes; the fit must still give coordinates, and be on the surface where it was sound.
using Spoil = void (*)(Mesh&);
void add_unused(Mesh& mesh) {
    mesh.positions.conservativeResize(mesh.positions.rows() + 2, 3);
    mesh.positions.bottomRows<2>() << 0, 0, 0, 9, 9, 9;
}
void add_slivers(Mesh& mesh) { // faces without area: a vertex twice, and a vertex in the middle of an edge
    mesh.positions.conservativeResize(mesh.positions.rows() + 1, 3);
    const int last = static_cast<int>(mesh.positions.rows()) - 1, a = mesh.triangles(0, 0), b = mesh.triangles(0, 1);
    mesh.positions.row(last) = (mesh.positions.row(a) + mesh.positions.row(b)) / 2;
    mesh.triangles.conservativeResize(mesh.triangles.rows() + 2, 3);
    mesh.triangles.bottomRows<2>() << a, a, b, a, last, b;
}
void add_component(Mesh& mesh) {
    Mesh other = sphere(1);
    other.positions = (0.05 * other.positions).rowwise() + Point(0.3, 0.2, 0.1);
    const int first = static_cast<int>(mesh.positions.rows());
    mesh.positions.conservativeResize(first + other.positions.rows(), 3);
    mesh.positions.bottomRows(other.positions.rows()) = other.positions;
    mesh.triangles.conservativeResize(mesh.triangles.rows() + other.triangles.rows(), 3);
    mesh.triangles.bottomRows(other.triangles.rows()) = other.triangles.array() + first;
}
void add_fin(Mesh& mesh) { // a third face on an edge
    mesh.positions.conservativeResize(mesh.positions.rows() + 1, 3);
    const int last = static_cast<int>(mesh.positions.rows()) - 1;
    mesh.positions.row(last) = 1.5 * mesh.positions.row(mesh.triangles(0, 0));
    mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, 3);
    mesh.triangles.bottomRows<1>() << mesh.triangles(0, 0), mesh.triangles(0, 1), last;
}
void cut_open(Mesh& mesh) {
    mesh.triangles = Triangles(mesh.triangles.bottomRows(mesh.triangles.rows() * 3 / 4));
}
void turn_some_over(Mesh& mesh) {
    mesh.triangles.topRows(mesh.triangles.rows() / 8)
        .col(0)
        .swap(mesh.triangles.topRows(mesh.triangles.rows() / 8).col(1));
}
void double_faces(Mesh& mesh) {
    mesh.triangles = Triangles(mesh.triangles.replicate(2, 1));
}
void flatten(Mesh& mesh) {
    mesh.positions.col(2) *= 1e-6;
}

class Spoilt : public testing::TestWithParam<Spoil> {};
INSTANTIATE_TEST_SUITE_P(Meshes, Spoilt,
                         testing::Values(add_unused, add_slivers, add_component, add_fin, cut_open, turn_some_over,
                                         double_faces, flatten));

TEST_P(Spoilt, SourceOrTargetGivesAResult) {
    for (const bool source_too : {false, true})
        for (const bool target_too : {false, true}) {
            Pair pair;
            const Points before = pair.source.positions;
            if (source_too) GetParam()(pair.source);
            if (target_too) GetParam()(pair.target);
            const ClosestPointIndex index(pair.source);
            for (Marker& marker : pair.markers) { // at the same places, now of the spoilt source
                const int vertex = std::stoi(marker.name.substr(1));
                marker.source = index.closest(Point(before.row(vertex))).where;
            }
            if (GetParam() == cut_open) // what was cut away has no markers
                std::erase_if(pair.markers, [&](const Marker& m) {
                    return (position(pair.source.positions, pair.source.triangles, m.source) -
                            before.row(std::stoi(m.name.substr(1))))
                               .norm() > 1e-9;
                });
            try {
                const FitResult result = fit(pair.source, pair.target, pair.markers, paper());
                EXPECT_EQ(result.positions.rows(), pair.source.positions.rows());
                EXPECT_TRUE(result.positions.allFinite()) << source_too << target_too;
                EXPECT_TRUE(std::isfinite(result.error));
                for (const double h : result.history) EXPECT_TRUE(std::isfinite(h));
            } catch (const Error& error) { // a flattened source's markers can meet: then they are named
                EXPECT_TRUE(source_too && GetParam() == flatten) << error.what();
                EXPECT_NE(std::string(error.what()).find("markers 'm"), std::string::npos) << error.what();
            }
        }
}

TEST(Fit, TheOrderOfMarkersChangesNothing) {
    const Mesh m = sphere(3);
    Mesh target = sphere(3);
    target.positions.col(0) *= 1.3;
    std::vector<Marker> markers;
    for (int t = 0; t < m.triangles.rows(); t += 90)
        markers.push_back({"m" + std::to_string(t), {t, {1, 0, 0}}, target.positions.row(m.triangles(t, 0))});
    const Points one = fit(m, target, markers).positions;
    std::rotate(markers.begin(), markers.begin() + 5, markers.end());
    EXPECT_EQ(one, fit(m, target, markers).positions);
}

TEST(FitErrors, NameTheElementAndTheRemedy) {
    const Pair good;
    Pair pair;
    pair.source.positions(5, 1) = std::nan("");
    EXPECT_NE(message_of(pair.source, pair.target, pair.markers).find("vertex 5 of the source"), std::string::npos);
    pair = good;
    pair.target.triangles(7, 2) = 99999;
    EXPECT_NE(message_of(pair.source, pair.target, pair.markers).find("face 7 of the target"), std::string::npos);
    pair = good;
    pair.target.triangles.resize(0, 3);
    EXPECT_NE(message_of(pair.source, pair.target, pair.markers).find("target has no faces"), std::string::npos);
    pair = good;
    pair.target.positions.setOnes();
    EXPECT_NE(message_of(pair.source, pair.target, pair.markers).find("target has no area"), std::string::npos);
    pair = good;
    pair.markers[3].source.triangle = -1;
    EXPECT_NE(message_of(pair.source, pair.target, pair.markers).find("marker 'm48'"), std::string::npos);
    pair = good;
    pair.markers.resize(2);
    EXPECT_NE(message_of(pair.source, pair.target, pair.markers).find("at least 3"), std::string::npos);
    pair = good;
    pair.markers[1].source = pair.markers[0].source;
    EXPECT_NE(message_of(pair.source, pair.target, pair.markers).find("'m0' and 'm16'"), std::string::npos);
    FitOptions options = paper();
    options.max_rounds = -1;
    EXPECT_NE(message_of(good.source, good.target, good.markers, options).find("rounds"), std::string::npos);
    options = paper();
    options.least_cosine = 2;
    EXPECT_NE(message_of(good.source, good.target, good.markers, options).find("cosine"), std::string::npos);
    options = paper();
    options.threshold = std::nan("");
    EXPECT_NE(message_of(good.source, good.target, good.markers, options).find("threshold"), std::string::npos);
}

} // namespace
} // namespace meshtween
