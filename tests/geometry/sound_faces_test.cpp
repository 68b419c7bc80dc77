#include "meshtween/geometry/sound_faces.h"

#include "meshtween/geometry/genus.h"
#include "meshtween/geometry/portion.h"
#include "meshtween/geometry/samples.h"
#include "meshtween/geometry/shapes.h"

#include <gtest/gtest.h>

using namespace meshtween;

namespace {

Triangles with_row(const Triangles& triangles, int a, int b, int c) {
    Triangles result(triangles.rows() + 1, 3);
    result << triangles, Eigen::RowVector3i(a, b, c);
    return result;
}

TEST(SoundFaces, OfASoundMeshAreAll) {
    const Mesh ball = sphere(2);
    const SoundFaces faces = sound_faces(ball.positions, ball.triangles);
    EXPECT_EQ(std::ssize(faces.kept), ball.triangles.rows());
    EXPECT_EQ(faces.triangles, ball.triangles);
    EXPECT_EQ(faces.collapsed + faces.doubled, 0);
}

TEST(SoundFaces, RepeatedAndFlatOnesAreLeftOut) {
    const Mesh ball = sphere(2);
    const auto f = ball.triangles.row(5);
    Triangles more = with_row(ball.triangles, f[0], f[1], f[1]);
    more = with_row(more, f[1], f[0], f[2]); // the same the other way round
    const SoundFaces faces = sound_faces(ball.positions, more);
    EXPECT_EQ(std::ssize(faces.kept), ball.triangles.rows());
    EXPECT_EQ(faces.collapsed, 1);
    EXPECT_EQ(faces.doubled, 1);
    EXPECT_EQ(faces.kept.back(), ball.triangles.rows() - 1);
}

TEST(SoundFaces, VerticesThatAnEdgeWithoutLengthJoinsAreOne) {
    Points x(5, 3);
    x << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 1, 0, 0; // the last lies on the second
    Triangles t(3, 3);
    t << 0, 1, 2, 1, 4, 2, 4, 3, 2;
    const SoundFaces faces = sound_faces(x, t);
    EXPECT_EQ(faces.kept, (std::vector<int>{0, 2}));
    EXPECT_EQ(faces.vertex[4], 1);
    EXPECT_EQ(faces.triangles.row(2), Eigen::RowVector3i(1, 3, 2));
}

TEST(Portion, HasItsVerticesInOrderAndTakesThemBack) {
    const Mesh ball = sphere(1);
    const Portion part = portion(ball.positions, ball.triangles, {7, 3});
    EXPECT_TRUE(std::is_sorted(part.vertex.begin(), part.vertex.end()));
    for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(part.vertex[static_cast<std::size_t>(part.triangles(0, k))], ball.triangles(7, k));
        EXPECT_EQ(part.vertex[static_cast<std::size_t>(part.triangles(1, k))], ball.triangles(3, k));
    }
    Points x = ball.positions;
    put_rows(part, 2 * rows_of(part, x), x);
    for (int v = 0; v < x.rows(); ++v)
        EXPECT_EQ(x.row(v), (part.of_vertex[static_cast<std::size_t>(v)] >= 0 ? 2 : 1) * ball.positions.row(v));
}

TEST(Handles, OfBallsRingsAndSheets) {
    const Mesh ball = sphere(2), ring = sample("torus").source, box = bar({1, 1, 1}, {2, 2, 2});
    EXPECT_EQ(handles(ball.positions, ball.triangles), 0);
    EXPECT_EQ(handles(ring.positions, ring.triangles), 1);
    EXPECT_EQ(handles(box.positions, box.triangles), 0);
    const Triangles open = ball.triangles.topRows(ball.triangles.rows() - 1);
    EXPECT_EQ(handles(ball.positions, open), 0);
    EXPECT_FALSE(handles(ball.positions, with_row(ball.triangles, 0, 1, 2)).has_value() &&
                 handles(ball.positions, with_row(with_row(ball.triangles, 0, 1, 2), 0, 1, 3)).has_value());
}

} // namespace
