// What scans and production meshes have beside the subject: loose parts, clutter, layers, inner walls, faces that are
// none.
#include "meshtween/core/parallel.h"
#include "meshtween/fit/align.h"
#include "meshtween/fit/exposure.h"
#include "meshtween/fit/fit.h"
#include "meshtween/fit/ground.h"
#include "meshtween/fit/markers.h"
#include "meshtween/fit/quality.h"
#include "meshtween/fit/shell.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/portion.h"
#include "meshtween/geometry/samples.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/search/closest_point.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <numbers>

using namespace meshtween;

namespace {

Mesh joined(const Mesh& a, const Mesh& b) {
    Mesh result;
    result.positions.resize(a.positions.rows() + b.positions.rows(), 3);
    result.positions << a.positions, b.positions;
    result.triangles.resize(a.triangles.rows() + b.triangles.rows(), 3);
    result.triangles << a.triangles, (b.triangles.array() + static_cast<int>(a.positions.rows())).matrix();
    return result;
}

Mesh ball(const Point& centre, double radius, int level = 1) {
    Mesh result = sphere(level);
    result.positions = (radius * result.positions).rowwise() + centre;
    return result;
}

// An egg, and the same one wider and turned.
struct Eggs {
    Mesh source = sphere(4), target = sphere(4);
    Points truth;

