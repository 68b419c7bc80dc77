// Small meshes with every defect that a file can hold, onto each other: each fit ends with finite positions or with a
// sentence about the file.
#include "meshtween/core/error.h"
#include "meshtween/fit/fit.h"
#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <random>

using namespace meshtween;

namespace {

struct Chance {
    std::mt19937 engine;
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(engine()) / static_cast<double>(std::mt19937::max());
    }
    int below(std::ptrdiff_t count) { return static_cast<int>(engine() % static_cast<unsigned>(count)); }
    Point point(double size) {
        const double x = between(-size, size), y = between(-size, size);
        return {x, y, between(-size, size)};
    }
};

void add_face(Mesh& mesh, int a, int b, int c) {
    mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, 3);
    mesh.triangles.bottomRows(1) << a, b, c;
}

int add_vertex(Mesh& mesh, const Point& at) {
    mesh.positions.conservativeResize(mesh.positions.rows() + 1, 3);
    mesh.positions.bottomRows(1) = at;
    return static_cast<int>(mesh.positions.rows()) - 1;
}

void add_part(Mesh& mesh, const Mesh& part) {
    const auto offset = static_cast<int>(mesh.positions.rows());
    for (Eigen::Index i = 0; i < part.positions.rows(); ++i) add_vertex(mesh, part.positions.row(i));
    for (Eigen::Index t = 0; t < part.triangles.rows(); ++t)
        add_face(mesh, part.triangles(t, 0) + offset, part.triangles(t, 1) + offset, part.triangles(t, 2) + offset);
}

void keep_some_faces(Mesh& mesh, Chance& chance, double share) {
    Triangles kept(mesh.triangles.rows(), 3);
    Eigen::Index count = 0;
    for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t)
        if (t == 0 || chance.between(0, 1) < share) kept.row(count++) = mesh.triangles.row(t);
    mesh.triangles = kept.topRows(count);
}

using Defect = void (*)(Mesh&, Chance&);

// clang-format off
const Defect defects[] = {
    [](Mesh& m, Chance& c) { // the same faces again
        for (int k = c.below(20); k >= 0; --k) {
            const Eigen::RowVector3i f = m.triangles.row(c.below(m.triangles.rows()));
            add_face(m, f[0], f[1], f[2]);
        }
    },
    [](Mesh& m, Chance& c) { // a face of two vertices
        const int t = c.below(m.triangles.rows());
        add_face(m, m.triangles(t, 0), m.triangles(t, 1), m.triangles(t, 1));
    },
    [](Mesh& m, Chance& c) { // an edge without length
        const int t = c.below(m.triangles.rows());
        m.positions.row(m.triangles(t, 0)) = Point(m.positions.row(m.triangles(t, 1)));
    },
    [](Mesh& m, Chance& c) { add_vertex(m, c.point(1e4)); }, // a vertex of no face
    [](Mesh& m, Chance& c) { // a fin: an edge of three faces
        const int t = c.below(m.triangles.rows()), v = add_vertex(m, c.point(3));
        add_face(m, m.triangles(t, 0), m.triangles(t, 1), v);
    },
    [](Mesh& m, Chance& c) { // faces turned over
        for (Eigen::Index t = 0; t < m.triangles.rows(); ++t)
            if (c.between(0, 1) < 0.3) std::swap(m.triangles(t, 0), m.triangles(t, 1));
    },
    [](Mesh& m, Chance& c) { keep_some_faces(m, c, 0.8); }, // holes
    [](Mesh& m, Chance& c) { // a loose part of any size
        Mesh part = sphere(c.below(2));
        const double size = std::pow(10, c.between(-6, 0.5));
        part.positions = (size * part.positions).rowwise() + c.point(3);
        add_part(m, part);
    },
    [](Mesh& m, Chance& c) { // rough, and cutting itself
        for (Eigen::Index i = 0; i < m.positions.rows(); ++i) m.positions.row(i) += c.point(0.1);
    },
    [](Mesh& m, Chance& c) { m.positions.col(c.below(3)) *= std::array{0.0, 1e-9, 1e-3}[static_cast<std::size_t>(c.below(3))]; },
    [](Mesh& m, Chance&) { // a part that is one point
        const int v = add_vertex(m, {0.3, 0.2, 0.1});
        for (int k = 0; k < 3; ++k) add_vertex(m, {0.3, 0.2, 0.1});
        add_face(m, v, v + 1, v + 2), add_face(m, v, v + 2, v + 3);
    },
    [](Mesh& m, Chance& c) { // two fans that meet in one vertex
        const int from = c.below(m.positions.rows()), to = c.below(m.positions.rows());
        m.triangles = (m.triangles.array() == from).select(to, m.triangles).eval();
    },
    [](Mesh& m, Chance& c) { m.positions *= std::pow(10, c.between(-12, 12)); }, // any unit
    [](Mesh& m, Chance&) { // two layers
        Mesh layer = m;
        layer.positions *= 1.05;
        add_part(m, layer);
    },
};
// clang-format on

Mesh damaged(Chance& chance) {
    Mesh mesh = sphere(std::array{0, 1, 2, 2, 3}[static_cast<std::size_t>(chance.below(5))]);
    for (int k = 0; k < 3; ++k) mesh.positions.col(k) *= chance.between(0.5, 2);
    for (int k = chance.below(6); k > 0; --k) defects[chance.below(std::ssize(defects))](mesh, chance);
    return mesh;
}

// In parts, so that a test runner may take them side by side; MESHTWEEN_DEFECTS is how many pairs each has.
class Defects : public testing::TestWithParam<unsigned> {};

TEST_P(Defects, EndWithAResultOrASentence) {
    const char* more = std::getenv("MESHTWEEN_DEFECTS");
    const unsigned pairs = more ? static_cast<unsigned>(std::stoul(more)) : 10;
    for (unsigned k = 0; k < pairs; ++k) {
        const unsigned seed = GetParam() * pairs + k;
        Chance chance{std::mt19937(seed)};
        const Mesh source = damaged(chance), target = damaged(chance);
        try {
            const FitResult result = fit(source, target, {});
            EXPECT_EQ(result.positions.rows(), source.positions.rows()) << seed;
            EXPECT_TRUE(result.positions.allFinite()) << seed;
        } catch (const Error& error) {
            EXPECT_GT(std::string_view(error.what()).size(), 20u) << seed;
            EXPECT_EQ(std::string_view(error.what()).find("internal"), std::string_view::npos) << seed;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(OfAllKinds, Defects, testing::Range(0u, 10u));

} // namespace
