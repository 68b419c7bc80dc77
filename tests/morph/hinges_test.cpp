#include "meshtween/morph/hinges.h"

#include "meshtween/core/parallel.h"
#include "meshtween/geometry/measure.h"
#include "meshtween/morph/curve.h"
#include "meshtween/morph/morph.h"
#include "meshtween/morph/path_quality.h"
#include "support/posed.h"

#include <gtest/gtest.h>

namespace meshtween {
namespace {

const Eigen::Vector3d axis(1, 2, 0.5);

// A sheet of 20 x 6 squares, of which the half with x > 10 is folded up by an angle (radians).
struct Sheet {
    static constexpr int length = 20, width = 6;
    Mesh mesh;

    Sheet() {
        mesh.positions.resize((length + 1) * (width + 1), 3);
        mesh.triangles.resize(2 * length * width, 3);
        const auto vertex = [](int i, int j) { return i * (width + 1) + j; };
        for (int i = 0; i <= length; ++i)
            for (int j = 0; j <= width; ++j) mesh.positions.row(vertex(i, j)) << i, 0, j;
        for (int i = 0, t = 0; i < length; ++i)
            for (int j = 0; j < width; ++j, t += 2) {
                mesh.triangles.row(t) << vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1);
                mesh.triangles.row(t + 1) << vertex(i, j), vertex(i + 1, j + 1), vertex(i + 1, j);
            }
    }

    Points folded(double angle) const {
        Points result = mesh.positions;
        for (Eigen::Index i = 0; i < result.rows(); ++i)
            if (const double beyond = result(i, 0) - 10; beyond > 0)
                result.row(i) << 10 + beyond * std::cos(angle), beyond * std::sin(angle), result(i, 2);
        return result;
    }
    Mesh with(const Points& positions) const {
        Mesh result = mesh;
        result.positions = positions;
        return result;
    }
};

// Every edge as long as in the sheet, and the fold half-way between.
void expect_half(const Sheet& sheet, const Points& half, double angle) {
    const Points wanted = sheet.folded(angle);
    EXPECT_LT(test::edge_error(sheet.mesh.triangles, wanted, wanted, half), 1e-3);
    const auto span = [](const Points& p) { return (p.row(0) - p.row(p.rows() - 1)).norm(); };
    EXPECT_NEAR(span(half), span(wanted), 0.01 * span(sheet.mesh.positions));
}

TEST(Hinges, AFoldGoesTheWayThatItOpens) { // by the shorter turn, of 160 degrees, it would close onto itself
    const Sheet sheet;
    for (const double more : {0.0, 20.0}) {
        const Mesh from = sheet.with(sheet.folded((100 + more) * test::degree));
        const Points to = sheet.folded((-100 + more) * test::degree);
        const Morph path = morph(from, to);
        expect_half(sheet, path.at(0.5), more * test::degree);
        const PathQuality quality = path_quality(from.triangles, path.at, {.self_intersections = true});
        for (const FrameQuality& frame : quality.frames) {
            EXPECT_TRUE(frame.flipped.empty()) << frame.u;
            EXPECT_TRUE(frame.self_intersections.empty()) << frame.u;
        }
        EXPECT_LE(curve(path).nodes.size(), 9u);
    }
}

TEST(Hinges, EndsAreExactFromAllSides) {
    const Sheet sheet;
    const Mesh from = sheet.with(sheet.folded(100 * test::degree));
    const Points to = test::shaken(sheet.folded(-100 * test::degree), 0.05);
    const Morph path = morph(from, to);
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(to.rows());
    EXPECT_LT(test::distance(path.at_each(0 * one, 0), from.positions), 1e-9 * diagonal(to));
    EXPECT_LT(test::distance(path.at_each(one, 1), to), 1e-9 * diagonal(to));
    EXPECT_LT(test::distance(path.at(1e-7), from.positions), 1e-6 * diagonal(to));
    EXPECT_LT(test::distance(path.at(1 - 1e-7), to), 1e-6 * diagonal(to));
}

TEST(Hinges, NeitherTheTurnNorTheOrderOfTheEndsMatters) {
    const Sheet sheet;
    const Mesh from = sheet.with(test::shaken(sheet.folded(100 * test::degree), 0.05));
    const Points to = sheet.folded(-100 * test::degree);
    const Points shape = morph(from, to).at(0.3);
    const Points turned = morph(from, test::turned(to, 2.5, axis, {3, -9, 1})).at(0.3);
    EXPECT_LT(test::edge_error(from.triangles, shape, shape, turned), 1e-6);
    const Points back = morph(sheet.with(to), from.positions).at(0.7);
    EXPECT_LT(test::distance(shape, back), 1e-3 * diagonal(to));
}

TEST(Hinges, OnlyWherePatchesTurnFar) {
    const Mesh bar = test::bar(40, 4);
    for (const double angle : {60.0, 170.0}) {
        const Points to = test::bent(bar.positions, angle * test::degree);
        const FaceField faces = face_field(bar.positions, to, bar.triangles);
        const Topology top = topology(bar.positions.rows(), bar.triangles);
        for (const char flag : entangled(faces, patches(faces, bar.triangles, top, 100))) EXPECT_FALSE(flag);
    }
    const Sheet sheet;
    const FaceField faces =
        face_field(sheet.folded(100 * test::degree), sheet.folded(-100 * test::degree), sheet.mesh.triangles);
    const Topology top = topology(sheet.mesh.positions.rows(), sheet.mesh.triangles);
    const std::vector<char> flags = entangled(faces, patches(faces, sheet.mesh.triangles, top, 20));
    EXPECT_GT(std::count(flags.begin(), flags.end(), 1), 1);
}

TEST(Hinges, NothingAroundAndDegenerateTriangles) { // the whole sheet crumpled, so that no patch is calm
    const Sheet sheet;
    const Mesh from = sheet.with(test::shaken(sheet.mesh.positions, 0.8));
    Points to = test::shaken(sheet.folded(1), 0.8, 2);
    to.row(sheet.mesh.triangles(40, 0)) = to.row(sheet.mesh.triangles(40, 1));
    const Morph path = morph(from, to);
    EXPECT_TRUE(path.at(0.5).allFinite());
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(to.rows());
    EXPECT_LT(test::distance(path.at_each(one, 1), to), 1e-9 * diagonal(to));
}

TEST(Hinges, SameBitsForAnyNumberOfThreads) {
    const Sheet sheet;
    const Mesh from = sheet.with(sheet.folded(100 * test::degree));
    const Points to = test::shaken(sheet.folded(-100 * test::degree), 0.1);
    set_threads(1);
    const Points one = morph(from, to).at(0.4);
    set_threads(2);
    const Points two = morph(from, to).at(0.4);
    set_threads(0);
    EXPECT_EQ(one, two);
}

} // namespace
} // namespace meshtween
