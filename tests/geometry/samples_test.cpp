#include "meshtween/geometry/samples.h"

#include "meshtween/core/error.h"
#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/geometry/topology.h"

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

// Each directed edge once and its opposite once: closed, manifold along edges, one way round everywhere.
bool closed_and_oriented(const Mesh& mesh) {
    std::set<std::pair<int, int>> directed;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            if (!directed.emplace(mesh.triangles(t, k), mesh.triangles(t, (k + 1) % 3)).second) return false;
    return std::all_of(directed.begin(), directed.end(), [&](const auto& e) {
        return directed.count({e.second, e.first}) == 1;
    });
}

class SampleOf : public testing::TestWithParam<std::string> {};

TEST_P(SampleOf, MeshesAreSound) {
    const Sample s = sample(GetParam());
    for (const Mesh* mesh : {&s.source, &s.target}) {
        ASSERT_TRUE(mesh->positions.allFinite());
        EXPECT_TRUE(closed_and_oriented(*mesh));
        const Topology t = topology(mesh->positions.rows(), mesh->triangles);
        const auto edges = static_cast<long>(t.edges.size());
        EXPECT_EQ(mesh->positions.rows() - edges + mesh->triangles.rows(), 2 - 2 * expected_genus(s.name));
        const std::vector<int> parts = components(t);
        EXPECT_EQ(*std::max_element(parts.begin(), parts.end()), 0);
        EXPECT_GT(volume(mesh->positions, mesh->triangles), 0);
        const double length = diagonal(mesh->positions);
        for (Eigen::Index f = 0; f < mesh->triangles.rows(); ++f)
            EXPECT_GT(triangle_area(mesh->positions, mesh->triangles, f), 1e-8 * length * length) << "face " << f;
    }
}

TEST_P(SampleOf, PartsFitTogether) {
    const Sample s = sample(GetParam());
    EXPECT_EQ(s.name, GetParam());
    EXPECT_EQ(s.truth.rows(), s.source.positions.rows());
    EXPECT_TRUE(s.truth.allFinite());
    EXPECT_EQ(s.marker_source.rows(), s.marker_target.rows());
    EXPECT_EQ(s.marker_source.rows(), static_cast<Eigen::Index>(s.marker_names.size()));
    EXPECT_EQ(std::set(s.marker_names.begin(), s.marker_names.end()).size(), s.marker_names.size());
    if (s.same_connectivity) {
        EXPECT_EQ(s.source.triangles, s.target.triangles);
        EXPECT_EQ(s.truth, s.target.positions);
        EXPECT_EQ(s.middle.rows(), s.source.positions.rows());
    }
}

TEST_P(SampleOf, SameBitsForAnyNumberOfThreads) {
    const int before = threads();
    set_threads(1);
    const Sample one = sample(GetParam());
    set_threads(2);
    const Sample two = sample(GetParam());
    set_threads(before);
    EXPECT_EQ(one.source.positions, two.source.positions);
    EXPECT_EQ(one.source.triangles, two.source.triangles);
    EXPECT_EQ(one.target.positions, two.target.positions);
    EXPECT_EQ(one.target.triangles, two.target.triangles);
    EXPECT_EQ(one.truth, two.truth);
    EXPECT_EQ(one.marker_source, two.marker_source);
    EXPECT_EQ(one.marker_target, two.marker_target);
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

INSTANTIATE_TEST_SUITE_P(All, SampleOf, testing::ValuesIn(names()), test_name);

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

TEST(Samples, MiddleOfTheTurnedSphereIsASphere) {
    const Sample s = sample("sphere-turn");
    EXPECT_LT((s.middle.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-12);
}

} // namespace
} // namespace meshtween