    Eggs() {
        source.positions.col(1) *= 1.3;
        truth = moved(source.positions);
        target.positions.col(1) *= 1.3;
        target.positions = moved(target.positions);
    }
    static Points moved(const Points& x) {
        Points y = x;
        for (Eigen::Index i = 0; i < x.rows(); ++i) y.row(i) *= 1.2 + 0.15 * std::sin(2 * x(i, 1)) + 0.1 * x(i, 0);
        return y;
    }
    std::vector<Marker> markers() const {
        std::vector<MarkerPair> pairs;
        for (int k = 0; k < 20; ++k) {
            const int v = k * 127 % static_cast<int>(source.positions.rows());
            pairs.push_back({"m" + std::to_string(k), source.positions.row(v), truth.row(v)});
        }
        return place_markers(pairs, source);
    }
};

bool says(const FitResult& result, std::string_view words) {
    return std::ranges::any_of(result.notes,
                               [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

double largest(const Points& x) {
    return x.rowwise().norm().maxCoeff();
}

TEST(LooseParts, FollowAndLeaveTheShellAsItIs) {
    const Eggs eggs;
    const std::vector<Point> centres{{0.5, 0.4, 0}, {-0.5, 0.4, 0.1}, {0, -0.6, 0.4}, {0.1, 0.9, 0}};
    Mesh source = eggs.source;
    for (const Point& centre : centres) source = joined(source, ball(centre, 0.12));
    const FitResult alone = fit(eggs.source, eggs.target, eggs.markers());
    const FitResult both = fit(source, eggs.target, eggs.markers());
    const Eigen::Index n = eggs.source.positions.rows(), m = ball({0, 0, 0}, 1).positions.rows();
    EXPECT_EQ(both.positions.topRows(n), alone.positions); // bit for bit
    EXPECT_TRUE(says(both, "4 loose parts"));
    EXPECT_EQ(std::ssize(both.carried), 4 * m);
    for (std::size_t k = 0; k < centres.size(); ++k) {
        const Eigen::Index first = n + static_cast<Eigen::Index>(k) * m;
        const Points before = source.positions.middleRows(first, m), after = both.positions.middleRows(first, m);
        const Similarity s = align(before, after);
        EXPECT_LT(largest(s(before) - after), 1e-9); // a body keeps its shape
        EXPECT_GT(s.scale, 0.9);
        EXPECT_LT(s.scale, 1.6);
        const Point where = after.colwise().mean(), wanted = Eggs::moved(Points(centres[k])).row(0);
        EXPECT_LT((where - wanted).norm(), 0.25) << k;
    }
}

TEST(LooseParts, WithMarkersOrWhereAskedAreFitted) {
    const Eggs eggs;
    const Point centre(3, 0, 0);
    const Mesh source = joined(eggs.source, ball(centre, 0.3, 2)),
               target = joined(eggs.target, ball(centre + Point(0, 0.2, 0), 0.36, 2));
    std::vector<Marker> markers = eggs.markers();
    std::vector<MarkerPair> pairs;
    const Eigen::Index n = eggs.source.positions.rows();
    for (const int v : {0, 5, 40, 90})
        pairs.push_back({"b" + std::to_string(v), source.positions.row(n + v),
                         target.positions.row(eggs.target.positions.rows() + v)});
    const std::vector<Marker> more = place_markers(pairs, source);
    markers.insert(markers.end(), more.begin(), more.end());
    const FitResult result = fit(source, target, markers);
    EXPECT_TRUE(result.carried.empty());
    const Points off = result.positions.bottomRows(source.positions.rows() - n) -
                       target.positions.bottomRows(target.positions.rows() - eggs.target.positions.rows());
    EXPECT_LT(largest(off), 0.05);
}

TEST(Clutter, SmallPartsOfTheTargetAreLeftOut) {
    const Eggs eggs;
    Mesh target = eggs.target;
    for (const Point& place : {Point(2, 1, 0), Point(-1, 2.2, 0.3), Point(0, 0, 2.4)})
        target = joined(target, ball(place, 0.05, 0));
    const FitResult clean = fit(eggs.source, eggs.target, eggs.markers()),
                    result = fit(eggs.source, target, eggs.markers());
    EXPECT_EQ(result.positions, clean.positions);
    EXPECT_TRUE(says(result, "3 parts"));
    EXPECT_TRUE(says(result, "--keep-parts"));
    FitOptions keep;
    keep.keep_parts = true;
    EXPECT_FALSE(says(fit(eggs.source, target, eggs.markers(), keep), "--keep-parts"));
}

TEST(Clutter, AFloorThatReachesOutIsLeftOut) {
    const Eggs eggs;
    Mesh floor = bar({8, 8, 0.02}, {24, 24, 1}); // its top is a plane under the egg
    const Eigen::AngleAxisd tilt(0.7, Eigen::Vector3d(1, 2, 3).normalized());
    for (Eigen::Index i = 0; i < floor.positions.rows(); ++i) {
        const Point p = floor.positions.row(i);
        floor.positions.row(i) << p[0] - 4, p[2] - 1.72, -p[1];
    }
    const auto turned = [&](Mesh mesh) {
        mesh.positions = mesh.positions * tilt.toRotationMatrix().transpose();
        return mesh;
    };
    std::vector<Marker> markers = eggs.markers();
    for (Marker& marker : markers) marker.target = marker.target * tilt.toRotationMatrix().transpose();
    const FitResult clean = fit(eggs.source, turned(eggs.target), markers),
                    result = fit(eggs.source, turned(joined(eggs.target, floor)), markers);
    EXPECT_TRUE(says(result, "flat ground"));
    EXPECT_LT(largest(result.positions - clean.positions), 0.02);
}

TEST(Clutter, AFlatBottomIsNoFloor) {
    const Mesh block = bar({1, 1, 2}, {8, 8, 16});
    const std::vector<char> ground = ground_faces(block.positions, block.triangles);
    EXPECT_EQ(std::count(ground.begin(), ground.end(), 1), 0);
}

TEST(Clutter, ABustWithEyesAndTeethOnAScanWithATable) {
    const Sample bust = sample("bust");
    std::vector<MarkerPair> pairs;
    for (std::size_t k = 0; k < bust.marker_names.size(); ++k)
        pairs.push_back({bust.marker_names[k], bust.marker_source.row(static_cast<Eigen::Index>(k)),
                         bust.marker_target.row(static_cast<Eigen::Index>(k))});
    const FitResult result = fit(bust.source, bust.target, place_markers(pairs, bust.source));
    EXPECT_TRUE(says(result, "flat ground"));
    EXPECT_TRUE(says(result, "20 parts"));
    EXPECT_TRUE(says(result, "10 loose parts"));
    const Eigen::VectorXd off = (result.positions - bust.truth).rowwise().norm();
    EXPECT_LT(off.mean(), 0.01); // of a head of about 2
    EXPECT_LT(off.maxCoeff(), 0.06);
    Mesh fitted = bust.source;
    fitted.positions = result.positions;
    const Comparison both(fitted, bust.target);
    const Quality whole = measure(bust.source, both);
    std::vector<char> unanswered(static_cast<std::size_t>(fitted.positions.rows()), 0);
    for (const int v : result.carried) unanswered[static_cast<std::size_t>(v)] = 1;
    const AnsweredQuality answered = answered_quality(bust.source, both, whole, unanswered, result.left_out);
    EXPECT_GT(whole.target_to_fitted.mean, 5); // the table
    EXPECT_LT(answered.target_to_fitted.mean, 0.02);
    EXPECT_TRUE(answered.flipped.empty());
}

// A tube around the egg's waist, 8 % outside it.
Mesh garment(const Mesh& egg) {
    Mesh result = egg;
    std::vector<int> kept;
    for (Eigen::Index t = 0; t < egg.triangles.rows(); ++t) {
        const double y = (egg.positions(egg.triangles(t, 0), 1) + egg.positions(egg.triangles(t, 1), 1) +
                          egg.positions(egg.triangles(t, 2), 1)) /
                         3;
        if (std::abs(y) < 0.7) kept.push_back(static_cast<int>(t));
    }
    result.triangles = egg.triangles(kept, Eigen::all);
    result.positions *= 1.08;
    return result;
}

TEST(Layers, TheOuterOneIsFittedUnlessTheInnerIsAsked) {
    const Eggs eggs;
    const Mesh cloth = garment(eggs.target), target = joined(eggs.target, cloth);
    const ClosestPointIndex on_cloth(cloth), on_skin(eggs.target);
    const auto near = [&](const FitResult& r, const ClosestPointIndex& index) {
        int count = 0, waist = 0;
        for (Eigen::Index i = 0; i < r.positions.rows(); ++i) {
            if (std::abs(r.positions(i, 1)) > 0.4) continue;
            ++waist;
            count += std::sqrt(index.closest(Point(r.positions.row(i))).squared_distance) < 0.02 ? 1 : 0;
        }
        return static_cast<double>(count) / waist;
    };
    const FitResult outer = fit(eggs.source, target, eggs.markers());
    EXPECT_TRUE(says(outer, "one surface over another"));
    EXPECT_GT(near(outer, on_cloth), 0.99);
    FitOptions options;
    options.layer = TargetLayer::inner;
    EXPECT_GT(near(fit(eggs.source, target, eggs.markers(), options), on_skin), 0.99);
}

// A ball with a deep pocket, as a mouth behind lips: what is near the pole goes inwards.
Mesh with_pocket() {
    Mesh result = sphere(5);
    for (Eigen::Index i = 0; i < result.positions.rows(); ++i) {
        Point p = result.positions.row(i);
        const double angle = std::acos(std::clamp(p[2], -1.0, 1.0)), rim = 0.35;
        if (angle >= rim) continue;
        const double depth = (rim - angle) / rim; // 0 at the rim, 1 at the pole
        const double radius = depth < 0.2 ? 0.05 + 0.29 * (1 - depth / 0.2)
                                          : 0.05 + 0.3 * std::sin((depth - 0.2) / 0.8 * std::numbers::pi);
        const double around = std::atan2(p[1], p[0]);
        const bool pole = depth > 0.999;
        result.positions.row(i) << (pole ? 0 : radius * std::cos(around)), (pole ? 0 : radius * std::sin(around)),
            std::cos(rim) - 0.9 * std::max(0.0, depth - 0.2);
    }
    return result;
}

TEST(Exposure, APocketIsHiddenAndABallIsNot) {
    const Mesh plain = sphere(3), pocket = with_pocket();
    EXPECT_EQ(inner_shares(plain.positions, plain.triangles).hidden, 0);
    const std::vector<char> hidden =
        hidden_faces(pocket.positions, pocket.triangles, exposure(pocket.positions, pocket.triangles));
    double inside = 0, outside = 0;
    for (Eigen::Index t = 0; t < pocket.triangles.rows(); ++t) {
        if (hidden[static_cast<std::size_t>(t)] == 0) continue;
        const double height = pocket.positions(pocket.triangles(t, 0), 2);
        const double radius = pocket.positions.row(pocket.triangles(t, 0)).norm();
        (radius < 0.99 && height < 0.95 ? inside : outside) += triangle_area(pocket.positions, pocket.triangles, t);
    }
    EXPECT_GT(inside, 0.5);
    EXPECT_EQ(outside, 0);
}

TEST(Exposure, TheSameForAnyNumberOfThreads) {
    const Mesh pocket = with_pocket();
    set_threads(1);
    const std::vector<Exposure> one = exposure(pocket.positions, pocket.triangles);
    set_threads(0);
    const std::vector<Exposure> many = exposure(pocket.positions, pocket.triangles);
    for (std::size_t t = 0; t < one.size(); ++t)
        EXPECT_TRUE(one[t].open == many[t].open && one[t].back == many[t].back);
}

TEST(HiddenSource, IsCarriedAndStaysInside) {
    const Mesh source = with_pocket(), target = ball({0, 0, 0}, 1.3, 4);
    const FitResult result = fit(source, target, {});
    EXPECT_TRUE(says(result, "hidden from outside"));
    EXPECT_FALSE(result.carried.empty());
    for (const int v : result.carried)
        EXPECT_LT(result.positions.row(v).norm(), 1.33) << v; // nothing comes out through the skin
}

TEST(Faults, FacesThatAreNoneTakeNoPart) {
    const Eggs eggs;
    Mesh source = eggs.source;
    const Mesh speck = ball({0.2, 0.1, 0}, 0, 0); // all of its vertices in one place
    source = joined(source, speck);
    const FitResult clean = fit(eggs.source, eggs.target, eggs.markers()),
                    result = fit(source, eggs.target, eggs.markers());
    EXPECT_EQ(result.positions.topRows(eggs.source.positions.rows()), clean.positions);
    EXPECT_TRUE(result.positions.allFinite());
    EXPECT_TRUE(says(result, "without area"));
    const Points end = result.positions.bottomRows(speck.positions.rows());
    EXPECT_LT(largest(end.rowwise() - end.row(0)), 1e-12);
    EXPECT_LT(end.row(0).norm(), 1.5);
}

TEST(Faults, NumbersInTheResultAreTheSources) {
    const Eggs eggs;
    const Mesh source = joined(ball({0.3, 0, 0}, 0.1), eggs.source); // the loose part comes first in the file
    std::vector<MarkerPair> pairs;
    const Eigen::Index n = source.positions.rows() - eggs.source.positions.rows();
    for (int k = 0; k < 20; ++k) {
        const int v = k * 127 % static_cast<int>(eggs.source.positions.rows());
        pairs.push_back({"m" + std::to_string(k), source.positions.row(n + v), eggs.truth.row(v)});
    }
    std::swap(pairs[3].target, pairs[11].target); // folds it
    const FitResult result = fit(source, eggs.target, place_markers(pairs, source));
    const auto of_egg = [&](int t) { return source.triangles(t, 0) >= n; };
    for (const int t : result.flipped) EXPECT_TRUE(of_egg(t));
    for (const auto& [s, t] : result.cuts) EXPECT_TRUE(of_egg(s) && of_egg(t));
    for (const int v : result.refused) EXPECT_GE(v, n);
}

TEST(AnsweredQuality, LeavesOutWhatHasNoCounterpart) {
    const Eggs eggs;
    const Mesh source = joined(eggs.source, ball({0, 0, 0}, 0.3));
    const FitResult result = fit(source, eggs.target, eggs.markers());
    Mesh fitted = source;
    fitted.positions = result.positions;
    const Comparison both(fitted, eggs.target);
    std::vector<char> unanswered(static_cast<std::size_t>(source.positions.rows()), 0);
    const Quality whole = measure(source, both);
    const AnsweredQuality all = answered_quality(both, whole, unanswered);
    EXPECT_EQ(all.fitted_to_target.mean, whole.fitted_to_target.mean);
    for (const int v : result.carried) unanswered[static_cast<std::size_t>(v)] = 1;
    const AnsweredQuality some = answered_quality(both, whole, unanswered);
    EXPECT_EQ(some.faces, eggs.source.triangles.rows());
    EXPECT_LT(some.fitted_to_target.mean, 0.01 * whole.fitted_to_target.mean);
}

TEST(Genus, IsToldWhereItDiffers) {
    FitOptions options;
    options.method = FitMethod::surface;
    const FitResult result = fit(sphere(3), sample("torus").source, {}, options);
    EXPECT_TRUE(says(result, "the source has 0 handles and the target 1 handle"));
}

TEST(CutOffBorders, AreNone) {
    const Mesh half = [] {
        Mesh m = sphere(2);
        std::vector<int> kept;
        for (Eigen::Index t = 0; t < m.triangles.rows(); ++t)
            if (m.positions(m.triangles(t, 0), 2) > 0.1) kept.push_back(static_cast<int>(t));
        const Portion part = portion(m.positions, m.triangles, kept);
        m.positions = part.positions;
        m.triangles = part.triangles;
        return m;
    }();
    Shell whole = shell(half.positions, half.triangles);
    ASSERT_GT(whole.border.rows(), 8);
    const int first = whole.border(0, 0);
    EXPECT_TRUE(has_border(whole, first));
    std::vector<char> flags(whole.area.size(), 1);
    end_borders(whole, flags);
    EXPECT_EQ(whole.border.rows(), 0);
    EXPECT_FALSE(has_border(whole, first));
}

} // namespace
