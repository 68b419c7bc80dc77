#include "meshtween/geometry/samples.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/surface_lookup.h"
#include "meshtween/geometry/topology.h"
#include "meshtween/search/self_intersections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace meshtween {
namespace {

int expected_genus(const std::string& name) {
    static const std::map<std::string, int> handles{{"torus", 1}, {"cup", 2}};
    const auto found = handles.find(name);
    return found == handles.end() ? 0 : found->second;
}

bool is_open(const std::string& name) {
    return name == "scan";
}

// Each directed edge once: manifold along edges, one way round everywhere.
std::set<std::pair<int, int>> directed_edges(const Mesh& mesh) {
    std::set<std::pair<int, int>> directed;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            EXPECT_TRUE(directed.emplace(mesh.triangles(t, k), mesh.triangles(t, (k + 1) % 3)).second);
    return directed;
}

// And its opposite once.
bool closed_and_oriented(const Mesh& mesh) {
    const std::set<std::pair<int, int>> directed = directed_edges(mesh);
    return std::all_of(directed.begin(), directed.end(), [&](const auto& e) {
        return directed.count({e.second, e.first}) == 1;
    });
}

class SampleOf : public testing::TestWithParam<std::string> {};

void expect_well_made(const Mesh& mesh) {
    ASSERT_TRUE(mesh.positions.allFinite());
    const std::vector<int> parts = components(topology(mesh.positions.rows(), mesh.triangles));
    EXPECT_EQ(*std::max_element(parts.begin(), parts.end()), 0);
    const double length = diagonal(mesh);
    double smallest = length;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
        smallest = std::min(smallest, triangle_area(mesh.positions, mesh.triangles, f));
    EXPECT_GT(smallest, 1e-7 * length * length);
    EXPECT_TRUE(self_intersections(mesh.positions, mesh.triangles).empty());
}

void expect_sound(const Mesh& mesh, int genus) {
    expect_well_made(mesh);
    EXPECT_TRUE(closed_and_oriented(mesh));
    const Topology t = topology(mesh.positions.rows(), mesh.triangles);
    const auto edges = static_cast<long>(t.edges.size());
    EXPECT_EQ(mesh.positions.rows() - edges + mesh.triangles.rows(), 2 - 2 * genus);
    EXPECT_GT(volume(mesh.positions, mesh.triangles), 0);
}

// The source's triangles on the truth must give the target's body: its volume, its area, its extent.
void expect_true(const Sample& s) {
    ASSERT_EQ(s.truth.rows(), s.source.positions.rows());
    ASSERT_TRUE(s.truth.allFinite());
    const double length = diagonal(s.target), bulk = volume(s.target.positions, s.target.triangles);
    const double skin = surface_area(s.target.positions, s.target.triangles);
    EXPECT_NEAR(volume(s.truth, s.source.triangles), bulk, 0.01 * bulk);
    EXPECT_NEAR(surface_area(s.truth, s.source.triangles), skin, 0.01 * skin);
    EXPECT_NEAR(diagonal(s.truth), length, 0.005 * length);
    const SurfaceLookup on_target(s.target, 0.01 * length);
    EXPECT_LT((on_target.closest(s.truth) - s.truth).rowwise().norm().maxCoeff(), 0.001 * length);
}

// The target is a part of the source's triangles on the truth.
void expect_part(const Sample& s) {
    expect_well_made(s.target);
    EXPECT_GT(directed_edges(s.target).size(), 0U);
    ASSERT_EQ(s.truth.rows(), s.source.positions.rows());
    const double length = diagonal(s.target);
    EXPECT_LT(2 * surface_area(s.target.positions, s.target.triangles), surface_area(s.truth, s.source.triangles));
    Mesh whole = s.source;
    whole.positions = s.truth;
    const SurfaceLookup on_truth(whole, 0.01 * length);
    const Points found = on_truth.closest(s.target.positions);
    EXPECT_LT((found - s.target.positions).rowwise().norm().maxCoeff(), 0.005 * length);
    EXPECT_GT((found - s.target.positions).rowwise().norm().minCoeff(), 0) << "found within reach";
}

void expect_marked(const Sample& s) {
    ASSERT_EQ(s.marker_source.rows(), static_cast<Eigen::Index>(s.marker_names.size()));
    ASSERT_EQ(s.marker_target.rows(), s.marker_source.rows());
    EXPECT_EQ(std::set(s.marker_names.begin(), s.marker_names.end()).size(), s.marker_names.size());
    const double length = diagonal(s.target);
    const SurfaceLookup on_source(s.source, 0.01 * length), on_target(s.target, 0.01 * length);
    for (Eigen::Index m = 0; m < s.marker_source.rows(); ++m) {
        // The truth near the marker leads to the marker's other end.
        Eigen::Index v = 0;
        const double away = (s.source.positions.rowwise() - s.marker_source.row(m)).rowwise().norm().minCoeff(&v);
        EXPECT_LT((s.truth.row(v) - s.marker_target.row(m)).norm(), 2 * away + 0.002 * length)
            << s.marker_names[static_cast<std::size_t>(m)];
        const Point from = s.marker_source.row(m), to = s.marker_target.row(m);
        EXPECT_LT((on_source.closest(from) - from).norm(), 1e-9 * length);
        EXPECT_LT((on_target.closest(to) - to).norm(), 1e-9 * length);
    }
}

TEST_P(SampleOf, IsSoundTrueAndTheSameTwice) {
    const int before = threads();
    set_threads(1);
    const Sample s = sample(GetParam());
    set_threads(2);
    const Sample again = sample(GetParam());
    set_threads(before);
    EXPECT_EQ(s.name, GetParam());
    EXPECT_FALSE(s.description.empty());
    expect_sound(s.source, expected_genus(s.name));
    if (is_open(s.name)) {
        expect_part(s);
    } else {
        expect_sound(s.target, expected_genus(s.name));
        expect_true(s);
    }
    expect_marked(s);
    EXPECT_EQ(s.same_connectivity,
              s.source.triangles.rows() == s.target.triangles.rows() && s.source.triangles == s.target.triangles);
    EXPECT_EQ(s.same_connectivity, s.marker_names.empty());
    if (s.same_connectivity) {
        EXPECT_EQ(s.truth, s.target.positions);
        EXPECT_EQ(s.middle.rows(), s.source.positions.rows());
    }
    EXPECT_EQ(s.source.positions, again.source.positions);
    EXPECT_EQ(s.source.triangles, again.source.triangles);
    EXPECT_EQ(s.target.positions, again.target.positions);
    EXPECT_EQ(s.target.triangles, again.target.triangles);
    EXPECT_EQ(s.truth, again.truth);
    EXPECT_EQ(s.marker_source, again.marker_source);
    EXPECT_EQ(s.marker_target, again.marker_target);
}

std::vector<std::string> names() {
    std::vector<std::string> list;
    for (const SampleInfo& info : samples()) list.push_back(info.name);
    return list;
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

// Beside the subject lie loose parts, a table and bits, which are no sound surface with it.
std::vector<std::string> clean_names() {
    std::vector<std::string> list = names();
    std::erase(list, "bust");
    return list;
}

INSTANTIATE_TEST_SUITE_P(All, SampleOf, testing::ValuesIn(clean_names()), test_name);

TEST(Samples, BustIsTheHeadWithMore) {
    const Sample head = sample("head"), bust = sample("bust");
    const auto parts = [](const Mesh& mesh) {
        const std::vector<int> of = components(topology(mesh.positions.rows(), mesh.triangles));
        return *std::max_element(of.begin(), of.end()) + 1;
    };
    EXPECT_EQ(parts(bust.source), 1 + 2 + 8); // eyes and teeth
    EXPECT_EQ(parts(bust.target), 1 + 1 + 20);
    EXPECT_EQ(bust.source.positions.topRows(head.source.positions.rows()), head.source.positions);
    EXPECT_EQ(bust.target.triangles.topRows(head.target.triangles.rows()), head.target.triangles);
    EXPECT_EQ(bust.truth.rows(), bust.source.positions.rows());
    EXPECT_EQ(bust.marker_target, head.marker_target);
}

TEST(Samples, UnknownNameTellsThoseThatExist) {
    try {
        sample("teapot");
        FAIL();
    } catch (const Error& e) {
        EXPECT_EQ(e.kind(), ErrorKind::argument);
        const std::string message = e.what();
        EXPECT_NE(message.find("teapot"), std::string::npos);
        for (const std::string& name : names()) EXPECT_NE(message.find(name), std::string::npos) << name;
    }
}

TEST(Samples, SubdividedOneHasTheSameShapes) {
    const Sample s = sample("torus"), fine = sample("torus", 1);
    EXPECT_EQ(fine.source.triangles.rows(), 4 * s.source.triangles.rows());
    EXPECT_EQ(fine.target.positions.topRows(s.target.positions.rows()), s.target.positions);
    EXPECT_EQ(fine.truth.rows(), fine.source.positions.rows());
    expect_true(fine);
    expect_marked(fine);
}

TEST(Samples, MiddleOfTheTurnedSphereIsASphere) {
    const Sample s = sample("sphere-turn");
    EXPECT_LT((s.middle.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
}

} // namespace
} // namespace meshtween
