#include "meshtween/fit/refined_fit.h"

#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/shapes.h"
#include "meshtween/search/closest_point.h"

#include "support/errors.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace meshtween;

namespace {

std::vector<Marker> first_vertices(const Mesh& source, const Points& goals, int count) {
    std::vector<Marker> markers;
    for (int v = 0; v < count; ++v)
        for (Eigen::Index t = 0; t < source.triangles.rows(); ++t)
            if (source.triangles(t, 0) == v) {
                markers.push_back({"m" + std::to_string(v), {static_cast<int>(t), {1, 0, 0}}, goals.row(v)});
                break;
            }
    return markers;
}

double mean_distance_to(const Mesh& surface, const Points& points) {
    const ClosestPointIndex index(surface);
    double sum = 0;
    for (const ClosestPoint& c : index.closest(points)) sum += std::sqrt(c.squared_distance);
    return sum / static_cast<double>(points.rows());
}

long count(const std::vector<char>& flags) {
    return std::count(flags.begin(), flags.end(), 1);
}

TEST(TooCoarse, NothingOfAMeshOnItself) {
    const Mesh m = sphere(3);
    EXPECT_EQ(count(too_coarse(m, topology(m.positions.rows(), m.triangles), m, 2e-4)), 0);
}

TEST(TooCoarse, EveryEdgeOfABallInAMuchFinerOne) {
    const Mesh coarse = sphere(2), fine = sphere(5);
    const Topology edges = topology(coarse.positions.rows(), coarse.triangles);
    EXPECT_EQ(count(too_coarse(coarse, edges, fine, 2e-4)), std::ssize(edges.edges));
    EXPECT_EQ(count(too_coarse(coarse, edges, fine, 0.1)), 0);
}

TEST(TooCoarse, OnlyWhereTheTargetIsFiner) {
    const Mesh flat = bar({1, 1, 0.3}, {4, 4, 1});
    Mesh target = bar({1, 1, 0.3}, {16, 16, 4});
    for (Eigen::Index i = 0; i < target.positions.rows(); ++i) { // a low hill within one square of the top
        const Point p = target.positions.row(i);
        if (p[2] > 0.1 && p[0] > 0.51 && p[0] < 0.74 && p[1] > 0.01 && p[1] < 0.24) target.positions(i, 2) += 0.01;
    }
    const Topology edges = topology(flat.positions.rows(), flat.triangles);
    const std::vector<char> flags = too_coarse(flat, edges, target, 1e-3);
    EXPECT_GT(count(flags), 0);
    for (std::size_t e = 0; e < flags.size(); ++e)
        if (flags[e] != 0) {
            for (const int v : edges.edges[e].vertices) {
                EXPECT_GT(flat.positions(v, 2), 0.1);
                EXPECT_GT(flat.positions(v, 0), 0.2); // the square, and the triangles beside it
            }
        }
}

TEST(RefinedFit, FollowsATargetThatTheTemplateCannot) {
    const Mesh coarse = sphere(1);
    Mesh target = sphere(5);
    target.positions.col(1) *= 1.3;
    const auto markers = first_vertices(coarse, target.positions, 12);
    const FitResult plain = fit(coarse, target, markers);
    const RefinedFit refined = refined_fit(coarse, target, markers);
    ASSERT_EQ(refined.added.size(), 3u);
    EXPECT_EQ(refined.source.positions.topRows(coarse.positions.rows()), coarse.positions);
    EXPECT_EQ(refined.fit.positions.rows(), refined.source.positions.rows());
    const Mesh before{plain.positions, coarse.triangles, {}, {}, {}},
        after{refined.fit.positions, refined.source.triangles, {}, {}, {}};
    EXPECT_LT(mean_distance_to(after, target.positions), 0.1 * mean_distance_to(before, target.positions));
}

TEST(RefinedFit, LeavesAFineTemplateAlone) {
    const Mesh m = sphere(3);
    const RefinedFit refined = refined_fit(m, m, first_vertices(m, m.positions, 8));
    EXPECT_TRUE(refined.added.empty());
    EXPECT_EQ(refined.source.triangles, m.triangles);
}

TEST(RefinedFit, BoundsAndCancelling) {
    const Mesh coarse = sphere(1), target = sphere(4);
    RefineOptions bounded;
    bounded.most_vertices = 100;
    const RefinedFit small = refined_fit(coarse, target, {}, {}, bounded);
    EXPECT_LE(small.source.positions.rows(), 100);
    EXPECT_NE(small.fit.notes.back().find("100"), std::string::npos);
    const RefinedFit stopped =
        refined_fit(coarse, target, {}, {}, {}, [](double f, std::string_view) { return f < 0.3; });
    EXPECT_EQ(stopped.fit.end, FitEnd::cancelled);
    EXPECT_EQ(stopped.fit.positions.rows(), stopped.source.positions.rows());
    RefineOptions wrong;
    wrong.tolerance = 0;
    EXPECT_NE(message_of(ErrorKind::argument, [&] { refined_fit(coarse, target, {}, {}, wrong); }).find("tolerance"),
              std::string::npos);
}

} // namespace
